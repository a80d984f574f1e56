// Specimens have the properties that a case asks for.
#include "tests/support/catch.h"

#include "dem/assembly/step.h"
#include "dem/assembly/timestep.h"
#include "dem/pairs/neighbours.h"
#include "dem/specimen/bonding.h"
#include "dem/specimen/compaction.h"

#include <array>
#include <cmath>

using namespace mergel::dem;
using mergel::match::Contains;

namespace {

constexpr double d00 = 0.066e-3; // [m]

/// A box that holds about `n_grains` particles of the paper's rock, S = 5.
SpecimenSpec box_of_rock(double n_particles, double porosity = 0.52)
{
  SpecimenSpec s;
  s.sizes = Grading(UniformSizes{d00, 0.1337e-3});
  s.scale = {5.0, 5.0, 0.0, 0.0};
  s.rho = 2556.0;
  s.porosity = porosity;
  s.contact = LinearMaterial{0.63e9, 2.4, 0.3, 0.15 * d00};
  s.coordination = 5.8;
  s.g_b = 0.4 * d00;
  const double particle = pi / 6.0 * s.sizes.mean_cube() * 125.0; // [m^3]
  s.region =
      PeriodicBox{Vec3::Constant(std::cbrt(n_particles * particle / (1.0 - porosity)))};
  return s;
}

Packing made(const SpecimenSpec& s)
{
  return pack(s, [](double) {});
}

const Packing& unjammed()
{
  static const Packing packing = made(box_of_rock(1500.0));
  return packing;
}

const Packing& confined()
{
  static const Packing packing = [] {
    SpecimenSpec s = box_of_rock(600.0);
    s.compaction = Compaction::confined;
    s.pressure = 5e3;
    return made(s);
  }();
  return packing;
}

/// The assembly as a run reads it from a sample: positions, sizes and masses, no history.
Assembly as_read(const SpecimenSpec& s, const Packing& packing)
{
  Assembly r;
  r.particles = packing.particles;
  r.cell = packing.cell;
  r.material.contact = s.contact;
  r.list = VerletList(activation_gap(s.contact), 0.3 * d00);
  add_forces(r, 0.0);
  return r;
}

/// Solid fraction of the slab [low, high) along an axis, in units of the edge. Each
/// particle counts with the volume of its sphere in the slab; what overlaps counts twice.
double solid_in_slab(const Packing& packing, int axis, double low, double high)
{
  const double edge = packing.cell.size[axis];
  double v = 0.0;
  for (const ParticleState& b : packing.particles.state)
    for (const double shift : {-edge, 0.0, edge}) {
      // Volume of the sphere below a plane at height h from its centre.
      const auto below = [&](double plane) {
        const double h = std::clamp(plane * edge - b.x[axis] - shift, -b.R, b.R);
        return pi * (2.0 / 3.0 * b.R * b.R * b.R + b.R * b.R * h - h * h * h / 3.0);
      };
      v += below(high) - below(low);
    }
  return v / ((high - low) * packing.cell.size.prod());
}

} // namespace

// The paper, Tables 2 and 5, sections 2.2 and 3.
TEST_CASE("The paper's rock has the paper's numbers of particles", "[verification][dem]")
{
  struct Count {
    double edge; ///< of a cube [m]
    double S, porosity, particles;
    double within; ///< "14 k" is rounded to 500
  };
  for (const Count& c : {Count{35e-3, 15, 0.35, 14000, 0.036},
                         {35e-3, 15, 0.50, 11000, 0.046},
                         {10e-3, 4, 0.50, 13465, 0.002},
                         {30e-3, 12, 0.50, 13465, 0.002},
                         {30e-3, 4, 0.50, 363672, 0.002},
                         {80e-3, 20, 0.50, 55166, 0.002},
                         {80e-3, 12, 0.50, 255417, 0.002},
                         {160e-3, 48, 0.50, 31923, 0.002}}) {
    SpecimenSpec s = box_of_rock(1000.0, c.porosity);
    s.scale = {c.S, c.S, 0.0, 0.0};
    s.region = PeriodicBox{Vec3::Constant(c.edge)};
    CAPTURE(c.edge, c.S, c.porosity);
    CHECK(max_particles(s) == Approx(c.particles).epsilon(c.within)); // measured 0.0018
  }
  SpecimenSpec s = box_of_rock(1000.0);
  s.region = Cylinder{6e-3, 24e-3, 200};
  CHECK(max_particles(s) == Approx(18000.0).epsilon(0.03));
}

