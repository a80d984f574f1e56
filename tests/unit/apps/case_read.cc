/// Reading a case: its values, and the place and remedy of each error.
#include "tests/support/small_case.h"

#include <unistd.h>

using namespace mergel;
using namespace mergel::apps;
using namespace mergel::apps::test;
using mergel::match::Contains;
namespace fs = std::filesystem;

TEST_CASE("A case sets the variables that its keys are bound to", "[unit][apps]")
{
  const WorkingFolder folder;
  const Case c = read_text(R"(
subsection Bond
  set tensile strength = 2.5 MPa # comment
  SET bending flow     = publi\
    shed
  set effective modulus=1.1 GPa
end
subsection Specimen
  set seed = 9223372036854775807
  set file = samples/a.h5
end
subsection Pile
	set diameter	=	1.4 mm
  set cone angle = 90 degree
  set half = no
  set title = q_c = 3 "MPa"
end
subsection Bond
end
)");
  CHECK(c.sigma_t == 2.5e6);
  CHECK(c.flow == Flow::published);
  CHECK(c.E == 1.1e9);
  CHECK(c.seed == 9223372036854775807u);
  CHECK(c.D == 1.4e-3);
  CHECK(c.cone == Approx(std::numbers::pi / 2.0).epsilon(1e-15)); // factor pi/180 rounded
  CHECK_FALSE(c.is_half);
  CHECK(c.title == "q_c = 3 \"MPa\"");
  // keys left out keep their defaults
  CHECK(c.porosity == 0.52);
  CHECK(c.nu == 0.14);
  CHECK(c.side == "free");
}

TEST_CASE("A case with carriage returns and a byte order mark reads the same",
          "[unit][apps]")
{
  const WorkingFolder folder;
  std::string dos = "\xEF\xBB\xBF";
  std::string mac = dos;
  for (const char c : good) dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
  for (const char c : good) mac += c == '\n' ? '\r' : c;
  CHECK(read_text(dos) == read_text(good));
  CHECK(read_text(mac) == read_text(good));
}

TEST_CASE("--set overrides the file and is named in messages", "[unit][apps]")
{
  const WorkingFolder folder;
  const Case c = read_text(
      good, {"Pile/diameter=2 mm", " Far field / Poisson ratio = 0.3", "Pile/title=a=b/c"});
  CHECK(c.D == 2e-3);
  CHECK(c.nu == 0.3);
  CHECK(c.title == "a=b/c");

  CHECK(refusal(good, {"Far field/Poisson ratio=0.6"}) ==
        "--set Far field/Poisson ratio = 0.6: must satisfy 0 <= nu < 0.5. "
        "Use 0.49 if nearly incompressible.");
  CHECK(refusal(good, {"Pile/diametre=2 mm"}) ==
        "--set Pile/diametre = 2 mm: unknown key in section \"Pile\". "
        "Did you mean \"diameter\"?");
  CHECK(refusal(good, {"Pil/diameter=2 mm"}) ==
        "--set Pil/diameter = 2 mm: unknown section \"Pil\". Did you mean \"Pile\"?");
  const std::string form = ": is not understood. Write --set \"Section/key=value\".";
  CHECK(refusal(good, {"diameter=2 mm"}) == "--set \"diameter=2 mm\"" + form);
  CHECK(refusal(good, {"diameter=1/2 mm"}) == "--set \"diameter=1/2 mm\"" + form);
  CHECK(refusal(good, {"Pile/diameter"}) == "--set \"Pile/diameter\"" + form);
  CHECK(refusal(good, {"Pile/diameter=2 mm", "Pile/diameter=3 mm"}) ==
        "--set Pile/diameter = 3 mm: already given by another --set (2 mm). "
        "Keep one of the two.");
  CHECK_THAT(refusal(good, {"Pile/title=a#b"}),
             Contains("--set Pile/title = a#b: must be one line without '#'"));
}

