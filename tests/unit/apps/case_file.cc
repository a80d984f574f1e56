/// Declaration of keys: optional and required ones, and keys that need a value of another.
#include "tests/support/small_case.h"

#include <cmath>
#include <stdexcept>

using namespace mergel;
using namespace mergel::apps;
using namespace mergel::apps::test;
using mergel::match::Contains;
namespace fs = std::filesystem;

TEST_CASE("A wrong declaration is reported as an error of the program", "[unit][apps]")
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
  const WorkingFolder folder;
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
    WorkingFolder folder;
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

namespace {

/// A key that follows from another, and keys of a flag.
struct Derived {
  double nu = std::nan(""), K0 = 0.0, width = std::nan("");
  bool is_on = false;
  CaseFile file;

  Derived()
  {
    const auto section = file.section("A");
    file.number("nu", nu, from_to(0.0, 0.5), "nu.");
    file.derived("K0", K0, "1", between(0.0, 0.9), "nu/(1 - nu)", "K0.");
    file.flag("effect", is_on, "An effect.");
    const auto only = file.only_if("effect", {"true"});
    file.quantity("width", width, "m", positive, "Its width.", "mm");
  }
  void read(const std::string& keys)
  {
    write("a.prm", "subsection A\n" + keys + "end\n");
    file.read("a.prm");
    file.derive("A", "K0", nu / (1.0 - nu));
  }
};

} // namespace

TEST_CASE("A default that follows from other keys is in the resolved case as a number",
          "[unit][apps]")
{
  const WorkingFolder folder;
  Derived d;
  d.read(" set nu = 0.3\n");
  CHECK(d.K0 == 0.3 / 0.7);
  CHECK_FALSE(d.file.is_given("A", "K0"));
  const std::string resolved = d.file.resolved_text();
  Derived again;
  again.file.read_text(resolved, "resolved");
  CHECK(again.K0 == 0.3 / 0.7); // the same bits, without derive()
  again.file.derive("A", "K0", 0.1);
  CHECK(again.K0 == 0.3 / 0.7);
  CHECK(again.file.resolved_text() == resolved);

  d.read(" set nu = 0.3\n set K0 = 0.5\n");
  CHECK(d.K0 == 0.5);
  CHECK_THROWS_WITH(d.read(" set nu = 0.49\n"),
                    Contains("a.prm: A/K0 = nu/(1 - nu): must satisfy 0 <= value <= 0.9"));
  CHECK_THROWS_AS(d.file.derive("A", "nu", 0.1), std::logic_error);
  std::ostringstream help;
  d.file.help(help);
  CHECK_THAT(help.str(), Contains("K0") && Contains("nu/(1 - nu)"));
}

TEST_CASE(
    "A key that has no effect is refused, and left out of the resolved case; a resolved "
    "case of an earlier version may hold it",
    "[unit][apps]")
{
  const WorkingFolder folder;
  Derived d;
  CHECK_THROWS_WITH(
      d.read(" set nu = 0.3\n set width = 1 mm\n"),
      Contains("a.prm:3: A/width = 1 mm: is a key of `effect` = true; here it "
               "is false. Leave the key out, or change `effect`."));
  d.read(" set nu = 0.3\n set effect = yes\n set width = 1 mm\n");
  CHECK(d.width == 1e-3);
  const std::string with_width = d.file.resolved_text();
  CHECK_THAT(with_width, Contains("set width = 1 mm"));
  d.read(" set nu = 0.3\n");
  CHECK_THAT(d.file.resolved_text(), !Contains("width"));

  std::string earlier = with_width;
  earlier.replace(earlier.find("effect = true"), 13, "effect = false");
  Derived again;
  again.file.read_text(earlier, "earlier");
  CHECK_FALSE(again.is_on);
  CHECK(again.file.changes_since(earlier).empty());
  CHECK_THROWS_WITH(again.file.read_text(earlier, "earlier", {"A/width=2 mm"}),
                    Contains("--set A/width = 2 mm: is a key of `effect` = true"));
}

TEST_CASE("A key that is not needed where a number is zero may be left out there only",
          "[unit][apps]")
{
  const WorkingFolder folder;
  CaseFile file;
  double n = 1.0, x = std::nan(""), y = std::nan(""), z = std::nan("");
  {
    const auto section = file.section("A");
    file.number("n", n, non_negative, "");
    file.number("x", x, any, "");
    file.number("y", y, any, "");
    file.not_needed_at_zero("A", "n", {"y"});
  }
  {
    const auto section = file.section("B");
    file.number("z", z, any, "");
    file.not_needed_at_zero("A", "n");
  }
  const auto read = [&](const std::string& a, const std::string& b) {
    write("a.prm", "subsection A\n" + a + "end\nsubsection B\n" + b + "end\n");
    file.read("a.prm");
  };
  read("set n = 0\nset x = 1\n", "");
  CHECK_FALSE(file.is_given("B", "z"));
  CHECK_THAT(file.resolved_text(), !Contains("set y") && !Contains("set z"));
  const std::string text = file.resolved_text();
  file.read_text(text, "again"); // a resolved case is read back
  CHECK(file.resolved_text() == text);

  read("set n = 0\nset x = 1\nset y = 2\n", "set z = 3\n"); // but it may be given
  CHECK(y == 2.0);
  CHECK(z == 3.0);
  CHECK_THROWS_WITH(read("set n = 0\n", ""), Contains("A/x: must be given"));
  CHECK_THROWS_WITH(read("set n = 2\nset x = 1\n", "set z = 3\n"),
                    Contains("A/y: must be given"));
  CHECK_THROWS_WITH(read("set x = 1\nset y = 1\n", ""), Contains("B/z: must be given"));
}
