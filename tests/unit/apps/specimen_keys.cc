#include "tests/support/catch.h"

#include "apps/case/specimen_keys.h"

#include "dem/error.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

using namespace mergel;
using namespace mergel::apps;
using mergel::match::Contains;
namespace fs = std::filesystem;

namespace {

/// The file of a sieve curve, removed at the end.
struct Table {
  fs::path file =
      fs::temp_directory_path() / ("mergel_sieve_" + std::to_string(::getpid()) + ".csv");
  ~Table() { fs::remove(file); }
  void write(const std::string& d_max)
  {
    std::ofstream(file) << "diameter [mm],passing [%]\n0.1,0\n" << d_max << ",100\n";
  }
};

/// Reads and completes a case of this text, as a run from a file or as one that is
/// continued, and passes it to `use`.
template <class Use>
void resolved(const std::string& text, bool is_continued, Use&& use)
{
  CaseFile file;
  SpecimenKeys k;
  k.shape = SpecimenKeys::Shape::periodic_box;
  k.upscaling = SpecimenKeys::Upscaling::uniform;
  declare(file, k);
  if (is_continued) {
    file.read_text(text, "case");
  } else {
    const fs::path prm =
        fs::temp_directory_path() / ("mergel_case_" + std::to_string(::getpid()) + ".prm");
    std::ofstream(prm) << text;
    file.read(prm);
    fs::remove(prm);
  }
  complete(file, k, dem::LinearMaterial{0.63e9, 2.4, 0.65, 3e-5});
  use(file, k);
}

std::string case_with(const fs::path& table)
{
  return "subsection Specimen\n set edge x = 5 mm\n set edge y = 5 mm\n set edge z = 5 mm\n"
         " set sizes = table\n set size table = " +
         table.string() +
         "\n set upscaling ratio = 2\n set grain density = 2650 kg/m3\n set porosity = "
         "0.7\n set coordination = 5\n set bond gap = 0.03 mm\nend\n";
}

} // namespace

TEST_CASE("A resolved case holds the sum of its size table and refuses a changed one",
          "[unit][apps]")
{
  Table table;
  table.write("0.2");
  const std::string text = case_with(table.file);
  std::string earlier;
  resolved(text, false, [&](const CaseFile& file, const SpecimenKeys&) {
    earlier = file.resolved_text();
  });
  CHECK_THAT(earlier, Contains("set size table sum = "));
  resolved(earlier, false, [&](const CaseFile& file, const SpecimenKeys&) {
    CHECK(file.resolved_text() == earlier);
  });

  table.write("0.3");
  CHECK_THROWS_WITH(resolved(earlier, false, [](const CaseFile&, const SpecimenKeys&) {}),
                    Contains("Specimen/size table sum = ") &&
                        Contains("it was changed after this case was resolved"));
  // The case as first written differs from that of a checkpoint by its content.
  resolved(text, false, [&](const CaseFile& file, const SpecimenKeys&) {
    const auto changes = file.changes_since(earlier);
    REQUIRE(changes.size() == 1);
    CHECK(changes[0].key == "size table sum");
  });
}

TEST_CASE("A case that is continued, or whose size table is gone, has the curve of its "
          "points to the bit",
          "[unit][apps]")
{
  Table table;
  table.write("0.23"); // no binary fraction
  std::string earlier;
  dem::Grading curve;
  resolved(case_with(table.file), false, [&](const CaseFile& file, const SpecimenKeys& k) {
    earlier = file.resolved_text();
    curve = k.specimen.sizes;
  });
  const auto check = [&](const CaseFile& file, const SpecimenKeys& k) {
    CHECK(file.changes_since(earlier).empty());
    for (const double p : {0.0, 0.1, 1.0 / 3.0, 0.5, 0.9, 1.0})
      CHECK(k.specimen.sizes.diameter(p) == curve.diameter(p));
  };
  table.write("0.3");
  resolved(earlier, true, check); // not read
  fs::remove(table.file);
  resolved(earlier, true, check);
  resolved(earlier, false, check);
  CHECK_THROWS_WITH(
      resolved(case_with(table.file), false, [](const CaseFile&, const SpecimenKeys&) {}),
      Contains("Specimen/size table = ") && Contains("cannot be read"));
}

TEST_CASE("A size table of the same content is the same wherever it lies", "[unit][apps]")
{
  Table table;
  table.write("0.2");
  std::string earlier;
  resolved(case_with(table.file), false, [&](const CaseFile& file, const SpecimenKeys&) {
    earlier = file.resolved_text();
  });
  const fs::path elsewhere = table.file.string() + ".moved";
  fs::rename(table.file, elsewhere);
  resolved(case_with(elsewhere), false, [&](const CaseFile& file, const SpecimenKeys&) {
    CHECK(file.changes_since(earlier).empty());
  });
  fs::remove(elsewhere);
}

TEST_CASE("Points that are no sieve curve are refused", "[unit][apps]")
{
  for (const char* points :
       {"0.1", "0.1 0", "0.1 0, 0.2 0.5", "0.2 0, 0.1 1", "0 0, 1 1", "0.1 0.1, 0.2 1",
        "0.1 0, 0.2 x", "0.1 0, 0.2 1 1", "0.1 0, 0.2 0.6, 0.3 0.5, 0.4 1"}) {
    std::string text = case_with("gone.csv");
    text.insert(text.rfind("end"), " set size table sum = 1\n set size table points = " +
                                       std::string(points) + "\n");
    CHECK_THROWS_WITH(resolved(text, true, [](const CaseFile&, const SpecimenKeys&) {}),
                      Contains("Specimen/size table points = ") &&
                          Contains("is no sieve curve"));
  }
}
