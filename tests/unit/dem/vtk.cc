#include "dem/io/vtk.h"

#include "dem/error.h"
#include "dem/io/atomic_file.h"
#include "dem/version.h"
#include "tests/support/catch.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <stdexcept>

#include <sys/resource.h>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

using namespace mergel;
using namespace mergel::dem;
namespace fs = std::filesystem;

namespace {

std::vector<std::string> names_in(const fs::path& folder)
{
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  return names;
}

/// A disk that is full after so many bytes of a file: write() fails with EFBIG instead of
/// ENOSPC.
class FullDisk {
public:
  explicit FullDisk(rlim_t bytes)
  {
    earlier_signal_ = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &earlier_);
    const rlimit limit{bytes, earlier_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  ~FullDisk()
  {
    ::setrlimit(RLIMIT_FSIZE, &earlier_);
    std::signal(SIGXFSZ, earlier_signal_);
  }

private:
  rlimit earlier_{};
  void (*earlier_signal_)(int) = nullptr;
};

std::string contents(const fs::path& file)
{
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

vtkSmartPointer<vtkPolyData> read(const fs::path& file)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

/// Numbers with all bits in use, and numbers that a text format would lose.
std::vector<double> awkward_numbers(std::size_t n)
{
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1e-2, 1e-2);
  std::vector<double> result(n);
  for (double& value : result) value = uniform(random);
  using limits = std::numeric_limits<double>;
  const std::vector<double> special{-0.0, 1.0 / 3.0, limits::denorm_min(), limits::max(),
                                    limits::infinity()};
  std::copy_n(special.begin(), std::min(n, special.size()), result.begin());
  return result;
}

std::vector<Vec3> positions(std::size_t n)
{
  const std::vector<double> numbers = awkward_numbers(3 * n + 5);
  std::vector<Vec3> result(n);
  for (std::size_t p = 0; p < n; ++p)
    result[p] = {numbers[3 * p + 5], numbers[3 * p + 6], numbers[3 * p + 7]};
  return result;
}

/// The same numbers to the last bit; false, too, when the file holds another type or shape.
bool same_bits(vtkDataArray* read, const Field& written)
{
  return read != nullptr && read->GetDataType() == VTK_DOUBLE &&
         read->GetNumberOfComponents() == written.components &&
         static_cast<std::size_t>(read->GetNumberOfValues()) == written.values.size() &&
         std::memcmp(read->GetVoidPointer(0), written.values.data(),
                     written.values.size() * sizeof(double)) == 0;
}

bool same_bits(vtkPolyData* read, const std::vector<Vec3>& x)
{
  Field flat{"x", 3, {}};
  for (const Vec3& point : x)
    flat.values.insert(flat.values.end(), point.data(), point.data() + 3);
  return same_bits(read->GetPoints()->GetData(), flat);
}

template <std::size_t n>
std::vector<std::array<Index, n>> corners(vtkCellArray* cells)
{
  std::vector<std::array<Index, n>> result;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < cells->GetNumberOfCells(); ++c) {
    cells->GetCellAtId(c, ids);
    REQUIRE(ids->GetNumberOfIds() == static_cast<vtkIdType>(n));
    result.emplace_back();
    for (std::size_t k = 0; k < n; ++k)
      result.back()[k] = static_cast<Index>(ids->GetId(static_cast<vtkIdType>(k)));
  }
  return result;
}

} // namespace

TEST_CASE("points and their fields come back bit for bit", "[unit][dem]")
{
  const TemporaryFolder folder;
  const std::size_t n = 1000;
  const auto x = positions(n);
  const Field radius{"radius", 1, awkward_numbers(n)};
  const Field velocity{"velocity", 3, awkward_numbers(3 * n)};
  write_points(folder.path / "points.vtp", x, {radius, velocity});

  const auto data = read(folder.path / "points.vtp");
  CHECK(same_bits(data, x));
  CHECK(data->GetNumberOfVerts() == static_cast<vtkIdType>(n));
  CHECK(corners<1>(data->GetVerts()).back()[0] == n - 1);
  CHECK(data->GetPointData()->GetNumberOfArrays() == 2);
  CHECK(same_bits(data->GetPointData()->GetArray("radius"), radius));
  CHECK(same_bits(data->GetPointData()->GetArray("velocity"), velocity));
}