TEST_CASE("A value that cannot be used is refused at its line", "[unit][apps]")
{
  const WorkingFolder folder;
  CHECK(refusal(with_far_field("set Poisson ratio = 0.6")) ==
        "pile.prm:11: Far field/Poisson ratio = 0.6: must satisfy 0 <= nu < 0.5. "
        "Use 0.49 if nearly incompressible.");

  const auto diameter = [](const std::string& value) {
    return refusal(replaced(good, "1.4 mm", value));
  };
  const std::string place = "pile.prm:7: Pile/diameter = ";
  const std::string expected =
      "; expected a number with a unit such as m, for example 1.4 mm.";
  CHECK(diameter("1.4") == place + "1.4: has no unit" + expected);
  CHECK(diameter("1.4 MPa") ==
        place + "1.4 MPa: unit \"MPa\" has the wrong dimension" + expected);
  CHECK(diameter("wide") == place + "wide: is not a number" + expected);
  CHECK(diameter("nan mm") == place + "nan mm: is not a finite number" + expected);
  CHECK(diameter("inf") == place + "inf: is not a finite number" + expected);
  CHECK(diameter("") == place + ": no value is given" + expected);
  CHECK(diameter("0 mm") == place + "0 mm: must satisfy 0 < value <= 100 mm. Diameter.");
  CHECK(diameter("1 m") == place + "1 m: must satisfy 0 < value <= 100 mm. Diameter.");

  CHECK(refusal(replaced(good, "1 MPa", "-1 MPa")) ==
        "pile.prm:3: Bond/tensile strength = -1 MPa: must satisfy value > 0. "
        "Tensile strength of the bond, Eq. 6.");
  CHECK(refusal(with_far_field("set side = rolller")) ==
        "pile.prm:11: Far field/side = rolller: must be one of free | roller | fixed. "
        "Did you mean \"roller\"?");
  CHECK(
      refusal(with_far_field("set side = moving freely")) ==
      "pile.prm:11: Far field/side = moving freely: must be one of free | roller | fixed. "
      "Outer side.");
  CHECK(refusal(good, {"Pile/half=maybe"}) ==
        "--set Pile/half = maybe: must be true or false. Half model.");
  CHECK(refusal(good, {"Specimen/bands=2.5"}) ==
        "--set Specimen/bands = 2.5: is not a whole number. Bands of the report.");
  CHECK(refusal(good, {"Specimen/bands=21"}) ==
        "--set Specimen/bands = 21: must satisfy 1 <= value <= 20. Bands of the report.");
  CHECK(refusal(good, {"Specimen/bands=3000000000"}) ==
        "--set Specimen/bands = 3000000000: must lie between -2147483648 and 2147483647. "
        "Bands of the report.");
  CHECK_THAT(refusal(good, {"Specimen/seed=-1"}),
             Contains("must lie between 0 and 92233720"));
}

TEST_CASE("A value is refused at the first line of a continued key", "[unit][apps]")
{
  const WorkingFolder folder;
  CHECK_THAT(refusal(replaced(good, "1 MPa", "\\\n  \\\n 1") + "\n"),
             Contains("pile.prm:3: Bond/tensile strength = 1: has no unit"));
}

TEST_CASE("Unknown keys and sections are refused with the most likely name", "[unit][apps]")
{
  const WorkingFolder folder;
  CHECK(refusal(replaced(good, "set diameter", "set diametr")) ==
        "pile.prm:7: Pile/diametr = 1.4 mm: unknown key in section \"Pile\". "
        "Did you mean \"diameter\"?");
  CHECK(refusal(with_far_field("set diameter = 3 mm")) ==
        "pile.prm:11: Far field/diameter = 3 mm: unknown key in section \"Far field\". "
        "It belongs to section \"Pile\".");
  CHECK(refusal(with_far_field("set colour = red")) ==
        "pile.prm:11: Far field/colour = red: unknown key in section \"Far field\". "
        "Its keys are Poisson ratio, side.");
  CHECK(refusal(replaced(good, "subsection Pile", "subsection Piles")) ==
        "pile.prm:6: unknown section \"Piles\". Did you mean \"Pile\"?");
  CHECK(refusal(good + "subsection Weather\nend\n") ==
        "pile.prm:9: unknown section \"Weather\". There are Specimen, Bond, Far field, "
        "Pile.");
}

