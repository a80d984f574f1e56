/// Text that a case writes: the resolved case, and the help on its keys.
#include "tests/support/small_case.h"

#include <sstream>

using namespace mergel;
using namespace mergel::apps;
using namespace mergel::apps::test;
using mergel::match::Contains;
namespace fs = std::filesystem;

TEST_CASE("The resolved case sets every variable to the same bits", "[unit][apps]")
{
  const WorkingFolder folder;
  fs::create_directory("cases");
  write("cases/pile.prm", replaced(good, "1.4 mm", "1.3999999999999997 mm"));
  Case c;
  c.E = 0.1 + 0.2; // a default that needs all its digits
  Case again;
  CaseFile first, second;
  c.declare(first);
  again.declare(second);
  first.read("cases/pile.prm",
             {"Pile/cone angle=77.7 degree",
              "Far field/Poisson ratio=0.1428571428571428571", "Specimen/file=sample.h5",
              "Pile/title=free text", "Bond/bending flow=published",
              "Specimen/seed=12345678901234567", "Pile/half=no"});
  first.write_resolved("resolved.prm");

  second.read("resolved.prm");
  CHECK(again == c); // doubles compare by value, none is NaN
  CHECK(c.E == 0.1 + 0.2);

  fs::create_directory("elsewhere");
  second.write_resolved("elsewhere/resolved.prm");
  CHECK(content("elsewhere/resolved.prm") == content("resolved.prm"));

  // later changes of the values by the program do not enter the resolved case
  c.sigma_t *= 1.1;
  first.write_resolved("later.prm");
  CHECK(content("later.prm") == content("resolved.prm"));
}

TEST_CASE("The resolved case is commented text with units", "[unit][apps]")
{
  const WorkingFolder folder;
  write("pile.prm", good);
  double D = 1e-3;
  bool is_half = true;
  std::string title;
  CaseFile file;
  {
    const auto section = file.section("Pile");
    file.quantity("diameter", D, "m", positive, "Diameter.", "mm");
    file.flag("half", is_half, "Half model.");
    file.text("title", title, "Title.");
  }
  CHECK_THROWS_AS(file.write_resolved("resolved.prm"),
                  std::logic_error); // nothing read yet
  write("small.prm", "subsection Pile\n set diameter = 0.14 cm\nend\n");
  file.read("small.prm");
  file.write_resolved("resolved.prm");
  CHECK(content("resolved.prm") ==
        "# The complete case of a run, defaults included. mergel reads it back to the same "
        "bits.\n"
        "\nsubsection Pile\n"
        "  # Diameter. [value > 0]\n  set diameter = 1.4 mm\n"
        "  # Half model. [true | false]\n  set half = true\n"
        "  # Title. [text]\n  set title =\n"
        "end\n");
}

TEST_CASE("help() lists every key with unit, default and range in 92 columns",
          "[unit][apps]")
{
  Case c;
  CaseFile file;
  c.declare(file);
  int a = 0;
  {
    const auto section = file.section("Output");
    file.choice(
        "fields", a,
        {{"none", 0},
         {"every quantity that the run has at each instant", 1},
         {"only those that changed since the last one was written", 2}},
        "What is written to the folder of fields, one file for each of the instants "
        "that are asked for, or none at all.");
  }
  std::ostringstream out;
  file.help(out);
  std::istringstream lines(out.str());
  for (std::string line; std::getline(lines, line);) CHECK(line.size() <= 92);
  CHECK_THAT(
      out.str(),
      Contains("  key                unit    default    allowed\n") &&
          Contains("\nBond\n"
                   "  effective modulus  Pa      6.3e8 Pa   value > 0\n"
                   "      Modulus of the bond, Eq. 4.\n"
                   "  tensile strength   MPa     required   value > 0\n") &&
          Contains("  bending flow       -       conjugate  conjugate | published\n") &&
          Contains("  Poisson ratio      -       0.14       0 <= nu < 0.5\n") &&
          Contains("  cone angle         degree  60 degree  0 < value <= 180 degree\n") &&
          Contains("  half               -       true       true | false\n") &&
          Contains("  file               -       none       path\n"));
}
