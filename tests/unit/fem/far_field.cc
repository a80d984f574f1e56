#include "fem/far_field/far_field.h"
#include "fem/boundary_ids.h"
#include "fem/dealii/far_field_mesh.h"
#include "tests/support/catch.h"
#include "tests/support/small_chamber.h"

#include <Eigen/Geometry>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <sstream>
#include <unistd.h>

using namespace mergel::fem;

namespace {

std::string complaint(FarFieldSpec s, void (*spoil)(FarFieldSpec&))
{
  spoil(s);
  try {
    s.check();
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "none";
}

} // namespace

TEST_CASE("Each wrong entry of the far field is named with its value", "[unit][fem]")
{
  CHECK_NOTHROW(small_chamber().check());
  using mergel::match::Contains;
  CHECK_THAT(complaint(small_chamber(), [](auto& s) { s.nu = 0.6; }),
             Contains("Poisson's ratio = 0.6") && Contains("-1 < nu < 0.5"));
  CHECK_THAT(complaint(small_chamber(), [](auto& s) { s.nu = FarFieldSpec::unset; }),
             Contains("nan"));
  CHECK_THAT(complaint(small_chamber(), [](auto& s) { s.chamber_diameter = 10e-3; }),
             Contains("chamber diameter = 0.01") && Contains("exceed the region"));
  CHECK_THAT(complaint(small_chamber(), [](auto& s) { s.chamber_height = 1e-3; }),
             Contains("chamber height"));
  CHECK_THAT(complaint(small_chamber(), [](auto& s) { s.region_diameter = 0.0; }),
             Contains("region diameter"));
  CHECK_THAT(complaint(small_chamber(), [](auto& s) { s.region_height = -1.0; }),
             Contains("region height"));
  CHECK_THAT(complaint(small_chamber(), [](auto& s) { s.cell_size = 2.0; }),
             Contains("cell size = 2"));
  CHECK_THAT(complaint(small_chamber(), [](auto& s) { s.cell_size = 1e-6; }),
             Contains("number of cells"));
  CHECK_THAT(complaint(small_chamber(), [](auto& s) { s.growth = 0.9; }),
             Contains("mesh growth ratio = 0.9"));
  CHECK_THAT(complaint(small_chamber(), [](auto& s) { s.E = 0.0; }),
             Contains("Young's modulus"));
  CHECK_THAT(complaint(small_chamber(), [](auto& s) { s.rho = -1.0; }),
             Contains("bulk density = -1"));
  CHECK_THAT(complaint(small_chamber(), [](auto& s) { s.K0 = -0.1; }),
             Contains("K0 = -0.1"));
  CHECK_THAT(complaint(small_chamber(), [](auto& s) { s.gravity = -9.81; }),
             Contains("gravity"));
  CHECK_THAT(complaint(small_chamber(), [](auto& s) { s.damping = 1.0; }),
             Contains("damping = 1"));
  CHECK_THAT(complaint(small_chamber(), [](auto& s) { s.surcharge = -1.0; }),
             Contains("surcharge = -1"));
  CHECK_THAT(complaint(small_chamber(), [](auto& s) { s.side_pressure = 1e5; }),
             Contains("side pressure = 100000") && Contains("is held"));
  CHECK_THAT(complaint(small_chamber(),
                       [](auto& s) {
                         s.outer = FarFieldSpec::Outer::pressure;
                         s.side_pressure = FarFieldSpec::unset;
                       }),
             Contains("side pressure = nan"));
}

TEST_CASE("The interface is one surface that faces the region, on its radius and floor",
          "[unit][fem]")
{
  const FarField field(small_chamber());
  const InterfaceMesh& mesh = field.interface();
  const double R = 5e-3, H = 12e-3, close = 1e-15;
  REQUIRE(mesh.boundary.size() == mesh.triangles.size());

  std::map<std::pair<int, int>, int> edges; // directed
  double area_floor = 0.0, area_side = 0.0;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const auto& t = mesh.triangles[k];
    const Vec3 &a = mesh.x[t[0]], &b = mesh.x[t[1]], &c = mesh.x[t[2]];
    const Vec3 normal = (b - a).cross(c - a);
    const Vec3 centre = (a + b + c) / 3.0;
    for (int e = 0; e < 3; ++e) ++edges[{t[e], t[(e + 1) % 3]}];
    if (mesh.boundary[k] == boundary::interface_bottom) {
      area_floor += 0.5 * normal.norm();
      CHECK(normal.z() > 0.99 * normal.norm());
      for (const int n : t) CHECK(mesh.x[n].z() == Approx(-H).epsilon(1e-14));
    } else {
      REQUIRE(mesh.boundary[k] == boundary::interface_side);
      area_side += 0.5 * normal.norm();
      CHECK(normal.x() * centre.x() + normal.y() * centre.y() < 0.0);
      CHECK(std::abs(normal.z()) < 1e-12 * normal.norm());
      for (const int n : t)
        CHECK(std::abs(std::hypot(mesh.x[n].x(), mesh.x[n].y()) - R) < close);
    }
  }
  for (const auto& [edge, count] : edges) {
    CHECK(count == 1);
    if (edges.count({edge.second, edge.first}) == 1) continue;
    const Vec3 &a = mesh.x[edge.first], &b = mesh.x[edge.second];
    CHECK(((a.z() == 0.0 && b.z() == 0.0) || (a.y() == 0.0 && b.y() == 0.0))); // the rim
  }
  // 8 segments cover the half circle.
  const double segment = 2.0 * R * std::sin(std::numbers::pi / 16.0);
  CHECK(area_side == Approx(8.0 * segment * H));
  CHECK(area_floor == Approx(4.0 * R * R * std::sin(std::numbers::pi / 8.0)));
}

