#include "tests/support/catch.h"

#include "apps/element/loading_stages.h"

#include "apps/case/cycles.h"
#include "dem/error.h"

#include <cmath>

using namespace mergel;
using namespace mergel::apps;
using mergel::match::Contains;

TEST_CASE("A loading stage is read as it is written", "[unit][apps]")
{
  const auto one = [](const std::string& text) {
    const auto stages = read_stages(text);
    REQUIRE(stages.size() == 1);
    return stages.front();
  };
  const dem::LoadingStage iso = one("isotropic to p = 5 MPa");
  CHECK(iso.kind == dem::PathKind::isotropic);
  CHECK(iso.quantity == dem::Quantity::p);
  CHECK(iso.target == 5e6);
  CHECK(one("oedometer to axial strain = 12.5 %").target == 0.125);
  CHECK(one("oedometer to volumetric strain=0.1").target == 0.1);
  CHECK(one("tension to axial strain = -1 percent").target == -0.01);
  const dem::LoadingStage at = one("triaxial at 250 kPa to axial strain = 15 %");
  CHECK(at.has_lateral);
  CHECK(at.lateral == 250e3);
  CHECK_FALSE(one("triaxial to q = 2 MPa").has_lateral);
  CHECK(one("radial dq/dp = 1.5 to p = 8 MPa").slope == 1.5);
  CHECK(std::isinf(one("radial dq/dp = inf to q = 1 MPa").slope));
  CHECK(one("unload to lateral stress = 0.1 MPa").kind == dem::PathKind::resume);

  const auto both = read_stages("unload-reload to q = 0.2 MPa");
  REQUIRE(both.size() == 2);
  CHECK(both[0].target == 0.2e6);
  CHECK(both[1].returns);
}

TEST_CASE(
    "Stages have the numbers and the words of the case; an unload-reload has parts a and b",
    "[unit][apps]")
{
  const StageTexts texts{{1, "oedometer to axial stress = 5000 kPa"},
                         {2, "unload-reload to axial stress = 1 MPa"},
                         {3, "resume to axial stress = 10 MPa"}};
  std::vector<std::string> found;
  for (const StageLabel& label : labels_of(texts))
    found.push_back(label.name() + ": " + label.text);
  CHECK(found ==
        std::vector<std::string>{"1: oedometer to axial stress = 5000 kPa",
                                 "2a: unload-reload to axial stress = 1 MPa, unloading",
                                 "2b: unload-reload to axial stress = 1 MPa, reloading",
                                 "3: resume to axial stress = 10 MPa"});
  CHECK(labels_of(texts)[2].number == 2);
  CHECK(labels_of(texts)[2].part == 2);
  CHECK(labels_of(texts)[2].cycle == 1); // not named, where there is one
  const auto loops = labels_of({{1, "unload-reload to q = 1 MPa, 2 times"}});
  REQUIRE(loops.size() == 4);
  CHECK(loops[3].name() == "1b of cycle 2");
  CHECK(loops[1].name() == "1b of cycle 1");
  CHECK(loops[1].cycle == 1);
}

TEST_CASE(
    "A test goes on with other stages to come, not with others up to the one under way",
    "[unit][apps]")
{
  const auto read = [](const std::vector<std::string>& texts) {
    StageTexts stages;
    for (const std::string& text : texts) stages[stages.size() + 1] = text;
    return stages;
  };
  const std::string shear = "triaxial to q = 2 MPa", loop = "unload-reload to q = 1 MPa",
                    unload = "unload to q = 1 MPa", on = "resume to q = 3 MPa";
  const auto earlier = read({shear, loop, on});
  CHECK(may_go_on(earlier, read({shear, unload}), 1));
  CHECK(may_go_on(earlier, read({shear, loop}), 3));
  CHECK_FALSE(may_go_on(earlier, read({shear, on}), 2));
  CHECK_FALSE(may_go_on(earlier, read({shear}), 2));
  // Of the loop only the unloading was begun: it stays a loop, and an unloading stays one.
  CHECK_FALSE(may_go_on(earlier, read({shear, unload, on}), 2));
  CHECK_FALSE(may_go_on(read({shear, unload}), read({shear, loop}), 2));
  // A further cycle is no stage of its own: the records of both have been written as stage 2.
  const auto cycles = read({shear, loop + ", 2 times"});
  for (const std::size_t n_begun : {4u, 5u}) {
    CHECK(may_go_on(cycles, read({shear, loop + ", 3 times"}), n_begun));
    CHECK_FALSE(may_go_on(cycles, read({shear, loop, loop}), n_begun));
    CHECK_FALSE(may_go_on(read({shear, loop, loop}), cycles, n_begun));
  }
  CHECK(may_go_on(cycles, read({shear, loop, loop}), 3));
  CHECK_FALSE(may_go_on(cycles, read({shear, loop}), 4));
}

