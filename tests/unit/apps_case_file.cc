#include "apps/case_file.h"

#include "dem/error.h"

#include <catch2/catch.hpp>

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace mergel;
using namespace mergel::apps;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

/// A folder of its own for one test; the working folder while it lives, so that messages
/// name "pile.prm" alone.
class Folder {
public:
  Folder() : before_(fs::current_path())
  {
    std::string name = (fs::temp_directory_path() / "mergel_case_XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    path_ = name;
    fs::current_path(path_);
  }
  ~Folder()
  {
    fs::current_path(before_);
    fs::remove_all(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

private:
  fs::path before_, path_;
};

void write(const fs::path& file, const std::string& text)
{
  std::ofstream(file, std::ios::binary) << text;
}

std::string content(const fs::path& file)
{
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

enum class Flow { conjugate, published };

/// A small case with a key of each kind.
struct Case {
  double porosity = 0.52;
  fs::path sample, notes;
  std::uint64_t seed = 1;
  int bands = 4;
  double E = 0.63e9;
  double sigma_t = std::numeric_limits<double>::quiet_NaN();
  Flow flow = Flow::conjugate;
  double nu = 0.14;
  double D = std::numeric_limits<double>::quiet_NaN();
  double cone = std::numbers::pi / 3.0;
  bool is_half = true;
  std::string title, side = "free";

  void declare(CaseFile& file)
  {
    {
      const auto section = file.section("Specimen");
      file.number("porosity", porosity, inside(0.0, 1.0).named("n"), "Pores over volume.");
      file.path("file", sample, "Sample to read.");
      file.integer("seed", seed, any, "Seed of the random numbers.");
      file.integer("bands", bands, between(1, 20), "Bands of the report.");
    }
    {
      const auto section = file.section("Bond");
      file.quantity("effective modulus", E, "Pa", positive, "Modulus of the bond, Eq. 4.");
      file.quantity("tensile strength", sigma_t, "Pa", positive,
                    "Tensile strength of the bond, Eq. 6.", "MPa");
      file.choice("bending flow", flow,
                  {{"conjugate", Flow::conjugate}, {"published", Flow::published}},
                  "Flow rule of the bending moment, Eq. 7.");
    }
    {
      const auto section = file.section("Far field");
      file.number(
          "Poisson ratio", nu,
          from_to(0.0, 0.5).named("nu").advise("Use 0.49 if nearly incompressible."),
          "Poisson's ratio.");
      file.choice("side", side, {"free", "roller", "fixed"}, "Outer side.");
    }
    {
      const auto section = file.section("Pile");
      file.quantity("diameter", D, "m", above_to(0.0, 0.1), "Diameter.", "mm");
      file.quantity("cone angle", cone, "rad", above_to(0.0, std::numbers::pi),
                    "Full angle.", "degree");
      file.flag("half", is_half, "Half model.");
      file.text("title", title, "Text for the report.");
    }
  }

  bool operator==(const Case&) const = default;
};

const std::string good = R"(# a pile
subsection Bond
  set tensile strength = 1 MPa  # Table 1
end

subsection Pile
  set diameter = 1.4 mm
end
)";

/// The case read from `text`; throws as read() does.
Case read_text(const std::string& text, const std::vector<std::string>& overrides = {})
{
  write("pile.prm", text);
  Case c;
  CaseFile file;
  c.declare(file);
  file.read("pile.prm", overrides);
  return c;
}

/// The one-line message with which `text` is refused.
std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {})
{
  try {
    read_text(text, overrides);
  } catch (const InputError& error) {
    const std::string message = error.what();
    CHECK(message.find('\n') == std::string::npos);
    return message;
  }
  return "accepted";
}

/// good, with `line` appended to a section Far field; it becomes line 11.
std::string with_far_field(const std::string& line)
{
  return good + "\nsubsection Far field\n  " + line + "\nend\n";
}

std::string replaced(std::string text, const std::string& old, const std::string& fresh)
{
  const auto at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), fresh);
}

} // namespace