TEST_CASE("The interface is its own mirror image in x, nodes and diagonals", "[unit][fem]")
{
  FarFieldSpec spec = small_chamber();
  spec.cell_size = 1.2e-3;
  const FarField field(spec);
  const InterfaceMesh& mesh = field.interface();
  const auto node = [](const Vec3& x) {
    return std::array<double, 3>{x.x() + 0.0, x.y(), x.z()}; // + 0.0 turns -0 into 0
  };
  using Triangle = std::set<std::array<double, 3>>;
  std::set<Triangle> triangles;
  const auto add = [&](double sign, const auto& t) {
    Triangle nodes;
    for (const int n : t)
      nodes.insert(node(Vec3(sign * mesh.x[n].x(), mesh.x[n].y(), mesh.x[n].z())));
    return nodes;
  };
  for (const auto& t : mesh.triangles) triangles.insert(add(1.0, t));
  for (const auto& t : mesh.triangles) CHECK(triangles.count(add(-1.0, t)) == 1);
}

namespace {

using Point = std::array<double, 3>;

/// The triangles of an interface, each with y times `sign`, as sets of points.
std::set<std::set<Point>> triangles_of(const InterfaceMesh& mesh, double sign)
{
  std::set<std::set<Point>> all;
  for (const auto& t : mesh.triangles) {
    std::set<Point> points;
    for (const int n : t) // + 0.0 turns -0 into 0
      points.insert({mesh.x[n].x(), sign * mesh.x[n].y() + 0.0, mesh.x[n].z()});
    all.insert(points);
  }
  return all;
}

} // namespace

TEST_CASE("A whole far field is the half and its mirror image, without a cut",
          "[unit][fem]")
{
  FarFieldSpec spec = small_chamber();
  spec.cell_size = 1.2e-3;
  const FarField half(spec);
  spec.extent = Extent::full;
  const FarField full(spec);
  CHECK(full.n_cells() == 2 * half.n_cells());
  CHECK(full.mass() == Approx(2.0 * half.mass()).epsilon(1e-12));
  auto both = triangles_of(half.interface(), 1.0);
  both.merge(triangles_of(half.interface(), -1.0));
  CHECK(both.size() == 2 * half.interface().triangles.size());
  CHECK(triangles_of(full.interface(), 1.0) == both);

  // Open at the surface alone.
  const InterfaceMesh& mesh = full.interface();
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : mesh.triangles)
    for (int e = 0; e < 3; ++e) ++edges[{t[e], t[(e + 1) % 3]}];
  for (const auto& [edge, count] : edges) {
    CHECK(count == 1);
    if (edges.count({edge.second, edge.first}) == 0)
      CHECK((mesh.x[edge.first].z() == 0.0 && mesh.x[edge.second].z() == 0.0));
  }
}

