#include "tests/support/catch.h"

#include "fem/solid/block_matrix.h"

#include <algorithm>
#include <cstring>

using namespace mergel::fem;

TEST_CASE("A product of the block matrix is that of the full symmetric matrix",
          "[unit][fem]")
{
  // Couplings 0-1, 0-3, 1-2, 2-3; node 4 has none.
  BlockMatrix A({{1, 3}, {2}, {3}, {}, {}});
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(15, 15);
  std::srand(7);
  A.for_each([](std::uint32_t, std::uint32_t, const Mat3& B) { CHECK(B.isZero(0.0)); });
  for (const auto& [i, j] : std::vector<std::pair<int, int>>{{0, 0},
                                                             {0, 1},
                                                             {0, 3},
                                                             {1, 1},
                                                             {1, 2},
                                                             {2, 2},
                                                             {2, 3},
                                                             {3, 3},
                                                             {4, 4},
                                                             {0, 3}}) {
    Mat3 B = Mat3::Random();
    if (i == j) B = (B + B.transpose()).eval();
    A.add(i, j, B);
    full.block<3, 3>(3 * i, 3 * j) += B;
    if (i != j) full.block<3, 3>(3 * j, 3 * i) += B.transpose();
  }
  CHECK(A.n_rows() == 5);
  CHECK(A.n_blocks() == 9);

  NodalField x = NodalField::Zero(4, 5), y = NodalField::Constant(4, 5, 99.0);
  x.topRows<3>().setRandom();
  A.multiply(x, y);
  Eigen::VectorXd flat(15);
  for (int a = 0; a < 5; ++a) flat.segment<3>(3 * a) = at(x, a);
  const Eigen::VectorXd expected = full * flat;
  for (int a = 0; a < 5; ++a) {
    CHECK((at(y, a) - expected.segment<3>(3 * a)).norm() < 1e-14 * expected.norm());
    CHECK(y(3, a) == 0.0); // padding stays zero
  }
}

TEST_CASE("Products of ranges of rows have the bits of the full product", "[unit][fem]")
{
  // A band of irregular couplings: every row has blocks on both sides of its diagonal.
  const std::uint32_t n = 40;
  std::vector<std::vector<std::uint32_t>> upper(n);
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = i + 1; j < std::min(n, i + 9); ++j)
      if ((i * j) % 3 != 1) upper[i].push_back(j);
  BlockMatrix A(upper);
  std::srand(11);
  for (std::uint32_t i = 0; i < n; ++i) {
    A.add(i, i, Mat3::Identity());
    for (const std::uint32_t j : upper[i]) A.add(i, j, Mat3::Random());
  }
  NodalField x = NodalField::Zero(4, n), whole, shared = NodalField::Constant(4, n, 99.0);
  x.topRows<3>().setRandom();
  A.multiply(x, whole);
  for (const auto& [begin, end] : std::vector<std::pair<std::uint32_t, std::uint32_t>>{
           {13, 14}, {0, 13}, {14, 14}, {14, n}}) {
    const BlockMatrix::Rows rows = A.rows(begin, end);
    A.multiply(x, shared, rows);
  }
  CHECK(std::memcmp(whole.data(), shared.data(), sizeof(double) * 4 * n) == 0);

  std::size_t blocks = 0;
  for (const std::size_t k : A.blocks_by_row()) blocks += k;
  CHECK(blocks == 2 * A.n_blocks() - n); // an off-diagonal block counts in two rows
}

TEST_CASE("A block outside the pattern is refused", "[unit][fem]")
{
  BlockMatrix A({{1}, {}, {}});
  CHECK_THROWS_WITH(A.add(0, 2, Mat3::Identity()), mergel::match::Contains("(0, 2)"));
  CHECK_THROWS_AS(A.add(1, 0, Mat3::Identity()), std::logic_error); // the upper half only
}