TEST_CASE("lines keep their ends and carry fields per line", "[unit][dem]")
{
  const TemporaryFolder folder;
  const auto x = positions(4);
  const std::vector<std::array<Index, 2>> lines{{0, 3}, {2, 1}};
  const Field damage{"D", 1, {1.0, 1.0 / 3.0}};
  write_lines(folder.path / "bonds.vtp", x, lines, {damage});

  const auto data = read(folder.path / "bonds.vtp");
  CHECK(same_bits(data, x));
  CHECK(corners<2>(data->GetLines()) == lines);
  CHECK(same_bits(data->GetCellData()->GetArray("D"), damage));
  CHECK(data->GetPointData()->GetNumberOfArrays() == 0);
}

TEST_CASE("a surface keeps its triangles and fields per point", "[unit][dem]")
{
  const TemporaryFolder folder;
  const auto x = positions(4);
  const std::vector<std::array<Index, 3>> triangles{{0, 1, 2}, {0, 2, 3}};
  const Field force{"force", 3, awkward_numbers(12)};
  write_surface(folder.path / "pile.vtp", x, triangles, {force});

  const auto data = read(folder.path / "pile.vtp");
  CHECK(same_bits(data, x));
  CHECK(corners<3>(data->GetPolys()) == triangles);
  CHECK(same_bits(data->GetPointData()->GetArray("force"), force));
}

TEST_CASE("every file names the program that made it, and no file differs from run to run",
          "[unit][dem]")
{
  const TemporaryFolder folder;
  write_points(folder.path / "a.vtp", positions(2), {});
  write_points(folder.path / "b.vtp", positions(2), {});
  const auto data = read(folder.path / "a.vtp");
  auto* const made_by =
      vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("made by"));
  REQUIRE(made_by != nullptr);
  REQUIRE(made_by->GetNumberOfValues() == 1);
  CHECK(made_by->GetValue(0) == program_text());
  CHECK(program_text().starts_with("mergel " + std::string(version().number)));
  CHECK(contents(folder.path / "a.vtp") == contents(folder.path / "b.vtp"));
}

TEST_CASE("an empty set gives a readable file with the names of the fields", "[unit][dem]")
{
  const TemporaryFolder folder;
  write_lines(folder.path / "none.vtp", {}, {}, {{"N", 1, {}}});
  const auto data = read(folder.path / "none.vtp");
  CHECK(data->GetNumberOfLines() == 0);
  CHECK(data->GetCellData()->HasArray("N") == 1);
}

TEST_CASE("sizes, names and indices that do not fit are refused and nothing is written",
          "[unit][dem]")
{
  const TemporaryFolder folder;
  const auto x = positions(2);
  const Field one{"S", 1, {1.0, 2.0}};
  CHECK_THROWS_AS(write_points(folder.path / "a.vtp", x, {{"S", 3, {1.0, 2.0}}}),
                  std::logic_error);
  CHECK_THROWS_AS(write_points(folder.path / "a.vtp", x, {{"S", 0, {}}}), std::logic_error);
  CHECK_THROWS_AS(write_points(folder.path / "a.vtp", x, {one, one}), std::logic_error);
  CHECK_THROWS_AS(write_lines(folder.path / "a.vtp", x, {{0, 2}}, {}), std::logic_error);
  CHECK(names_in(folder.path).empty());
}

TEST_CASE("a full disk throws, names file and reason, and leaves the earlier file complete",
          "[unit][dem]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "points.vtp";
  const auto x = positions(2000);
  write_points(file, positions(10), {});
  const std::string earlier = contents(file);
  write_points(folder.path / "later.vtp", x, {});
  const std::string later = contents(folder.path / "later.vtp");

  // Full at once, in the middle, and where only the last byte is missing.
  for (const std::size_t room : {std::size_t{0}, later.size() / 2, later.size() - 1}) {
    std::string message;
    {
      const FullDisk full(room);
      try {
        write_points(file, x, {});
      } catch (const NumericalError& error) {
        message = error.what();
      }
    }
    INFO("room for " << room << " of " << later.size() << " bytes");
    CHECK_THAT(message, mergel::match::Contains(file.string()) &&
                            mergel::match::Contains("File too large"));
    CHECK(contents(file) == earlier);
    CHECK(names_in(folder.path).size() == 2);
  }

  write_points(file, x, {});
  CHECK(contents(file) == later);
}