TEST_CASE("The mesh fills the chamber with well-shaped cells of the number predicted",
          "[unit][fem]")
{
  for (const double size : {2e-3, 1.2e-3, 0.8e-3}) {
    const FarFieldGeometry g{12.5e-3, 40e-3, 5e-3, 12e-3, size, 1.4};
    const FarFieldLayers n = layers(g);
    CHECK(n.n_around % 4 == 0);
    dealii::Triangulation<3> mesh;
    make_far_field_mesh(g, n, mesh);
    CHECK(mesh.n_active_cells() == n.n_cells(Extent::half));

    // Scaled Jacobian, 1 in a cuboid: measured 0.82 to 0.86, in the corners of the core.
    double worst = 1.0;
    for (const auto& cell : mesh.active_cell_iterators())
      for (unsigned int v = 0; v < 8; ++v) {
        const auto x = cell->vertex(v);
        std::array<dealii::Tensor<1, 3>, 3> edge;
        for (unsigned int d = 0; d < 3; ++d) {
          edge[d] = cell->vertex(v ^ (1U << d)) - x;
          edge[d] *= ((v >> d) & 1U ? -1.0 : 1.0) / edge[d].norm();
        }
        worst = std::min(worst, dealii::cross_product_3d(edge[0], edge[1]) * edge[2]);
      }
    CHECK(worst > 0.75);

    std::map<int, double> area;
    for (const auto& cell : mesh.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
          area[static_cast<int>(cell->face(f)->boundary_id())] += cell->face(f)->measure();
    CHECK(area.size() == 6);
    const double sector = n.n_around / 2.0 * std::sin(std::numbers::pi / n.n_around);
    CHECK(area[boundary::bottom] == Approx(sector * 12.5e-3 * 12.5e-3));
    CHECK(area[boundary::top] == Approx(sector * (12.5e-3 * 12.5e-3 - 5e-3 * 5e-3)));
    CHECK(area[boundary::symmetry] == Approx(25e-3 * 40e-3 - 10e-3 * 12e-3));
  }
}

TEST_CASE("The sizes of pile_small.prm give 948 cells", "[unit][fem]")
{
  const FarFieldLayers n = layers({12.5e-3, 40e-3, 5e-3, 12e-3, 1.2e-3, 1.48});
  CHECK(n.n_around == 12);
  CHECK(n.n_ring == 1);
  CHECK(n.n_radial == 4);
  CHECK(n.n_upper == 10);
  CHECK(n.n_lower == 6);
  CHECK(n.n_cells(Extent::half) == 948);
}

TEST_CASE("Far-field output is written complete under its name, without other files",
          "[unit][fem]")
{
  const FarField field(small_chamber());
  const auto folder =
      std::filesystem::temp_directory_path() / ("mergel_fem_" + std::to_string(getpid()));
  std::filesystem::create_directory(folder);
  field.write_vtu(folder / "far_field.vtu", "a b");
  std::ifstream file(folder / "far_field.vtu");
  std::stringstream text;
  text << file.rdbuf();
  CHECK_THAT(text.str(), mergel::match::Contains("Name=\"stress\"") &&
                             mergel::match::Contains("Name=\"displacement\"") &&
                             mergel::match::Contains("</VTKFile>"));
  // A text as the codes of its letters: a, a blank, b, the end.
  CHECK_THAT(text.str(), mergel::match::Contains(
                             "Name=\"made by\" NumberOfTuples=\"1\" format=\"ascii\">"
                             "\n97 32 98 0\n"));
  CHECK(std::distance(std::filesystem::directory_iterator(folder), {}) == 1);
  std::filesystem::remove_all(folder);
  CHECK_THROWS_WITH(field.write_vtu(folder / "far_field.vtu"),
                    mergel::match::Contains("cannot be written: No such file"));
}

TEST_CASE("The amplitudes of a far field give its symmetric stiffness, and J^T is the "
          "transpose of its interface motion",
          "[unit][fem]")
{
  const FarField field(small_chamber());
  const std::size_t n = field.n_amplitudes();
  const std::vector<Vec3> none(field.interface().x.size(), Vec3::Zero());
  const auto draw = [](std::size_t size, double phase) { // any vector
    std::vector<double> y(size);
    for (std::size_t k = 0; k < size; ++k)
      y[k] = std::sin(phase + 1.3 * double(k * k % 97));
    return y;
  };
  const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  };
  const std::vector<double> a = draw(n, 0.1), b = draw(n, 0.7);
  std::vector<double> Aa(n), Ab(n);
  field.multiply(a, none, Aa);
  field.multiply(b, none, Ab);
  CHECK(dot(a, Aa) > 0.0);
  CHECK(dot(b, Aa) == Approx(dot(a, Ab)).epsilon(1e-12));

  // f.(J a) = a.(J^T f), for any forces on the interface nodes.
  const std::vector<double> numbers = draw(3 * none.size(), 0.4);
  std::vector<Vec3> f, u;
  for (std::size_t k = 0; k < none.size(); ++k)
    f.emplace_back(numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]);
  std::vector<double> of_f(n);
  field.multiply(std::vector<double>(n, 0.0), f, of_f);
  field.interface_motion(a, u);
  REQUIRE(u.size() == f.size());
  double work = 0.0;
  for (std::size_t k = 0; k < f.size(); ++k) work += f[k].dot(u[k]);
  CHECK(dot(a, of_f) == Approx(work).epsilon(1e-12));
}
