#include "apps/pile/pile_case.h"
#include "dem/error.h"
#include "tests/support/catch.h"
#include "tests/support/repository.h"
#include "tests/support/shipped_case.h"

using namespace mergel;
using namespace mergel::apps;
using mergel::match::Contains;
using Kind = PileStage::Kind;

TEST_CASE("A loading stage of a pile is read as it is written", "[unit][apps]")
{
  const PileStage first = read_pile_stage("penetrate to depth = 8.4 mm");
  CHECK(first.kind == Kind::penetrate);
  CHECK(first.target == 8.4e-3);
  CHECK(read_pile_stage("hold").target == 0.0);
  CHECK(read_pile_stage("hold for 0.2 ms").target == 0.2e-3);
  CHECK(read_pile_stage("unload to head force=0 N").kind == Kind::unload);
  CHECK(read_pile_stage("load to head force = 0.05 kN").target == 50.0);
  CHECK(read_pile_stage("pull to displacement = 100 um").target == 100e-6);
  const PileStage push = read_pile_stage("push to displacement = -0.1 mm at height = 2 mm");
  CHECK(push.kind == Kind::push);
  CHECK(push.target == -0.1e-3);
  CHECK(push.height == 2e-3);
  for (const char* text :
       {"penetrate to depth = 8.4 mm", "hold", "hold for 0.2 ms",
        "unload to head force = 0 N", "load to head force = 50 N",
        "pull to displacement = 0.1 mm", "push to displacement = 0.1 mm at height = 2 mm"})
    CHECK(name_of(read_pile_stage(text)) == text);
}