TEST_CASE("An unloading upwards and a reloading downwards are found where they begin",
          "[unit][apps]")
{
  // @param begins quantity where the last stage begins; @param after direction of the one before it
  const auto wrong = [](const StageTexts& texts, double begins, double after) {
    const auto stage = read_stages(texts.rbegin()->second).front();
    dem::ActiveStage before, now;
    before.direction = after;
    now.quantity = stage.quantity;
    now.target = stage.target;
    now.value_at_start = begins;
    now.strain_at_start = 2e-3;
    now.direction = stage.target > begins ? 1.0 : -1.0;
    return wrong_direction(
        {labels_of({{1, texts.at(1)}}).front(), labels_of({*texts.rbegin()}).front()},
        before, now);
  };
  const std::string load = "triaxial to axial strain = 1 %";
  CHECK(wrong({{1, load}, {2, "unload to q = 9 MPa"}}, 2.4e6, 1.0) ==
        "stage 2, unload to q = 9 MPa: q is 2.4 MPa where it begins, so it would be a "
        "loading; continue with another `Loading/stage 2`");
  CHECK(wrong({{1, load}, {2, "unload to q = 1 MPa"}}, 2.4e6, 1.0).empty());
  CHECK_THAT(wrong({{1, load}, {2, "unload-reload to q = 9 MPa, 2 times"}}, 2.4e6, 1.0),
             Contains("stage 2a of cycle 1") && Contains("a loading"));
  CHECK_THAT(wrong({{1, "unload to q = 1 MPa"}, {2, "reload to q = 0.5 MPa"}}, 1e6, -1.0),
             Contains("an unloading"));
  CHECK(wrong({{1, "unload to q = 1 MPa"}, {2, "reload to q = 2 MPa"}}, 1e6, -1.0).empty());
  CHECK(
      wrong({{1, "unload to q = 1 MPa"}, {2, "unload to q = 0.5 MPa"}}, 1e6, -1.0).empty());
  // In extension q falls while it loads.
  CHECK(wrong({{1, "triaxial to axial strain = -1 %"}, {2, "unload to q = -0.1 MPa"}}, -1e6,
              -1.0)
            .empty());
  CHECK_THAT(wrong({{1, "resume to q = 0.5 MPa"}, {2, "unload to axial strain = 3 %"}},
                   0.01, -1.0),
             Contains("axial strain is 1 %"));
  CHECK(wrong({{1, load}, {2, "resume to q = 1 MPa"}}, 2.4e6, 1.0).empty());
}

TEST_CASE("A cycle of unloading is as many pairs of stages as its number says",
          "[unit][apps]")
{
  const auto once = read_stages("unload-reload to q = 0.2 MPa");
  CHECK(read_stages("unload-reload to q = 0.2 MPa, 1 time") == once);
  const auto five = read_stages("unload-reload to q = 0.2 MPa , 5 times ");
  REQUIRE(five.size() == 10);
  for (std::size_t k = 0; k < five.size(); ++k) CHECK(five[k] == once[k % 2]);
  CHECK(read_stages("unload-reload to q = 0 MPa, 1000 times").size() == 2000);
}

TEST_CASE("A number of cycles out of range, or of a stage that is no cycle, is refused",
          "[unit][apps]")
{
  for (const char* n :
       {"0", "-1", "1001", "1000000000", "99999999999999999999", "2.5", ""}) {
    const std::string text = std::string("unload-reload to q = 0.2 MPa, ") + n + " times";
    CAPTURE(text);
    CHECK_THROWS_WITH(read_stages(text), Contains("whole number from 1 to 1000"));
  }
  for (const char* text : {"unload-reload to q = 0.2 MPa 5 times",
                           "unload-reload to q = 0.2 MPa, 5 cycles", "times"})
    CHECK_THROWS_WITH(read_stages(text), Contains("is written \", 5 times\""));
  for (const char* text :
       {"triaxial to axial strain = 2 %, 5 times", "unload to q = 0.2 MPa, 1 time",
        "axes x = fixed, y = 1 MPa, z = strain-controlled to q = 2 MPa, 2 times"})
    CHECK_THROWS_WITH(read_stages(text), Contains("only an `unload-reload` is repeated"));
}