TEST_CASE("An unjammed box has its porosity to one particle, its sizes and no overlap",
          "[verification][dem]")
{
  const SpecimenSpec s = box_of_rock(1500.0);
  const Packing& p = unjammed();
  const auto n = static_cast<double>(p.particles.size());
  CHECK(n == Approx(1500.0).epsilon(0.05)); // random: sqrt(N) times the scatter of d^3
  // The last particle is drawn or not: half of the largest one of 1500.
  CHECK(p.porosity == Approx(0.52).margin(0.5 * 0.48 * 2.2 / n));
  CHECK(p.whole_porosity == p.porosity);
  CHECK(p.overlap <= 1e-3);
  CHECK(p.cell.size == std::get<PeriodicBox>(s.region).size);
  const SizeReport sizes = describe_sizes(s.sizes, p.particles);
  CHECK(sizes.d_50 == Approx(s.sizes.sieve(0.5)).epsilon(0.03));
  for (const ParticleState& b : p.particles.state)
    REQUIRE(((b.x.array() >= 0.0).all() && (b.x.array() < p.cell.size.array()).all()));
}

// One specimen does not suffice: 1 of 100 seeds exceeds the bound of the 1 % level, and
// seed 1 is the one.
TEST_CASE("Over many seeds the particles pass Kolmogorov's test of their grading",
          "[verification][dem]")
{
  constexpr int n_seeds = 100;
  double sum = 0.0;
  int n_beyond = 0;
  for (std::uint64_t seed = 1; seed <= n_seeds; ++seed) {
    SpecimenSpec s = box_of_rock(200.0, 0.75); // loose: quickly made
    s.seed = seed;
    const Packing p = made(s);
    // Stephens (1970), J. R. Stat. Soc. B 32, 115: scales the distance to very many draws.
    const double root = std::sqrt(static_cast<double>(p.particles.size()));
    const double distance = describe_sizes(s.sizes, p.particles).distance_by_number *
                            (root + 0.12 + 0.11 / root);
    sum += distance;
    n_beyond += distance > 1.63;
  }
  // Kolmogorov's distribution has the mean sqrt(pi/2) ln 2 = 0.869 and the deviation 0.260
  // (Marsaglia, Tsang and Wang 2003): four standard errors. Without the largest tenth of
  // the particles the mean would be at least sqrt(200)/10 = 1.4.
  CHECK(sum / n_seeds == Approx(0.869).margin(4.0 * 0.260 / std::sqrt(1.0 * n_seeds)));
  CHECK(n_beyond <= 5); // 1 expected; more than 5 in one of 1900 sets of seeds
}

TEST_CASE("A periodic box is as dense beside its faces as inside", "[verification][dem]")
{
  const Packing& p = unjammed();
  for (int axis = 0; axis < 3; ++axis) {
    // Slabs of a sixth of the edge, 1.5 particles; the first and the last are at the faces.
    std::array<double, 6> solid;
    for (int k = 0; k < 6; ++k)
      solid[static_cast<std::size_t>(k)] = solid_in_slab(p, axis, k / 6.0, (k + 1) / 6.0);
    for (const double share : solid) CHECK(share == Approx(0.48).margin(0.03));
    const double at_faces = 0.5 * (solid[0] + solid[5]);
    // A wall leaves 0.1 less there; the scatter of a slab of 250 particles is some 0.01.
    CHECK(at_faces == Approx(0.48).margin(0.02));
  }
}

