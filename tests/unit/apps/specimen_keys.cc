#include "apps/case/specimen_keys.h"

#include "dem/error.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

using namespace mergel;
using namespace mergel::apps;
using Catch::Matchers::Contains;
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

/// Reads and completes a case of this text and passes it to `use`.
template <class Use>
void resolved(const std::string& text, Use&& use)
{
  CaseFile file;
  SpecimenKeys k;
  k.shape = SpecimenKeys::Shape::periodic_box;
  k.upscaling = SpecimenKeys::Upscaling::uniform;
  declare(file, k);
  file.read_text(text, "case");
  complete(file, k, dem::LinearMaterial{0.63e9, 2.4, 0.65, 3e-5});
  use(file);
}

} // namespace

TEST_CASE("A resolved case holds the sum of its size table and refuses a changed one",
          "[unit][apps]")
{
  Table table;
  table.write("0.2");
  const std::string text =
      "subsection Specimen\n set edge x = 5 mm\n set edge y = 5 mm\n set edge z = 5 mm\n"
      " set sizes = table\n set size table = " +
      table.file.string() +
      "\n set upscaling ratio = 2\n set grain density = 2650 kg/m3\n set porosity = 0.7\n"
      " set coordination = 5\n set bond gap = 0.03 mm\nend\n";
  std::string earlier;
  resolved(text, [&](const CaseFile& file) { earlier = file.resolved_text(); });
  CHECK_THAT(earlier, Contains("set size table sum = "));
  resolved(earlier, [&](const CaseFile& file) { CHECK(file.resolved_text() == earlier); });

  table.write("0.3");
  CHECK_THROWS_WITH(resolved(earlier, [](const CaseFile&) {}),
                    Contains("Specimen/size table sum = ") &&
                        Contains("it was changed after this case was resolved"));
  // The case as first written differs from that of a checkpoint by this key.
  resolved(text, [&](const CaseFile& file) {
    const auto changes = file.changes_since(earlier);
    REQUIRE(changes.size() == 1);
    CHECK(changes[0].key == "size table sum");
  });
}