TEST_CASE("A case sets the variables that its keys are bound to", "[unit][apps]")
{
  const Folder folder;
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
  const Folder folder;
  std::string dos = "\xEF\xBB\xBF";
  for (const char c : good) dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
  CHECK(read_text(dos) == read_text(good));
}

TEST_CASE("--set overrides the file and names itself in messages", "[unit][apps]")
{
  const Folder folder;
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
  const Folder folder;
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
  const Folder folder;
  CHECK_THAT(refusal(replaced(good, "1 MPa", "\\\n  \\\n 1") + "\n"),
             Contains("pile.prm:3: Bond/tensile strength = 1: has no unit"));
}

TEST_CASE("Unknown keys and sections are refused with the likeliest meant", "[unit][apps]")
{
  const Folder folder;
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
  const Folder folder;
  const std::string hint = "/tensile strength: must be given, it has no default. "
                           "Write \"set tensile strength = ...\", for example 0.63 GPa.";
  CHECK(refusal(replaced(good, "set tensile strength = 1 MPa", "")) ==
        "pile.prm:2: Bond" + hint);
  const std::string pile_only = "subsection Pile\n  set diameter = 1 mm\nend\n";
  CHECK(refusal(pile_only) == "pile.prm: Bond" + hint);
  CHECK_THAT(refusal(""), Contains("pile.prm: Bond" + hint));
  CHECK(read_text(pile_only, {"Bond/tensile strength=3 MPa"}).sigma_t == 3e6);
}