TEST_CASE(
    "A confined box reaches porosity and pressure, and bears most of it when it is read",
    "[verification][dem]")
{
  SpecimenSpec s = box_of_rock(600.0);
  const Packing& p = confined();
  CHECK(p.porosity == Approx(0.52).margin(porosity_tolerance));
  CHECK(p.pressure == Approx(5e3).epsilon(pressure_tolerance));
  CHECK(p.friction < 0.3);
  // The particles have the sizes asked for; the box takes the change, within 0.4 %.
  for (const ParticleState& b : p.particles.state) REQUIRE(b.S == 5.0);
  const double edge = std::get<PeriodicBox>(s.region).size.x();
  CHECK(p.cell.size.x() == Approx(edge).epsilon(0.004));

  Assembly r = as_read(s, p);
  const double V = r.cell.size.prod();
  CHECK(mean_pressure(r, V) == Approx(p.pressure).epsilon(1e-6));
  const double dt = stable_time_step(r, StepSpec{});
  // A file holds no shear forces: the particles settle anew, to 0.77 of the pressure in any
  // step (measured with 0.4 of this one too).
  for (int k = 0; k < 4000; ++k) advance(r, dt, dt, [](double) {});
  CHECK(mean_pressure(r, V) == Approx(0.77 * p.pressure).epsilon(0.05));
  CHECK(unbalanced_ratio(r) < 1e-3);
}

TEST_CASE("A confined cylinder reaches porosity and pressure inside its walls",
          "[verification][dem]")
{
  SpecimenSpec s = box_of_rock(1.0);
  s.region = Cylinder{2e-3, 4e-3, 16};
  s.compaction = Compaction::confined;
  s.pressure = 20e3;
  const Packing p = made(s);
  CHECK(p.porosity == Approx(0.52).margin(porosity_tolerance));
  CHECK(p.whole_porosity > p.porosity); // the walls leave voids
  CHECK(p.pressure == Approx(20e3).epsilon(pressure_tolerance));
  CHECK_FALSE(p.cell.is_periodic());

  // At rest the virial of the walls, which are smooth, is that of the pressure: 3 p V is
  // the sum of their forces times their distances from the centre of the cylinder.
  const double E = modulus(s.contact);
  double virial = 0.0, r = 2e-3; // [J]; distance of the nearest face [m]
  for (const Face& face : solid_faces(s.region)) {
    const double away = (Vec3(0.0, 0.0, -2e-3) - face.point).dot(face.inwards);
    r = std::min(r, away);
    for (const ParticleState& b : p.particles.state) {
      const double overlap = b.R - (b.x - face.point).dot(face.inwards);
      if (overlap > 0.0) virial += pi * E * b.R * overlap * away; // k_n = E pi R^2/R
    }
  }
  const double of_pressure = 3.0 * p.pressure * volume(s.region);
  CHECK(virial == Approx(of_pressure).epsilon(0.01)); // measured 0.0014: at rest to 1e-3

  // A wall acts on a particle with F, and the forces that balance F add as much:
  // 2 F r <= 3 p V. This bounds the overlap of a particle with a wall, 0.010 R here. The
  // most loaded particle has 0.32 of it (0.0033 R): eleven times the mean of 71 wall
  // forces, in a force chain across the six particles of the diameter.
  const double most = 0.5 * of_pressure / r;
  for (const ParticleState& b : p.particles.state)
    REQUIRE(b.R - depth(s.region, b.x) < most / (pi * E * b.R));
}

TEST_CASE("The same seed packs a confined box to the same bits", "[verification][dem]")
{
  SpecimenSpec s = box_of_rock(200.0);
  s.compaction = Compaction::confined;
  s.pressure = 20e3;
  const Packing first = made(s), second = made(s);
  REQUIRE(first.particles.size() == second.particles.size());
  for (std::size_t i = 0; i < first.particles.size(); ++i)
    REQUIRE(first.particles.state[i].x == second.particles.state[i].x);
  CHECK(first.cell.size == second.cell.size);
}