TEST_CASE("A required key that is missing is refused, unless --set gives it",
          "[unit][apps]")
{
  const WorkingFolder folder;
  const std::string hint = "/tensile strength: must be given, it has no default. "
                           "Write \"set tensile strength = ...\", for example 0.63 GPa.";
  CHECK(refusal(replaced(good, "set tensile strength = 1 MPa", "")) ==
        "pile.prm:2: Bond" + hint);
  const std::string pile_only = "subsection Pile\n  set diameter = 1 mm\nend\n";
  CHECK(refusal(pile_only) == "pile.prm: Bond" + hint);
  CHECK_THAT(refusal(""), Contains("pile.prm: Bond" + hint));
  CHECK(read_text(pile_only, {"Bond/tensile strength=3 MPa"}).sigma_t == 3e6);
}

TEST_CASE("A case file with wrong syntax is refused at the wrong line", "[unit][apps]")
{
  const WorkingFolder folder;
  CHECK(
      refusal(replaced(good, "mm\nend", "mm")) ==
      "pile.prm:6: subsection \"Pile\" is never closed. Write \"end\" after its last key.");
  CHECK(refusal(replaced(good, "Table 1\nend", "")) ==
        "pile.prm:5: subsection \"Pile\" opens inside \"Bond\" of line 2. "
        "Write \"end\" before it.");
  CHECK(refusal(good + "end\n") ==
        "pile.prm:9: \"end\" without a subsection to close. Remove it.");
  CHECK(refusal(replaced(good, "mm\nend", "mm\nend Pile")) ==
        "pile.prm:8: \"Pile\" after \"end\". Put it in a line of its own.");
  CHECK(refusal("diameter = 3 mm\n") ==
        "pile.prm:1: \"diameter = 3 mm\" is not understood. "
        "Write \"subsection NAME\", \"set KEY = VALUE\" or \"end\".");
  CHECK(refusal("include other.prm\n")
            .starts_with("pile.prm:1: \"include other.prm\" is not"));
  CHECK(refusal("set diameter = 3 mm\n") ==
        "pile.prm:1: diameter = 3 mm: stands outside the sections. "
        "Put it between \"subsection NAME\" and \"end\".");
  CHECK(refusal(with_far_field("set side")) ==
        "pile.prm:11: \"set side\" has no \"=\". Write \"set KEY = VALUE\".");
  CHECK(refusal(with_far_field("set = 3")) ==
        "pile.prm:11: \"set\" without a key. Write \"set KEY = VALUE\".");
  CHECK(refusal("subsection\n") == "pile.prm:1: subsection without a name.");
  CHECK(refusal(good + "subsection Pile\n  set diameter = 2 mm\nend\n") ==
        "pile.prm:10: Pile/diameter = 2 mm: already set in line 7. Keep one of the two.");
}

