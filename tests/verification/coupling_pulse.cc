// coupling/README.md, Far field: a plane pulse of the particles meets the elements.
#include "tests/support/catch.h"
#include "tests/support/cubic_crystal.h"
#include "tests/support/solid_structure.h"
#include "tests/verification/fem_solids.h"

#include <deal.II/grid/grid_tools.h>

using namespace mergel;
using namespace mergel::coupling;
using dem::Vec3;

namespace {

constexpr double d = 1e-3;       // of the particles [m]
constexpr int n_across = 4;      // particles
constexpr int n_high = 100;      // particles of the column
constexpr double z_0 = 50.0 * d; // of the pulse at the start, above the interface

struct Reflection {
  double energy;    ///< share of the energy that stays in the particles
  double amplitude; ///< displacement of the reflected pulse over that of the incident one
};

/// A column of a cubic crystal stands on a bar of elements as long as the waves need, bonded
/// to its end; both are free to move along z alone. A pulse with the displacement
/// exp(-((z - z_0)/width)^2/2) runs down the column.
/// @param stiffness E of the bar over that of the crystal
/// @param cell edge of the elements along the bar over d
Reflection reflection(double width, double stiffness, double cell)
{
  test::CubicCrystal crystal{d};
  crystal.fill(
      {0, 0, 0}, {n_across, n_across, n_high}, 0.1 * d, [](const Vec3&) { return true; },
      [](const Vec3&) { return false; });
  const double c = crystal.wave_speed(), c_bar = std::sqrt(stiffness) * c;

  const double side = n_across * d, length = 1.1 * z_0 * c_bar / c;
  const auto n_cells = static_cast<unsigned int>(std::lround(length / (cell * d)));
  dealii::Triangulation<3> mesh;
  fem::test::make_box({side, side, n_cells * cell * d}, {n_across, n_across, n_cells},
                      mesh);
  dealii::GridTools::shift(dealii::Point<3>(0.0, 0.0, -(n_cells * cell * d)), mesh);
  const fem::Supports rollers{{fem::test::x_low, fem::Support::roller},
                              {fem::test::x_high, fem::Support::roller},
                              {fem::test::y_low, fem::Support::roller},
                              {fem::test::y_high, fem::Support::roller}};
  std::vector<StructureSpec> structures;
  structures.push_back(
      {"bar",
       std::make_unique<test::SolidStructure>(
           mesh,
           fem::SolidProperties{
               {stiffness * crystal.E, 0.0}, crystal.rho, Vec3::Zero(), {}, {}},
           rollers, fem::test::z_high, Vec3::UnitZ()),
       crystal.contact(), true, false});
  CoupledSpec spec;
  spec.material = crystal.material();
  spec.motion.damping = 0.0;
  spec.skin = 0.1 * d;
  CoupledSystem coupled(spec, std::move(structures), crystal.particles, crystal.bonding,
                        MPI_COMM_SELF);

  // u = A g(z + c t): positions at t = 0, velocities at -dt/2.
  const double A = 1e-6 * d;
  for (dem::ParticleState& b : coupled.assembly.particles.state) {
    const double z = b.x.z();
    const auto g = [&](double t) {
      return A * std::exp(-0.5 * std::pow((z - z_0 + c * t) / width, 2));
    };
    b.x.z() += g(0.0);
    b.v.z() = (g(0.0) - g(-coupled.dt)) / coupled.dt;
  }
  dem::add_forces(coupled.assembly, 0.0);

  const auto stored = [&] {
    const auto e = coupled.energy_balances().assembly;
    return e.kinetic + e.bonds;
  };
  const double before = stored();
  while (coupled.time * c < 2.0 * z_0) coupled.step([](double) {});
  double largest = 0.0;
  for (std::size_t i = 0; i < crystal.particles.size(); ++i) {
    const double u =
        coupled.assembly.particles.state[i].x.z() - crystal.particles.state[i].x.z();
    if (std::abs(u) > std::abs(largest)) largest = u;
  }
  return {stored() / before, largest / A};
}

} // namespace

TEST_CASE(
    "a matched far field sends back less than 5 % of the energy of a plane pulse, less the "
    "longer it is",
    "[verification][coupling]")
{
  // The energy of the pulse has its maximum at the wave number 1/width. With elements of the
  // size of the particles it sends back, at 10, 19 and 38 particle diameters of that
  // wavelength, 2.7 %, 0.22 % and 0.007 %. Elements of two diameters: 18 %, 0.8 %, 0.03 %. So
  // elements of n diameters want waves of 10 n.
  const double short_wave = reflection(1.6 * d, 1.0, 1.0).energy;
  const double wave = reflection(3.0 * d, 1.0, 1.0).energy;
  CHECK(short_wave < 0.05);
  CHECK(wave < 0.1 * short_wave);
  CHECK(reflection(3.0 * d, 1.0, 2.0).energy < 0.01);
}

TEST_CASE(
    "a far field of another impedance sends back (Z1 - Z2)/(Z1 + Z2) of a plane pulse",
    "[verification][coupling]")
{
  // Continuity of velocity and force at the interface; Z = rho c. At a width of 8 d, 50
  // diameters of wavelength, measured 1.2 % above and 0.5 % below the amplitude, at half of
  // that width 5 % and 2.5 %.
  for (const double stiffness : {0.25, 4.0}) {
    const double Z = std::sqrt(stiffness), exact = (1.0 - Z) / (1.0 + Z);
    const Reflection r = reflection(8.0 * d, stiffness, stiffness > 1.0 ? 2.0 : 1.0);
    CAPTURE(stiffness);
    CHECK(r.amplitude == Approx(exact).epsilon(0.02));
    CHECK(r.energy == Approx(exact * exact).epsilon(0.06)); // measured 4.1 and -1.5 %
  }
}