TEST_CASE("a missing folder is named with the system's reason", "[unit][dem]")
{
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(write_points(folder.path / "no/points.vtp", positions(1), {}),
                    mergel::match::Contains((folder.path / "no/points.vtp").string()) &&
                        mergel::match::Contains("No such file or directory"));
}

TEST_CASE("a replaced file is the old one until its writer has returned", "[unit][dem]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "walls.vtp";
  replace_file(file, "old");
  const auto half_and_fail = [&](const fs::path& temporary) {
    CHECK(temporary.extension() == ".vtp");
    CHECK(temporary.parent_path() == file.parent_path());
    std::ofstream(temporary) << "new";
    CHECK(contents(file) == "old");
    throw std::domain_error("writer failed");
  };
  CHECK_THROWS_AS(replace_file(file, half_and_fail), std::domain_error);
  CHECK(contents(file) == "old");
  CHECK(names_in(folder.path).size() == 1);

  CHECK_THROWS_AS(replace_file(file, [](const fs::path&) {}), NumericalError);
  CHECK(contents(file) == "old");

  replace_file(file, [](const fs::path& temporary) { std::ofstream(temporary) << "new"; });
  CHECK(contents(file) == "new");
}

TEST_CASE("a series lists paths relative to itself and exact times", "[unit][dem]")
{
  const TemporaryFolder folder;
  Series series(folder.path / "particles.pvd");
  CHECK(names_in(folder.path).empty());
  series.add(0.0, folder.path / "fields/particles_0000.vtp");
  series.add(0.1 + 0.2, folder.path / "fields/a \"b\" & <c>.vtp");

  const auto entries = read_series(folder.path / "particles.pvd");
  REQUIRE(entries.size() == 2);
  CHECK(entries[0].time == 0.0);
  CHECK(entries[0].file == "fields/particles_0000.vtp");
  CHECK(entries[1].time == 0.1 + 0.2);
  CHECK(entries[1].file == "fields/a \"b\" & <c>.vtp");

  SECTION("and is continued after a restart")
  {
    Series continued(folder.path / "particles.pvd", {entries[0]});
    continued.add(0.4, folder.path / "fields/particles_0001.vtp");
    const auto all = read_series(folder.path / "particles.pvd");
    REQUIRE(all.size() == 2);
    CHECK(all[0].file == entries[0].file);
    CHECK(all[1].time == 0.4);
  }
  SECTION("and does not depend on how its own path is written")
  {
    const fs::path here = fs::current_path();
    fs::current_path((folder.path / "particles.pvd").parent_path());
    Series bare("bare.pvd");
    bare.add(1.0, "./fields/../fields/x.vtp");
    const auto listed = read_series("bare.pvd");
    fs::current_path(here);
    CHECK(listed.at(0).file == "fields/x.vtp");
  }
  SECTION("and stays complete when the disk is full")
  {
    const std::string earlier = contents(folder.path / "particles.pvd");
    {
      const FullDisk full(100);
      CHECK_THROWS_AS(series.add(0.5, folder.path / "fields/x.vtp"), NumericalError);
    }
    CHECK(contents(folder.path / "particles.pvd") == earlier);
    CHECK(series.entries().size() == 2);
  }
}

TEST_CASE("a file that is not a series is refused by name", "[unit][dem]")
{
  const TemporaryFolder folder;
  replace_file(folder.path / "a.pvd",
               "<?xml version=\"1.0\"?>\n<VTKFile><Piece/></VTKFile>\n");
  CHECK_THROWS_AS(read_series(folder.path / "a.pvd"), InputError);
  CHECK_THROWS_WITH(read_series(folder.path / "b.pvd"),
                    mergel::match::Contains((folder.path / "b.pvd").string()));
}