// Paper, section 2.2: n = 0.35 by radii expansion.
TEST_CASE("An expanded box has its porosity at the pressure that results",
          "[verification][dem]")
{
  SpecimenSpec s = box_of_rock(600.0, 0.35);
  s.contact = LinearMaterial{1e9, 5.0, 0.5, 0.1 * d00};
  s.compaction = Compaction::expanded;
  const Packing p = made(s);
  CHECK(p.porosity == Approx(0.35).margin(0.002)); // to a particle of 600
  // Shells that would fill 0.77 overlap: far above a confining pressure.
  CHECK(p.pressure > 1e6);
  CHECK(p.overlap < 0.2);
  Assembly r = as_read(s, p);
  CHECK(mean_pressure(r, r.cell.size.prod()) == Approx(p.pressure).epsilon(1e-9));
  CHECK(unbalanced_ratio(r) < 5e-3); // at rest without friction
}

TEST_CASE("The bonds of a periodic box cross its faces and reach the coordination",
          "[verification][dem]")
{
  SpecimenSpec s = box_of_rock(1500.0);
  const Packing& p = unjammed();
  const Bonding b = choose_bonds(s, p.particles, p.cell);
  const auto n = static_cast<double>(p.particles.size());
  CHECK(2.0 * static_cast<double>(b.pairs.size()) / n == Approx(5.8).margin(1.1 / n));
  std::size_t through_faces = 0;
  for (const Pair& q : b.pairs) through_faces += q.shift != Shift{};
  // Six faces of a box of 11 particles per edge: a bond is some 1.1 d long.
  CHECK(through_faces > b.pairs.size() / 20);
  CHECK(b.limit < s.g_b);
}

TEST_CASE("A porosity that cannot bear a pressure is refused with the range that can",
          "[verification][dem]")
{
  SpecimenSpec s = box_of_rock(200.0, 0.65); // measured: 0.603 to 0.604 are the loosest
  s.compaction = Compaction::confined;
  s.pressure = 20e3;
  CHECK_THROWS_WITH(made(s), Contains("these particles jam at porosities between 0.6"));
}

TEST_CASE("Particles without friction jam at one porosity, which is named and reached",
          "[verification][dem]")
{
  SpecimenSpec s = box_of_rock(200.0, 0.6);
  s.contact = with_friction(s.contact, 0.0);
  s.compaction = Compaction::confined;
  s.pressure = 200e3;
  std::string said;
  try {
    made(s);
  } catch (const mergel::InputError& error) {
    said = error.what();
  }
  const std::string before = "these particles jam at a porosity of ";
  REQUIRE_THAT(said, Contains(before));
  const double porosity = std::stod(said.substr(said.find(before) + before.size()));
  // A box that holds as many particles at that porosity.
  SpecimenSpec again = box_of_rock(200.0, porosity);
  again.contact = with_friction(again.contact, 0.0);
  again.compaction = Compaction::confined;
  again.pressure = 200e3;
  CHECK(made(again).porosity == Approx(porosity).margin(porosity_tolerance));
}

TEST_CASE("The smallest porosity that a refusal names can be packed without a pressure",
          "[verification][dem]")
{
  std::string said;
  try {
    made(box_of_rock(600.0, 0.47));
  } catch (const mergel::InputError& error) {
    said = error.what();
  }
  const std::string before = "are unjammed at porosities from about ";
  REQUIRE_THAT(said, Contains(before) && Contains(" to 1;"));
  const double lowest = std::stod(said.substr(said.find(before) + before.size()));
  CHECK(lowest > 0.49);
  CHECK(made(box_of_rock(600.0, lowest)).overlap <= 1e-3);
}
