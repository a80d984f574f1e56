/// The start of a triaxial test of particles without bonds (coupling/README.md, Triaxial test).
#include "coupling/triaxial/triaxial_test.h"
#include "dem/text.h"

#include <cmath>

namespace mergel::coupling {

namespace {

constexpr double at_rest = 1e-3; ///< unbalanced-force ratio of the particles
/// The same of the membrane. Where it wrinkles it has no stiffness and its nodes drift on for long:
/// at 8 kPa it took 100,000 steps to 1e-3.
constexpr double membrane_at_rest = 1e-2;
constexpr double near_enough = 0.01; ///< stress of the platens against that wanted [-]
constexpr std::size_t steps_between_looks = 100;
constexpr std::size_t most_steps = 100'000;

/// Step until it is at rest. @throws Unstable when that takes too many steps
template <class Step, class IsAtRest>
void come_to_rest(const char* what, Step&& step, IsAtRest&& is_at_rest)
{
  for (std::size_t n = 1; n <= most_steps; ++n) {
    step();
    if (n % steps_between_looks == 0 && is_at_rest()) return;
  }
  throw Unstable(std::string(what) +
                 " does not come to rest under the first cell pressure in " +
                 std::to_string(most_steps) + " steps: raise `Motion/damping`");
}

} // namespace

void TriaxialTest::seat(double pressure)
{
  TriaxialState& s = state_;
  membrane_->set_pressure(s.pressure = pressure);
  come_to_rest(
      "the membrane", [&] { system_.step_with_particles_held(); },
      [&] { return membrane_->motion().unbalanced_ratio() < membrane_at_rest; });

  // As an isotropic stage that is at its target.
  s.active.controlled = dem::ActiveStage::Controlled::all;
  s.active.follow = dem::ActiveStage::Follow::mean;
  s.n_held = 1;
  come_to_rest(
      "the specimen", [&] { step(); },
      [&] {
        return dem::unbalanced_ratio(system_.assembly) < at_rest &&
               membrane_->motion().unbalanced_ratio() < membrane_at_rest &&
               std::abs(s.axial - pressure) < near_enough * pressure;
      });

  read_strain();
  geometry_.area = area();
  geometry_.void_ratio = (1.0 + geometry_.void_ratio) * (1.0 - s.middle.volumetric) - 1.0;
  geometry_.z_bottom += bottom_->motion().travel;
  geometry_.height = s.height;
  s.active = {};
  s.n_held = s.n_in_stage = s.n_sum = 0;
  s.top_sum = s.bottom_sum = s.pressure_sum = s.since_record = s.largest_rate = 0.0;
  s.time = 0.0;
  begin_here();
}

} // namespace mergel::coupling