TEST_CASE("A case file of broken shape is refused at the broken line", "[unit][apps]")
{
  const Folder folder;
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

TEST_CASE("A path that is no case file is refused", "[unit][apps]")
{
  const Folder folder;
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

TEST_CASE("where() names the line, --set or the default of a key", "[unit][apps]")
{
  const Folder folder;
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

  // a second read forgets the first
  file.read("pile.prm");
  CHECK(c.side == "free");
  CHECK_FALSE(file.is_given("Far field", "side"));
}

TEST_CASE("The resolved case sets every variable to the same bits", "[unit][apps]")
{
  const Folder folder;
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

  // what the program makes of the values later does not leak into the case
  c.sigma_t *= 1.1;
  first.write_resolved("later.prm");
  CHECK(content("later.prm") == content("resolved.prm"));
}

TEST_CASE("The resolved case is commented text with units", "[unit][apps]")
{
  const Folder folder;
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

TEST_CASE("A relative path starts at the case's folder, from --set at the working folder",
          "[unit][apps]")
{
  const Folder folder;
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

TEST_CASE("A wrong declaration is the program's fault", "[unit][apps]")
{
  CaseFile file;
  double x = -1.0;
  int n = 3;
  std::string name = "none";
  CHECK_THROWS_AS(file.number("x", x, any, ""), std::logic_error); // no section open
  const auto section = file.section("A");
  CHECK_THROWS_AS(file.section("B"), std::logic_error); // A is open
  CHECK_THROWS_AS(file.number("x", x, positive, ""), std::logic_error);
  CHECK_THROWS_AS(file.quantity("x", x, "metre per", any, ""), std::logic_error);
  CHECK_THROWS_AS(file.integer("n", n, between(0, 2), ""), std::logic_error);
  CHECK_THROWS_AS(file.choice("name", name, {"a", "b"}, ""), std::logic_error);
  file.number("y", x, any, "");
  CHECK_THROWS_AS(file.number("y", x, any, ""), std::logic_error); // twice
}

TEST_CASE("Keys of any kind may be required", "[unit][apps]")
{
  const Folder folder;
  write("a.prm", "subsection A\nend\n");
  const auto message = [](auto&& declare) -> std::string {
    CaseFile file;
    {
      const auto section = file.section("A");
      declare(file);
    }
    try {
      file.read("a.prm");
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  int n = 0;
  std::string text;
  fs::path path;
  const std::string start = "a.prm:1: A/k: must be given, it has no default. "
                            "Write \"set k = ...\", ";
  CHECK(message([&](CaseFile& f) { f.integer("k", n, any, "", Default::none); }) ==
        start + "a whole number.");
  CHECK(message([&](CaseFile& f) {
          f.choice("k", text, {"a", "b"}, "", Default::none);
        }) == start + "one of a | b.");
  CHECK(message([&](CaseFile& f) { f.text("k", text, "", Default::none); }) ==
        start + "a text.");
  CHECK(message([&](CaseFile& f) { f.path("k", path, "", Default::none); }) ==
        start + "the name of a file.");
}

namespace {

/// Two laws: each with a key of its own, and one name in both.
struct Laws {
  std::string law = "soft";
  double strength_soft = 1.0, strength_hard = std::numeric_limits<double>::quiet_NaN();
  double rate = 2.0;

  void declare(CaseFile& file)
  {
    const auto section = file.section("Bond");
    file.choice("law", law, std::vector<std::string>{"soft", "hard"}, "Which law.");
    {
      const auto only = file.only_if("law", {"soft"});
      file.quantity("strength", strength_soft, "Pa", positive, "Of the soft law.");
      file.number("rate", rate, positive, "Of softening.");
    }
    const auto only = file.only_if("law", {"hard"});
    file.quantity("strength", strength_hard, "Pa", positive, "Of the hard law.");
  }

  void read(const std::string& text, const std::vector<std::string>& set = {})
  {
    Folder folder;
    write("case.prm", text);
    CaseFile file;
    declare(file);
    file.read("case.prm", set);
    file.write_resolved("resolved.prm");
    resolved = content("resolved.prm");
    CaseFile again;
    Laws other;
    other.declare(again);
    again.read("resolved.prm"); // what is written is read back
  }
  std::string resolved;
};

} // namespace

TEST_CASE("keys under a condition exist only where it holds", "[unit][apps]")
{
  Laws soft;
  soft.read("subsection Bond\n set strength = 3 Pa\nend\n");
  CHECK(soft.strength_soft == 3.0);
  CHECK(std::isnan(soft.strength_hard));
  CHECK_THAT(soft.resolved, Contains("set rate"));

  Laws hard;
  hard.read("subsection Bond\n set law = hard\n set strength = 3 Pa\nend\n");
  CHECK(hard.strength_hard == 3.0);
  CHECK(hard.strength_soft == 1.0);
  CHECK_THAT(hard.resolved, !Contains("set rate"));

  CHECK_THROWS_WITH(Laws().read("subsection Bond\n set law = hard\n set strength = 3 Pa\n"
                                " set rate = 1\nend\n"),
                    "case.prm:4: Bond/rate = 1: is a key of `law` = soft; here it is hard. "
                    "Leave the key out, or change `law`.");
  CHECK_THROWS_WITH(Laws().read("subsection Bond\n set law = hard\nend\n"),
                    Contains("Bond/strength: must be given"));
  CHECK_THROWS_WITH(Laws().read("", {"Bond/law=hard", "Bond/strength=1 Pa", "Bond/rate=1"}),
                    Contains("--set Bond/rate = 1: is a key of `law` = soft"));

  CaseFile file;
  Laws laws;
  laws.declare(file);
  std::ostringstream help;
  file.help(help);
  CHECK_THAT(help.str(), Contains("Where law = hard: Of the hard law."));
}

TEST_CASE("two keys of one name need conditions that exclude each other", "[unit][apps]")
{
  CaseFile file;
  std::string law = "soft";
  double x = 1.0;
  const auto section = file.section("Bond");
  file.choice("law", law, std::vector<std::string>{"soft", "hard"}, "Which law.");
  CHECK_THROWS_AS(file.only_if("flaw", {"soft"}), std::logic_error);
  const auto only = file.only_if("law", {"soft"});
  file.number("x", x, positive, "One.");
  CHECK_THROWS_AS(file.number("x", x, positive, "Two."), std::logic_error);
  CHECK_THROWS_AS(file.only_if("law", {"hard"}), std::logic_error);
}
