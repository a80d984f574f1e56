#include "apps/run/results.h"

#include "apps/run/tables.h"
#include "dem/error.h"
#include "tests/support/catch.h"
#include "tests/support/temporary_folder.h"

#include <fstream>
#include <string>
#include <vector>

using namespace mergel;
using namespace mergel::apps;
using mergel::match::Contains;
namespace fs = std::filesystem;

namespace {

using Names = std::vector<std::string>;

void write(const fs::path& file, const std::string& text = "x")
{
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

/// A series of one file, fields/NAME_0000.vtp.
void write_series(const fs::path& folder, const std::string& name)
{
  write(folder / (name + ".pvd"),
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n"
        "<Collection>\n<DataSet timestep=\"0\" part=\"0\" file=\"fields/" +
            name + "_0000.vtp\"/>\n</Collection>\n</VTKFile>\n");
  write(folder / "fields" / (name + "_0000.vtp"));
}

/// What a finished element run leaves.
void write_element_run(const fs::path& folder, const std::string& pictures)
{
  write(folder / "resolved.prm", "subsection Loading\n set stage 1 = x\nend\n"
                                 "subsection Output\n set pictures = " +
                                     pictures + "\nend\n");
  write(folder / "history.csv");
  write(folder / "summary.json");
  if (pictures == "none") return;
  write_series(folder, "particles");
  write_series(folder, "bonds");
  write_series(folder, "contacts");
}

/// What a finished triaxial run leaves. @param membrane "true" or "false"
void write_triaxial_run(const fs::path& folder, const std::string& membrane)
{
  write(folder / "resolved.prm",
        "subsection Specimen\nend\nsubsection Membrane\n set membrane = " + membrane +
            "\nend\nsubsection Platens\nend\nsubsection Loading\nend\n"
            "subsection Output\n set pictures = stages\nend\n");
  for (const char* name : {"history.csv", "localisation.csv", "summary.json", "sample.h5"})
    write(folder / name);
  for (const char* name : {"particles", "bonds", "contacts", "platens"})
    write_series(folder, name);
  if (membrane == "true") write_series(folder, "membrane");
}

/// What a finished Brazilian run leaves.
void write_brazilian_run(const fs::path& folder)
{
  write(folder / "resolved.prm",
        "subsection Specimen\nend\nsubsection Plates\nend\nsubsection Loading\nend\n"
        "subsection Output\n set pictures = ends\nend\n");
  for (const char* name : {"history.csv", "summary.json", "sample.h5"})
    write(folder / name);
  for (const char* name : {"particles", "bonds", "contacts", "breaks", "plates"})
    write_series(folder, name);
}

} // namespace

TEST_CASE("A finished run lacks every file that is removed from it", "[unit][apps]")
{
  for (const char* removed :
       {"resolved.prm", "history.csv", "particles.pvd", "bonds.pvd", "contacts.pvd",
        "fields/particles_0000.vtp", "fields/bonds_0000.vtp"}) {
    const TemporaryFolder folder;
    write_element_run(folder.path, "stages");
    REQUIRE(job_of(folder.path) == "element");
    CHECK(missing_results(folder.path, "element", Extent::finished).empty());
    require_results(folder.path, "element");
    fs::remove(folder.path / removed);
    CHECK(missing_results(folder.path, "element", Extent::finished).front() == removed);
    CHECK_THROWS_WITH(require_results(folder.path, "element"),
                      Contains("lacks " + std::string(removed)));
  }
}

TEST_CASE("What a run has lost is said by its first file and a number", "[unit][apps]")
{
  const TemporaryFolder folder;
  write_element_run(folder.path, "stages");
  const std::string lacks =
      folder.path.string() + ": was changed while the run wrote there, and lacks ";
  CHECK(lost_results(folder.path, "element").empty());
  fs::remove(folder.path / "fields/particles_0000.vtp");
  CHECK(lost_results(folder.path, "element") == lacks + "fields/particles_0000.vtp");
  fs::remove(folder.path / "fields/bonds_0000.vtp");
  CHECK(lost_results(folder.path, "element") ==
        lacks + "fields/particles_0000.vtp and one more file");
  fs::remove_all(folder.path / "fields");
  CHECK(lost_results(folder.path, "element") ==
        lacks + "fields/particles_0000.vtp and 2 more files");
}

TEST_CASE("A triaxial run lacks every table, specimen and series that is removed, and no "
          "membrane without one",
          "[unit][apps]")
{
  for (const char* removed :
       {"sample.h5", "localisation.csv", "particles.pvd", "bonds.pvd", "platens.pvd",
        "membrane.pvd", "fields/platens_0000.vtp", "fields/membrane_0000.vtp"}) {
    const TemporaryFolder folder;
    write_triaxial_run(folder.path, "true");
    REQUIRE(job_of(folder.path) == "triaxial");
    CHECK(missing_results(folder.path, "triaxial", Extent::finished).empty());
    fs::remove(folder.path / removed);
    CHECK(missing_results(folder.path, "triaxial", Extent::finished) == Names{removed});
  }
  const TemporaryFolder unconfined;
  write_triaxial_run(unconfined.path, "false");
  CHECK(missing_results(unconfined.path, "triaxial", Extent::finished).empty());
}

TEST_CASE("A Brazilian run lacks specimen and every series that is removed", "[unit][apps]")
{
  for (const char* removed :
       {"sample.h5", "particles.pvd", "bonds.pvd", "plates.pvd", "breaks.pvd",
        "fields/plates_0000.vtp", "fields/breaks_0000.vtp"}) {
    const TemporaryFolder folder;
    write_brazilian_run(folder.path);
    REQUIRE(job_of(folder.path) == "brazilian");
    CHECK(missing_results(folder.path, "brazilian", Extent::finished).empty());
    fs::remove(folder.path / removed);
    CHECK(missing_results(folder.path, "brazilian", Extent::finished) == Names{removed});
  }
}

TEST_CASE("Series are owed by the jobs that write them, at the end", "[unit][apps]")
{
  const TemporaryFolder folder;
  write_element_run(folder.path, "none");
  CHECK(missing_results(folder.path, "element", Extent::finished).empty());
  CHECK(missing_results(folder.path, "bond", Extent::finished).empty());
  CHECK(missing_results(folder.path, "pile", Extent::begun) ==
        Names{"shaft_profile.csv", "tip_profile.csv", "radial_profile.csv",
              "stress_path.csv"});
  CHECK(missing_results(folder.path, "pile", Extent::finished) ==
        Names{"shaft_profile.csv", "tip_profile.csv", "radial_profile.csv",
              "stress_path.csv", "sample.h5", "particles.pvd", "bonds.pvd", "pile.pvd",
              "far_field.pvd", "fields.pvd", "contacts.pvd"});
  CHECK(missing_results(folder.path, "sample", Extent::finished) ==
        Names{"sample.h5", "particles.pvd", "bonds.pvd"}); // as earlier versions wrote it
  fs::create_directory(folder.path / "fields");
  write(folder.path / "fields" / "contacts_0000.vtp", "x");
  CHECK(missing_results(folder.path, "sample", Extent::finished) ==
        Names{"sample.h5", "particles.pvd", "bonds.pvd", "contacts.pvd"});
  write(folder.path / "particles.pvd", "no series");
  CHECK(missing_results(folder.path, "element", Extent::begun) == Names{"particles.pvd"});
}

TEST_CASE(
    "A run that began at a checkpoint alone owes no specimen, nor does the end of a run",
    "[unit][apps]")
{
  const TemporaryFolder folder;
  write_brazilian_run(folder.path);
  fs::remove(folder.path / "sample.h5");
  CHECK(missing_results(folder.path, "brazilian", Extent::finished) == Names{"sample.h5"});
  CHECK_NOTHROW(require_results(folder.path, "brazilian"));
  write(folder.path / "history.csv", "# begins behind 16 bytes of checksum 0, which are "
                                     "missing\ntime [s]\n");
  CHECK(missing_results(folder.path, "brazilian", Extent::finished).empty());
}

TEST_CASE("A table says what it has lost at its head and at its end", "[unit][apps]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "history.csv";
  const auto read = [&](const std::string& text) {
    write(file, text);
    return dem::read_table(file);
  };
  const std::string heading = "time [s],q [Pa]\n";
  const std::string whole = heading + "0,0\n1e-3,1\n2e-3,2\n";
  CHECK(lost_start(read(whole)).empty());
  CHECK(lost_heading(file, "element").empty());
  CHECK(lost_start(read(heading + "1e-6,0\n1e-3,1\n")).empty());
  const std::string pile = "time [s],tip depth [m]\n"; // it has settled for some time
  CHECK(lost_start(read(pile + "4e-5,1e-5\n5e-5,2e-5\n6e-5,3e-5\n")).empty());
  CHECK_THAT(lost_start(read(pile + "5e-5,2e-5\n6e-5,3e-5\n7e-5,4e-5\n")),
             Contains("begins late, at time 5e-05 s"));
  CHECK_THAT(lost_start(read(heading + "1e-3,1\n2e-3,2\n")),
             Contains("begins late, at time 0.001 s"));
  CHECK(lost_start(
            read("# begins behind 9 bytes of checksum 0\n" + heading + "1e-3,1\n2e-3,2\n"))
            .empty());
  const std::string pair = "u_n [m],u_s [m],theta [rad],N [N]\n";
  CHECK(lost_start(read(pair + "0,0,0,0\n1e-6,0,0,2\n")).empty());
  CHECK(lost_heading(file, "bond").empty());
  CHECK_THAT(lost_start(read(pair + "1e-6,0,0,2\n")), Contains("begins late, at u_n"));

  for (const char* cut : {"", "me [s],q [Pa]\n0,0\n", "1e-3,1\n2e-3,2\n"}) {
    write(file, cut);
    CHECK_THAT(lost_heading(file, "element"), Contains("its first lines are lost"));
  }
  write(file, "time [s],q [");
  CHECK(lost_heading(file, "element") == "is cut in its heading");
  CHECK_FALSE(has_line(file));

  CHECK(lost_end({}, folder.path) == "is cut: it holds no record");
  CHECK(lost_end(read(whole), folder.path).empty());
  CHECK_THAT(lost_end(read(whole + "3e-3"), folder.path), Contains("last line"));
  write(folder.path / "particles.pvd",
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n"
        "<Collection>\n<DataSet timestep=\"0.002\" part=\"0\" file=\"a.vtp\"/>\n"
        "</Collection>\n</VTKFile>\n");
  CHECK(lost_end(read(whole), folder.path).empty());
  CHECK_THAT(lost_end(read(heading + "0,0\n1e-3,1\n"), folder.path),
             Contains("ends at time 0.001 s, before the last fields at 0.002 s"));
}

TEST_CASE("The job of a folder is told by its case, else by its history", "[unit][apps]")
{
  const std::string pile = "subsection Specimen\nend\nsubsection Pile\nend\n";
  const std::string element = "subsection Specimen\nend\nsubsection Loading\nend\n";
  const std::string triaxial = element + "subsection Platens\nend\n";
  const auto job = [](const std::vector<std::pair<const char*, std::string>>& files) {
    const TemporaryFolder folder;
    for (const auto& [name, text] : files) write(folder.path / name, text);
    return job_of(folder.path);
  };
  CHECK(job({{"resolved.prm", pile}}) == "pile");
  CHECK(job({{"resolved.prm", pile}, {"sample.h5", "x"}}) == "sample");
  CHECK(job({{"resolved.prm", pile}, {"sample.h5", "x"}, {"history.csv", "x"}}) == "pile");
  CHECK(job({{"resolved.prm", pile}, {"sample.h5", "x"}, {"far_field.pvd", "x"}}) ==
        "pile");
  CHECK(job({{"resolved.prm", pile}, {"sample.h5", "x"}, {"summary.json", "{}"}}) ==
        "pile");
  CHECK(job({{"resolved.prm", pile}, {"summary.json", "{\"porosity wanted [-]\": 0.5}"}}) ==
        "sample");
  CHECK(job({{"resolved.prm", "subsection Specimen\nend\n"}}) == "sample");
  CHECK(job({{"resolved.prm", "subsection Particles\nend\nsubsection Loading\nend\n"}}) ==
        "bond");
  CHECK(job({{"resolved.prm", triaxial}}) == "triaxial");
  CHECK(job({{"resolved.prm", triaxial}, {"sample.h5", "x"}, {"history.csv", "x"}}) ==
        "triaxial");
  CHECK(job({{"resolved.prm", triaxial}, {"sample.h5", "x"}}) == "sample");
  CHECK(job({{"resolved.prm", element}}) == "element");
  CHECK(job({{"resolved.prm", element},
             {"summary.json", "{\"porosity wanted [-]\": 0.5}"}}) == "sample");
  CHECK(job({{"history.csv", "time [s],axial strain [-],cell pressure [Pa]\n"}}) ==
        "triaxial");
  CHECK(job({{"history.csv", "time [s],diametral strain [-],2P/(pi D t) [Pa]\n"}}) ==
        "brazilian");
  CHECK(job({{"history.csv", "time [s],depth [m],depth/D_p [-]\n"}}) == "pile");
  CHECK(job({{"history.csv", "time [s],stage [-],axial strain [-]\n"}}) == "element");
  CHECK(job({{"history.csv", "u_n [m],plastic theta [rad]\n"}}) == "bond");
  CHECK(job({{"notes.txt", "x"}}).empty());
}