TEST_CASE("A path that is not a case file is refused", "[unit][apps]")
{
  const WorkingFolder folder;
  const auto message = [](const fs::path& path) -> std::string {
    Case c;
    CaseFile file;
    c.declare(file);
    try {
      file.read(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  CHECK(message("none.prm") ==
        "none.prm: no such case file. Check its name and the working folder.");
  CHECK(message("none/none.prm") ==
        "none/none.prm: no such case file. Check its name and the working folder.");
  fs::create_directory("cases");
  CHECK(message("cases") == "cases: is a folder, not a case file. Name a .prm file.");
  write("sample.h5", std::string("\x89HDF\0\0", 6));
  CHECK(message("sample.h5") == "sample.h5: is no text file. Name a .prm file.");
  write("large.prm", std::string((1 << 20) + 1, ' '));
  CHECK(message("large.prm") ==
        "large.prm: is larger than 1 MB and no case file. Name a .prm file.");
  CHECK_THAT(message("/proc/self/mem"), Contains("/proc/self/mem: "));
  if (geteuid() != 0) { // root may read everything
    write("locked.prm", good);
    fs::permissions("locked.prm", fs::perms::none);
    CHECK(message("locked.prm") ==
          "locked.prm: cannot be read (Permission denied). Check its permissions.");
  }
}

TEST_CASE("An empty --set takes back an optional number, and makes an optional text empty",
          "[unit][apps]")
{
  const WorkingFolder folder;
  write("pile.prm", good);
  Case c;
  CaseFile file;
  c.declare(file);
  file.read("pile.prm", {"Far field/Poisson ratio=", "Far field/side=", "Pile/title="});
  CHECK(c.nu == 0.14);
  CHECK(c.side == "free");
  CHECK(c.title.empty());
  CHECK_FALSE(file.is_given("Far field", "Poisson ratio"));
  CHECK(file.is_given("Pile", "title"));
  CHECK_THROWS_WITH(file.read("pile.prm", {"Pile/diameter="}),
                    Contains("--set Pile/diameter = : no value is given"));
}

TEST_CASE("where() names the line, --set or the default of a key", "[unit][apps]")
{
  const WorkingFolder folder;
  write("pile.prm", good);
  Case c;
  CaseFile file;
  c.declare(file);
  CHECK_THROWS_AS(file.where("Pile", "diameter"), std::logic_error); // nothing read yet

  file.read("pile.prm", {"Far field/side=fixed"});
  CHECK(file.where("Pile", "diameter") == "pile.prm:7: Pile/diameter");
  CHECK(file.where("Far field", "side") == "--set Far field/side");
  CHECK(file.where("Pile", "cone angle") == "pile.prm: Pile/cone angle");
  CHECK(file.is_given("Far field", "side"));
  CHECK_FALSE(file.is_given("Pile", "cone angle"));
  CHECK_THROWS_AS(file.where("Pile", "colour"), std::logic_error);
  CHECK_THROWS_WITH(file.refuse("Pile", "diameter", "is wider than the specimen."),
                    "pile.prm:7: Pile/diameter = 1.4 mm: is wider than the specimen.");
  CHECK_THROWS_AS(file.refuse("Pile", "diameter", ""), InputError);

  // a second read discards the first
  file.read("pile.prm");
  CHECK(c.side == "free");
  CHECK_FALSE(file.is_given("Far field", "side"));
}

TEST_CASE(
    "A relative path starts at the folder of the case, from --set at the working folder",
    "[unit][apps]")
{
  const WorkingFolder folder;
  fs::create_directory("cases");
  write("cases/pile.prm", good + "subsection Specimen\n set file = ../a.h5\nend\n");
  Case c;
  CaseFile file;
  c.declare(file);
  file.read("cases/pile.prm");
  CHECK(c.sample == fs::current_path() / "a.h5");
  file.read("cases/pile.prm", {"Specimen/file=b.h5"});
  CHECK(c.sample == fs::current_path() / "b.h5");
  file.read("cases/pile.prm", {"Specimen/file="});
  CHECK(c.sample.empty());
  file.read("cases/pile.prm", {"Specimen/file=\"my rock/b.h5\""});
  CHECK(c.sample == fs::current_path() / "my rock/b.h5");
}

TEST_CASE("A list of paths is resolved to absolute ones, which are read back from anywhere",
          "[unit][apps]")
{
  const WorkingFolder folder;
  const fs::path here = fs::current_path();
  fs::create_directory("cases");
  write("cases/c.prm", "subsection Analysis\n set runs = ../a \"state B\" /c\nend\n");
  std::vector<fs::path> runs;
  CaseFile file;
  {
    const auto section = file.section("Analysis");
    file.paths("runs", runs, "Folders.");
  }
  file.read("cases/c.prm");
  const std::vector<fs::path> expected{here / "a", here / "cases/state B", "/c"};
  CHECK(runs == expected);
  write("resolved.prm", file.resolved_text());
  fs::current_path("cases");
  runs.clear();
  file.read("../resolved.prm");
  CHECK(runs == expected);
  file.read_text(file.resolved_text(), "its case", {"Analysis/runs=\"d e\""});
  CHECK(runs == std::vector<fs::path>{here / "cases/d e"});
  file.read("../resolved.prm", {"Analysis/runs="});
  CHECK(runs.empty());
  CHECK_THROWS_WITH(
      file.read("../resolved.prm", {"Analysis/runs=\"d e"}),
      mergel::match::StartsWith("--set Analysis/runs = \"d e: has a quotation mark that is "
                                "never closed"));
  CHECK_THROWS_WITH(file.read("../resolved.prm", {"Analysis/runs=a \"\""}),
                    Contains("has a name without a letter"));
  fs::current_path(here);
}