namespace {

/// Stages of a case that has these keys and no others.
std::vector<dem::LoadingStage> stages_with(const std::vector<std::string>& set)
{
  CaseFile file;
  StageTexts texts;
  {
    const auto section = file.section("Loading");
    declare_stages(file, texts);
  }
  file.read_text("subsection Loading\nend\n", "case.prm", set);
  const auto stages = stages_of(file, texts);
  // The resolved case is the same case.
  CaseFile again;
  StageTexts same;
  {
    const auto section = again.section("Loading");
    declare_stages(again, same);
  }
  again.read_text(file.resolved_text(), "resolved.prm");
  CHECK(same == texts);
  return stages;
}

std::string strain(int percent)
{
  return "resume to axial strain = " + std::to_string(percent) + " %";
}

} // namespace

TEST_CASE("An element test has as many stages as its case gives", "[unit][apps]")
{
  std::vector<std::string> set{"Loading/stage 1=compression to axial strain = 1 %"};
  for (int k = 2; k <= 40; ++k)
    set.push_back("Loading/stage " + std::to_string(k) + "=" + strain(k));
  CHECK(stages_with(set).size() == 40);
  set.back() = "Loading/stage 40="; // empty: as one that is not there
  CHECK(stages_with(set).size() == 39);
  set.back() = "Loading/stage 41=" + strain(41);
  CHECK_THROWS_WITH(stages_with(set),
                    Contains("Loading/stage 41") && Contains("there is no `stage 40`"));
  CHECK_THROWS_WITH(stages_with({}), Contains("Loading/stage 1: must be given"));
}

TEST_CASE("A stage that a case does not give any more can be refused", "[unit][apps]")
{
  CaseFile file;
  StageTexts texts;
  {
    const auto section = file.section("Loading");
    declare_stages(file, texts);
  }
  const std::string one = "subsection Loading\n  set stage 1 = " + strain(1) + "\n";
  file.read_text(one + "end\n", "case.prm");
  // Earlier versions wrote the stages that were not given.
  CHECK(file.changes_since(one + "  set stage 2 =\n  set stage 12 =\nend\n").empty());
  const auto changes = file.changes_since(one + "  set stage 2 = " + strain(2) + "\nend\n");
  REQUIRE(changes.size() == 1);
  CHECK(changes.front().key == "stage 2");
  CHECK_THROWS_WITH(file.refuse("Loading", "stage 2", "was done"),
                    "case.prm: Loading/stage 2, which is not given: was done");
}

TEST_CASE("A loading stage that is not understood is refused with the forms expected",
          "[unit][apps]")
{
  const auto message = [](const std::string& text) -> std::string {
    try {
      read_stages(text);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  CHECK_THAT(message("isotropc to p = 5 MPa"), Contains("did you mean \"isotropic\"?"));
  CHECK_THAT(message("isotropic"), Contains("there is no `to`"));
  CHECK_THAT(message("isotropic to p"), Contains("axial strain = 2 %"));
  CHECK_THAT(message("isotropic to p = 5"), Contains("Pa"));
  CHECK_THAT(message("isotropic to axial strain = 5 MPa"), Contains("number"));
  CHECK_THAT(message("isotropic to r = 5 MPa"), Contains("unknown"));
  CHECK_THAT(message("axes x = fixed, y = 1 MPa to q = 1 MPa"), Contains("each axis"));
  CHECK_THAT(message("axes x = fixed, x = fixed, z = strain-controlled to q = 1 MPa"),
             Contains("axis x has two rules"));
  CHECK_THAT(message("axes x = fixed, y = fixed, z = fixed to q = 1 MPa"),
             Contains("exactly one axis must be strain-controlled"));
  CHECK_THAT(message("triaxial with 2 MPa to q = 1 MPa"), Contains("not understood"));
  CHECK_THAT(message("radial to p = 1 MPa"), Contains("dq/dp = 1.5"));
  CHECK_THAT(message("radial dq/dp = 3 to lateral stress = 1 MPa"),
             Contains("does not change along the stage"));
}
