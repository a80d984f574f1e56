#include "tests/support/catch.h"

#include "apps/element/element_plan.h"

using namespace mergel::apps;

namespace {

double strain_of(const StageTexts& texts)
{
  std::vector<mergel::dem::LoadingStage> stages;
  for (const auto& [number, text] : texts)
    for (const mergel::dem::LoadingStage& stage : read_stages(text))
      stages.push_back(stage);
  return strain_of_stages(stages, 1e9, 0.5);
}

} // namespace

TEST_CASE("A reloading covers the strain of its unloading, in each cycle", "[unit][apps]")
{
  const double on = strain_of({{1, "isotropic to p = 5 MPa"}});
  CHECK(on == Approx(5e-3));
  const double once =
      strain_of({{1, "isotropic to p = 5 MPa"}, {2, "unload-reload to p = 1 MPa"}});
  CHECK(once == Approx(on + 2 * 4e-3));
  CHECK(strain_of({{1, "isotropic to p = 5 MPa"},
                   {2, "unload-reload to p = 1 MPa, 100 times"},
                   {3, "resume to p = 6 MPa"}}) == Approx(on + 100 * (once - on) + 1e-3));
  CHECK(strain_of({{1, "triaxial to axial strain = 2 %"},
                   {2, "unload-reload to axial strain = 1 %, 2 times"}}) ==
        Approx(0.02 + 4 * 0.01));
}