TEST_CASE("A stage of a pile that is not understood is refused with the forms expected",
          "[unit][apps]")
{
  const auto message = [](const std::string& text) -> std::string {
    try {
      read_pile_stage(text);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  CHECK_THAT(message("penetrat to depth = 1 mm"), Contains("did you mean \"penetrate\"?"));
  CHECK_THAT(message("rotate to depth = 1 mm"),
             Contains("a stage reads: penetrate to depth"));
  CHECK_THAT(message("penetrate depth = 1 mm"), Contains("there is no `to`"));
  CHECK_THAT(message("penetrate to 1 mm"), Contains("\"depth = ...\""));
  CHECK_THAT(message("penetrate to head force = 1 N"), Contains("\"depth = ...\""));
  CHECK_THAT(message("penetrate to depth = 1"), Contains("unit"));
  CHECK_THAT(message("load to head force = 1 mm"), Contains("dimension"));
  CHECK_THAT(message("hold until rest"), Contains("is not understood"));
  CHECK_THAT(message("hold for 0 s"), Contains("above 0 s"));
  CHECK_THAT(message("pull to displacement = -1 mm"), Contains("a pull goes upwards"));
  CHECK_THAT(message("unload to head force = -1 N"), Contains("at least 0 N"));
  CHECK_THAT(message("push to displacement = 1 mm"), Contains("at height = 2 mm"));
  CHECK_THAT(message("push to displacement = 1 mm at height = -2 mm"),
             Contains("at least 0"));
}

namespace {

/// What is wrong with these stages of a pile of 1.4 mm with a tip of 1.2 mm in a region of
/// 12 mm; "" for nothing.
std::string fault(const std::vector<std::string>& texts)
{
  std::vector<PileStage> stages;
  for (const std::string& text : texts) stages.push_back(read_pile_stage(text));
  const auto found = find_fault(stages, {1.2e-3, 1.4e-3, 12e-3});
  return found ? std::to_string(found->stage + 1) + ": " + found->message : "";
}

const std::string deep = "penetrate to depth = 2.8 mm", hold = "hold",
                  free_head = "unload to head force = 0 N",
                  push = "push to displacement = 0.1 mm at height = 2 mm";

} // namespace

TEST_CASE("Stages of a pile that can follow each other are taken", "[unit][apps]")
{
  CHECK(fault({deep, hold, free_head, "penetrate to depth = 3 mm", hold,
               "load to head force = 50 N", free_head, push, hold,
               "push to displacement = 0 mm at height = 2 mm"}) == "");
  CHECK(fault({deep, free_head, deep}) == ""); // back to where it was unloaded
  CHECK(fault({deep, "pull to displacement = 0.1 mm", deep}) == "");
  CHECK(fault({"penetrate to depth = -1 mm"}) == ""); // the cone alone, in part
}

TEST_CASE("A stage of a pile that cannot follow another is refused with a remedy",
          "[unit][apps]")
{
  CHECK_THAT(fault({hold}), Contains("1: the pile stands on the surface"));
  CHECK_THAT(fault({"penetrate to depth = -1.2 mm"}), Contains("above -1.2 mm"));
  CHECK_THAT(fault({"penetrate to depth = 9.5 mm"}),
             Contains("less than a diameter above the floor"));
  CHECK_THAT(fault({deep, deep}), Contains("2: the pile is 2.8 mm deep"));
  CHECK_THAT(fault({deep, free_head, "penetrate to depth = 2.7 mm"}),
             Contains("3: the pile is 2.8 mm deep after the stage before"));
  CHECK_THAT(fault({deep, "pull to displacement = 4 mm"}),
             Contains("would leave the rock"));
  CHECK_THAT(
      fault({deep, "load to head force = 50 N", hold, "unload to head force = 60 N"}),
      Contains("4: the head force is 50 N"));
  CHECK_THAT(fault({deep, free_head, "load to head force = 0 N"}),
             Contains("a load must be larger"));
  CHECK_THAT(fault({deep, push}), Contains("put the stage `hold` before it"));
  CHECK_THAT(fault({"penetrate to depth = -0.5 mm", hold, push}),
             Contains("is not below the surface"));
  CHECK_THAT(fault({deep, hold, push, "penetrate to depth = 3 mm"}), Contains("leans"));
  CHECK_THAT(fault({deep, hold, push, push}), Contains("is there already"));
  CHECK_THAT(fault({deep, hold, push, "push to displacement = 0 mm at height = 1 mm"}),
             Contains("at one point, at height = 2 mm"));
  CHECK_THAT(fault({deep, hold, "push to displacement = 2 mm at height = 1 mm"}),
             Contains("at most a pile diameter"));
}

namespace {

PileCase read_stages(const std::vector<std::string>& set)
{
  CaseFile file;
  PileCase c;
  declare(file, c);
  file.read_text(mergel::test::without("pile_small.prm", {"final depth"}), "case.prm", set);
  complete(file, c);
  // The resolved case is the same case.
  CaseFile again;
  PileCase same;
  declare(again, same);
  again.read_text(file.resolved_text(), "resolved.prm");
  complete(again, same);
  CHECK(same.stages == c.stages);
  CHECK(again.resolved_text() == file.resolved_text());
  return c;
}

std::string refusal(const std::vector<std::string>& set)
{
  try {
    read_stages(set);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

} // namespace

TEST_CASE("A case has as many stages as it gives", "[unit][apps]")
{
  std::vector<std::string> set;
  for (int k = 1; k <= 40; ++k)
    set.push_back("Loading/stage " + std::to_string(k) +
                  "=penetrate to depth = " + std::to_string(k) + "e-1 mm");
  CHECK(read_stages(set).stages.size() == 40);
  set[39] = "Loading/stage 40="; // empty: left out
  CHECK(read_stages(set).stages.size() == 39);
}

TEST_CASE("A final depth is the short form of one stage", "[unit][apps]")
{
  CaseFile file;
  PileCase c;
  declare(file, c);
  file.read(mergel::test::repository() / "apps/cases/pile_small.prm");
  complete(file, c);
  CHECK(c.stages == read_stages({"Loading/stage 1=penetrate to depth = 2.8 mm"}).stages);
  CHECK_FALSE(c.has_stages());
}

TEST_CASE("What the head needs follows from the case", "[unit][apps]")
{
  const PileCase c = read_stages({"Loading/stage 1=penetrate to depth = 2.8 mm"});
  CHECK(c.mass == Approx(7850.0 * 0.25 * dem::pi * 1.4e-3 * 1.4e-3 * 12e-3));
  CHECK(c.displacement_rate == Approx(0.135));
  CHECK(c.force_ramp == Approx(0.25 * 1.4e-3 / 1.35));
  CHECK(c.balance_tolerance == 1e-3);
  CHECK(c.largest_settlement == Approx(0.14e-3));
  CHECK(c.inertia().mass == 0.5 * c.mass); // of the half model
}

TEST_CASE("Keys of stages that contradict each other are refused by their place",
          "[unit][apps]")
{
  CHECK_THAT(refusal({}), Contains("Pile/final depth") && Contains("must be given"));
  CHECK_THAT(
      refusal({"Pile/final depth=2 mm", "Loading/stage 1=penetrate to depth = 2 mm"}),
      Contains("--set Pile/final depth = 2 mm: is the short form of one stage") &&
          Contains("keep one of the two"));
  CHECK_THAT(refusal({"Loading/stage 1=penetrate to depth = 2 mm", "Loading/stage 3=hold"}),
             Contains("--set Loading/stage 3 = hold: there is no `stage 2`"));
  CHECK_THAT(refusal({"Loading/stage 0=hold"}), Contains("unknown key"));
  CHECK_THAT(refusal({"Loading/stage 01=hold"}), Contains("unknown key"));
  CHECK_THAT(refusal({"Loading/stage 1=penetrate to depth = 2 mm", "Loading/stage 2=hodl"}),
             Contains("--set Loading/stage 2 = hodl: the kind of stage"));
  CHECK_THAT(refusal({"Loading/stage 1=penetrate to depth = 2 mm",
                      "Loading/stage 2=penetrate to depth = 1 mm"}),
             Contains("--set Loading/stage 2") && Contains("the depth must be larger"));
  for (const char* key :
       {"Pile/mass=1 g", "Loading/force ramp=1 ms", "Loading/displacement rate=1 m/s",
        "Loading/largest settlement=1 mm", "Loading/unbalanced-force tolerance=1e-2"})
    CHECK_THAT(refusal({"Pile/final depth=2 mm", key}), Contains("has no effect with"));
}
