// coupling/README.md, Rigid platen: motion, load and energy of a platen on bonded particles.
#include "tests/support/catch.h"

#include "coupling/equilibrium.h"
#include "coupling/rigid_platen.h"

#include <limits>

using namespace mergel;
using namespace mergel::coupling;
using dem::Vec3;

namespace {

constexpr double R = 0.5e-3;

/// Bonds alone act: each is a spring, so that a column has a closed form.
CoupledSpec bonds_alone(double damping)
{
  CoupledSpec spec;
  dem::DamageBond bond;
  bond.E = 1e9;
  bond.kappa = 2.0;
  bond.sigma_t = bond.sigma_c = bond.C = 1e15;
  bond.u_c = 1e-4;
  bond.theta_c = 0.1;
  spec.material.bond = bond;
  spec.material.contact = dem::LinearMaterial{1.0, 1.0, 0.0, -1.0}; // never in contact
  spec.motion.damping = damping;
  spec.skin = 0.1 * R;
  return spec;
}

double k_pair(const CoupledSpec& spec)
{
  return dem::bond_shape(dem::section(spec.material.bond), R, 0.5 / R).k_n;
}
double k_wall(const CoupledSpec& spec)
{
  return dem::bond_shape(dem::section(spec.material.bond), R, 1.0 / R).k_n;
}
/// Of a column of n particles between two walls [N/m].
double k_column(const CoupledSpec& spec, int n)
{
  return 1.0 / (2.0 / k_wall(spec) + (n - 1) / k_pair(spec));
}

/// A platen at this height whose axis is the one given.
PlatenSpec disc(double z, double axis, PlatenDrive drive)
{
  PlatenSpec spec;
  spec.mesh = make_disc({0.0, 0.0, z}, {0.0, 0.0, axis}, 8e-3, 12);
  spec.drive = drive;
  return spec;
}

/// Columns of particles at these x, y, from z = 0 up; bonded along and, where the columns
/// stand side by side, across.
struct Columns {
  dem::Particles particles;
  dem::Bonding bonding;
  int n_high;

  Columns(const std::vector<std::array<double, 2>>& at, int n) : n_high(n)
  {
    for (const auto& [x, y] : at)
      for (int k = 0; k < n; ++k) {
        dem::ParticleState b;
        b.R = R;
        b.m = dem::sphere_mass(R, 2500.0);
        b.x = {x, y, R + 2.0 * R * k};
        particles.add(b);
      }
    bonding.limit = 1e-3 * R;
    for (dem::Index i = 0; i < particles.size(); ++i)
      for (dem::Index j = i + 1; j < particles.size(); ++j)
        if ((particles.state[j].x - particles.state[i].x).norm() < 2.001 * R)
          bonding.pairs.push_back({i, j, {}});
  }
  double height() const { return 2.0 * R * n_high; }
};

/// Columns between a fixed base and a platen on top, to both of which they are bonded.
struct Scene {
  RigidPlaten* platen;
  std::unique_ptr<CoupledSystem> system;

  explicit Scene(const CoupledSpec& spec, const Columns& columns, PlatenSpec top)
      : Scene(spec, make_platens(std::move(top)), columns)
  {
  }
  /// As it was when `state` was saved.
  Scene(const CoupledSpec& spec, dem::State& state, PlatenSpec top)
  {
    std::vector<StructureSpec> platens = make_platens(std::move(top));
    platen = static_cast<RigidPlaten*>(platens.back().structure.get());
    system = std::make_unique<CoupledSystem>(spec, std::move(platens), state,
                                             std::vector<dem::RigidWall>{}, MPI_COMM_SELF);
  }

  void run(int n)
  {
    for (int k = 0; k < n; ++k) system->step([](double) {});
  }
  double axial_force() const { return -platen->motion().load.f; } ///< pressure positive

private:
  Scene(const CoupledSpec& spec, std::vector<StructureSpec> platens, const Columns& columns)
      : platen(static_cast<RigidPlaten*>(platens.back().structure.get())),
        system(std::make_unique<CoupledSystem>(spec, std::move(platens), columns.particles,
                                               columns.bonding, MPI_COMM_SELF))
  {
  }
  static std::vector<StructureSpec> make_platens(PlatenSpec top)
  {
    dem::LinearMaterial contact;
    contact.E = 1.0;
    contact.g_a = -1.0;
    std::vector<StructureSpec> specs;
    specs.push_back({"base",
                     std::make_unique<RigidPlaten>(disc(0.0, 1.0, VelocityDrive{0.0})),
                     contact, true});
    specs.push_back({"top", std::make_unique<RigidPlaten>(std::move(top)), contact, true});
    return specs;
  }
};

PlatenSpec top_of(const Columns& columns, PlatenDrive drive, bool tilts, double damping)
{
  PlatenSpec top = disc(columns.height(), -1.0, drive);
  top.mass = 1e-3;
  top.is_free_to_tilt = tilts;
  top.damping = damping;
  return top;
}

/// Largest work or energy of the balance [J].
double energy_scale(const EnergyBalances& now)
{
  const StructureEnergies& e = now.structures;
  return std::max({std::abs(e.applied_work), std::abs(e.wall_work), now.assembly.stored(),
                   now.assembly.lost()});
}

const std::vector<std::array<double, 2>> block{
    {-R, -R}, {R, -R}, {-R, R}, {R, R}}; // 2 x 2 columns side by side

} // namespace

TEST_CASE("a platen under a constant force follows the leapfrog's closed form exactly",
          "[verification][coupling]")
{
  PlatenSpec spec = disc(0.0, 1.0, ForceDrive{0.5});
  spec.mesh = make_rectangle({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.5, 0.0});
  spec.mass = 0.25;
  RigidPlaten platen(spec);
  const double dt = 0x1p-10, a = 2.0; // powers of two: no rounding
  const Nodal none(4, Vec3::Zero());
  Nodal x, v;
  for (int n = 1; n <= 1000; ++n) {
    platen.step(dt, none);
    platen.positions(x);
    platen.velocities(v);
    REQUIRE(v[2] == Vec3(0.0, 0.0, n * dt * a));
    REQUIRE(x[2] == Vec3(1.0, 0.5, 0.5 * n * (n + 1) * dt * dt * a));
  }
  const StructureEnergies e = platen.energies();
  CHECK(e.kinetic == 0.5 * 0.25 * 4.0 * 1000 * 1000 * dt * dt);
  CHECK(e.net() == 0.0);
}

TEST_CASE("a level platen on an elastic column comes to rest at force over stiffness",
          "[verification][coupling]")
{
  const CoupledSpec spec = bonds_alone(0.7);
  const Columns column({{0.0, 0.0}}, 5);
  const double F = 0.05; // below Euler's load of the column, 0.2 N
  Scene s(spec, column, top_of(column, ForceDrive{F}, false, 0.7));
  s.run(50000);
  // Local damping ends at rest; the bonds are linear in compression.
  CHECK(s.platen->motion().travel == Approx(F / k_column(spec, 5)).epsilon(1e-9));
  CHECK(s.axial_force() == Approx(F).epsilon(1e-9));
  CHECK(s.system->unbalanced() < 1e-8);
}

TEST_CASE("a platen at a velocity compresses a column by its travel",
          "[verification][coupling]")
{
  const CoupledSpec spec = bonds_alone(0.7);
  const Columns column({{0.0, 0.0}}, 5);
  Scene s(spec, column, top_of(column, VelocityDrive{5e-4}, false, 0.0));
  s.run(5000);
  CHECK(s.platen->motion().travel ==
        Approx(5e-4 * s.system->time).epsilon(1e-12)); // sum of 5,000 steps
  s.platen->set_drive(VelocityDrive{0.0});
  s.run(20000);
  CHECK(s.axial_force() ==
        Approx(s.platen->motion().travel * k_column(spec, 5)).epsilon(1e-9));
  // What the drive gives is what the particles take.
  CHECK(s.platen->motion().drive_force == Approx(s.axial_force()).epsilon(1e-12));
}

TEST_CASE("a free platen stays level and free of moment under a concentric load",
          "[verification][coupling]")
{
  const CoupledSpec spec = bonds_alone(0.7);
  const double b = 3e-3;
  const Columns columns({{-b, 0.0}, {b, 0.0}, {0.0, -b}, {0.0, b}}, 1);
  const double F = 1.0;
  Scene s(spec, columns, top_of(columns, ForceDrive{F}, true, 0.7));
  s.run(20000);
  CHECK(s.platen->motion().travel == Approx(F / (4.0 * k_column(spec, 1))).epsilon(1e-9));
  // Round-off of forces and arms.
  CHECK((s.platen->axis() - Vec3(0.0, 0.0, -1.0)).norm() < 1e-13);
  CHECK(s.platen->motion().load.moment.norm() < 1e-12 * F * b);
}

TEST_CASE("the tilt of a free platen on two columns is that of two springs; a level platen "
          "carries the moment",
          "[verification][coupling]")
{
  const CoupledSpec spec = bonds_alone(0.7);
  const double x_1 = -2e-3, x_2 = 4e-3, F = 0.1, k = k_column(spec, 1);
  const Columns columns({{x_1, 0.0}, {x_2, 0.0}}, 1);

  Scene tilted(spec, columns, top_of(columns, ForceDrive{F}, true, 0.7));
  tilted.run(60000);
  // N_1 + N_2 = F and N_1 x_1 + N_2 x_2 = 0; each shortens by N/k.
  const double N_1 = F * x_2 / (x_2 - x_1), N_2 = F - N_1;
  const double tilt = (N_1 - N_2) / k / (x_2 - x_1);
  const Vec3 axis = tilted.platen->axis(); // (0, 0, -1) rotated about y
  // The columns lean by the square of the tilt, 1e-7 of it.
  CHECK(std::asin(axis.x()) == Approx(tilt).epsilon(1e-5));
  CHECK(std::abs(axis.y()) < 1e-12);
  CHECK(tilted.platen->motion().travel ==
        Approx(N_1 / k + tilt * x_1).epsilon(1e-5)); // at x = 0
  CHECK(tilted.platen->motion().load.moment.norm() < 1e-6 * F * x_2);

  Scene level(spec, columns, top_of(columns, ForceDrive{F}, false, 0.7));
  level.run(20000);
  CHECK(level.platen->axis() == Vec3(0.0, 0.0, -1.0));
  CHECK(level.platen->motion().travel == Approx(0.5 * F / k).epsilon(1e-9));
  // Each column bears F/2; the force on the platen is upwards, the moment -x f_z about y.
  CHECK(level.platen->motion().load.moment.y() ==
        Approx(-0.5 * F * (x_1 + x_2)).epsilon(1e-9));
}

TEST_CASE("energy of particles and platen is balanced to second order in the step, at a "
          "velocity, under a force and while it tilts",
          "[verification][coupling]")
{
  const Columns columns(block, 4);
  const auto error_of = [&](PlatenDrive drive, bool tilts, double safety) {
    CoupledSpec spec = bonds_alone(0.0);
    spec.step.safety = safety;
    PlatenSpec top = top_of(columns, drive, tilts, 0.0);
    top.mass = 5e-5; // some of the mass of the particles: it swings
    if (tilts)
      for (Vec3& x : top.mesh.x) x.x() += 0.7 * R; // eccentric
    Scene s(spec, columns, std::move(top));
    const EnergyBalances start = s.system->energy_balances();
    double error = 0.0, scale = 0.0; // largest
    while (s.system->time < 5e-3) {
      s.run(static_cast<int>(0.98 / safety)); // a third of the fastest period
      const EnergyBalances now = s.system->energy_balances();
      error = std::max(error, std::abs(unexplained(now, start)));
      scale = std::max(scale, energy_scale(now));
    }
    REQUIRE(s.system->energy_balances().assembly.stored() > 0.0);
    return error / scale;
  };
  // The leapfrog's own error: of the fastest modes, (omega dt)^2/8 of their energy, which a
  // force that sets in at once excites most. Measured 2.8e-9 at a velocity and 1.5e-6 under
  // a force, and 11.9 to 12.7 times that at 3.5 times the step (second order: 12.25).
  for (const bool tilts : {false, true}) {
    const VelocityDrive by_velocity{2e-3};
    const ForceDrive by_force{0.5};
    const double e_v = error_of(by_velocity, tilts, 0.07);
    const double e_f = error_of(by_force, tilts, 0.07);
    CHECK(e_v < 5e-9);
    CHECK(e_f < 3e-6);
    CHECK(error_of(by_velocity, tilts, 0.245) / e_v == Approx(12.25).epsilon(0.1));
    CHECK(error_of(by_force, tilts, 0.245) / e_f == Approx(12.25).epsilon(0.1));
  }
}

TEST_CASE("the energy balance of a tilting, damped platen alone closes to round-off",
          "[verification][coupling]")
{
  const CoupledSpec spec = bonds_alone(0.3);
  const Columns columns(block, 3);
  PlatenSpec top = top_of(columns, ForceDrive{0.5}, true, 0.3);
  for (Vec3& x : top.mesh.x) x.x() += 0.7 * R;
  Scene s(spec, columns, std::move(top));
  s.run(5000);
  const StructureEnergies e = s.platen->energies();
  CHECK(s.platen->axis().x() != 0.0);
  CHECK(e.damping > 0.0);
  const InterfaceBalance b = s.system->balance(); // of platen and base
  CHECK(b.force < 1e-12);
  CHECK(b.moment < 1e-12);
  CHECK(b.power < 1e-12);
  // 5,000 sums of terms as large as the work.
  CHECK(std::abs(e.net()) < 1e-11 * std::abs(e.applied_work));
}

TEST_CASE("a platen turned by 90 degrees stays rigid", "[verification][coupling]")
{
  PlatenSpec spec = disc(0.0, 1.0, VelocityDrive{0.0});
  spec.is_free_to_tilt = true;
  spec.mass = 1e-3;
  RigidPlaten platen(spec);
  const Nodal x_0 = spec.mesh.x;
  Nodal x, f(x_0.size(), Vec3::Zero());
  // A couple that turns with the platen: the angle grows as under a constant torque.
  const double dt = 1e-5, M = 1e-6;
  int n = 0;
  while (platen.axis().z() > 0.0) {
    const double arm = x_0[1].norm();
    platen.positions(x);
    const std::size_t opposite = 1 + (x_0.size() - 1) / 2;
    f[1] = 0.5 * M / arm * platen.axis();
    f[opposite] = -f[1];
    platen.step(dt, f);
    REQUIRE(++n < 100000);
  }
  platen.positions(x);
  for (std::size_t a = 0; a < x.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      REQUIRE((x[a] - x[b]).norm() == Approx((x_0[a] - x_0[b]).norm()).epsilon(1e-12));
  // Leapfrog from rest: angle n (n+1)/2 dt^2 M/I, exact but for round-off of n rotations.
  const double angle = 0.5 * n * (n + 1.0) * dt * dt * M / platen.inertia();
  CHECK(std::cos(angle) == Approx(platen.axis().z()).margin(1e-9));
  CHECK(platen.energies().wall_work == Approx(M * angle).epsilon(2.0 / n));
  CHECK(platen.energies().net() == Approx(0.0).margin(1e-11 * M));
}

namespace {

/// Squared largest frequency of a platen on n columns of one particle each, which all move
/// alike: stiffness k of the bonds to base and platen, particles of mass m, and M of the
/// platen. Its motion U and that of a particle u:
///
///   M U'' = -n k (U - u),   m u'' = -2 k u + k U
///
/// The tilt about an axis has the same form: U the angle times the distance b of the
/// columns from the axis, M = I/b^2.
double on_columns(double k, int n, double m, double M)
{
  const double a = n * k / M, b = 2.0 * k / m, c2 = n * k * k / (m * M);
  return 0.5 * (a + b + std::sqrt((a - b) * (a - b) + 4.0 * c2));
}

} // namespace

TEST_CASE(
    "the step of a platen on columns is that of its closed form, level and tilting, and "
    "a run blows up beyond it",
    "[verification][coupling]")
{
  CoupledSpec spec = bonds_alone(0.0);
  dem::section(spec.material.bond).kappa = 20.0; // no faster motion by shear
  const double b = 3e-3;
  const Columns columns({{-b, 0.0}, {b, 0.0}, {0.0, -b}, {0.0, b}}, 1);
  const double m = columns.particles.state.front().m, k = k_wall(spec);
  for (const bool tilts : {false, true}) {
    PlatenSpec top = top_of(columns, ForceDrive{0.0}, tilts, 0.0);
    top.mass =
        m; // its mass counts; a disc of 8 mm: I/b^2 = 1.8 m for 2 columns off an axis
    const double I = RigidPlaten(top).inertia();
    const double level = on_columns(k, 4, m, top.mass),
                 tilting = on_columns(k, 2, m, I / (b * b));
    REQUIRE(level > tilting);
    if (tilts) top.mass *= 10.0; // I too: no tilting mode is faster than the level one
    const double omega2 = on_columns(k, 4, m, top.mass);
    Scene s(spec, columns, top);
    const dem::StableStep& step = s.system->stable_step;
    CAPTURE(tilts, step.omega2 / omega2);
    // The iteration ends at a rise of 1e-4, from below.
    CHECK(step.omega2 == Approx(omega2).epsilon(1e-3));
    CHECK(step.omega2 < (1.0 + 1e-12) * omega2);
    CHECK(s.system->dt == spec.step.safety * step.limit);
  }

  const auto largest_travel = [&](double safety) {
    CoupledSpec at = spec;
    at.step.safety = safety;
    PlatenSpec top = top_of(columns, ForceDrive{1e-6}, false, 0.0);
    top.mass = m;
    Scene s(at, columns, top);
    double largest = 0.0;
    for (int n = 0; n < 200 && largest < 1e-6; ++n) {
      s.run(10);
      largest = std::max(largest, std::abs(s.platen->motion().travel));
    }
    return largest; // at rest under the force: some 1e-12 m
  };
  CHECK(largest_travel(0.99) < 1e-10);
  CHECK(largest_travel(1.01) >= 1e-6);
}

TEST_CASE("the step of a tilting platen is that of its tilt where that is the fastest",
          "[verification][coupling]")
{
  // A light disc whose columns stand beyond its radius of gyration: sqrt(I/M) = 4 mm,
  // columns at 7 mm from the axis.
  CoupledSpec spec = bonds_alone(0.0);
  dem::section(spec.material.bond).kappa = 20.0;
  const double b = 7e-3;
  const Columns columns({{-b, 0.0}, {b, 0.0}}, 1);
  const double m = columns.particles.state.front().m, k = k_wall(spec);
  PlatenSpec top = top_of(columns, ForceDrive{0.0}, true, 0.0);
  top.mass = 0.5 * m;
  const double I = RigidPlaten(top).inertia();
  const double level = on_columns(k, 2, m, top.mass),
               tilting = on_columns(k, 2, m, I / (b * b));
  REQUIRE(tilting > 1.2 * level);
  Scene s(spec, columns, top);
  CAPTURE(s.system->stable_step.omega2 / tilting);
  CHECK(s.system->stable_step.omega2 == Approx(tilting).epsilon(1e-3));
}

TEST_CASE("a column under a platen comes to equilibrium: held first, then free",
          "[verification][coupling]")
{
  const CoupledSpec spec = bonds_alone(0.7);
  const Columns column({{0.0, 0.0}}, 5);
  const double F = 0.05;
  Scene s(spec, column, top_of(column, ForceDrive{F}, false, 0.7));
  std::vector<std::string> phases;
  std::size_t n_done = 0;
  EquilibriumReport report;
  report.begin = [&](const std::string& phase) {
    phases.push_back(phase);
    // Held, the platen does not move.
    CHECK(s.platen->motion().travel == 0.0);
  };
  report.done = [&](const std::string&) { ++n_done; };
  equilibrate(*s.system, {1e-6, 100'000}, report);
  CHECK(phases ==
        std::vector<std::string>{"settling in held walls", "settling in free walls"});
  CHECK(n_done == 2);
  CHECK(s.system->settling.phase == Settling::Phase::done);
  CHECK(s.system->x_0.size() == column.particles.size());
  CHECK(s.platen->motion().travel == Approx(F / k_column(spec, 5)).epsilon(1e-4));

  Scene stopped(spec, column, top_of(column, ForceDrive{F}, false, 0.7));
  CHECK_THROWS_AS(equilibrate(*stopped.system, {1e-6, 60}), Unstable);
}

TEST_CASE("a restored coupled system of platens continues with the same bits",
          "[verification][coupling]")
{
  const CoupledSpec spec = bonds_alone(0.3);
  const Columns columns(block, 3);
  PlatenSpec top = top_of(columns, ForceDrive{0.5}, true, 0.3);
  for (Vec3& x : top.mesh.x) x.x() += 0.7 * R;
  Scene whole(spec, columns, top);
  whole.run(777);
  dem::State state(0);
  whole.system->save(state);
  Scene restored(spec, state, top);
  whole.run(777);
  restored.run(777);
  CHECK(restored.system->n_steps == whole.system->n_steps);
  CHECK(restored.system->time == whole.system->time);
  for (std::size_t i = 0; i < columns.particles.size(); ++i) {
    CHECK(restored.system->assembly.particles.state[i].x ==
          whole.system->assembly.particles.state[i].x);
    CHECK(restored.system->assembly.particles.state[i].omega ==
          whole.system->assembly.particles.state[i].omega);
  }
  Nodal x, y;
  whole.platen->positions(x);
  restored.platen->positions(y);
  CHECK(x == y);
  CHECK(restored.platen->energies().net() == whole.platen->energies().net());
  CHECK(restored.platen->motion().load.moment == whole.platen->motion().load.moment);

  dem::State other(0);
  whole.system->save(other);
  CHECK_THROWS_WITH(
      Scene(spec, other, top_of(columns, VelocityDrive{0.0}, true, 0.3)),
      "does not fit this program or case: its array top_numbers has no number `prescribed "
      "velocity [m/s]`");
}

TEST_CASE("a platen that cannot be is refused with the value and a remedy",
          "[unit][coupling]")
{
  const auto refusal = [](auto&& change) {
    PlatenSpec spec = disc(0.0, 1.0, VelocityDrive{1.0});
    change(spec);
    try {
      RigidPlaten platen(spec);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  CHECK(refusal([](PlatenSpec&) {}).empty());
  CHECK(refusal([](PlatenSpec& s) { s.drive = ForceDrive{1.0}; }) ==
        "platen: mass = 0: must be > 0, in kg, for a platen that is driven by a force or "
        "free to tilt");
  CHECK(refusal([](PlatenSpec& s) { s.is_free_to_tilt = true; }).find("platen: mass = 0") ==
        0);
  CHECK(refusal([](PlatenSpec& s) { s.damping = 1.0; }) ==
        "platen: damping = 1: must satisfy 0 <= damping < 1");
  CHECK(refusal([](PlatenSpec& s) {
          s.mesh.axis = -s.mesh.axis;
        }).find("platen: area seen along the axis [m^2] = -") == 0);
  CHECK(refusal([](PlatenSpec& s) {
          s.is_free_to_tilt = true;
          s.mass = 1.0;
          s.mesh.x[1].z() += 1e-3;
        }).find("platen: product of inertia over the sum of the moments = ") == 0);
  CHECK_THROWS_AS(make_disc(Vec3::Zero(), Vec3::UnitZ(), 0.0, 12), InputError);
  CHECK_THROWS_AS(make_rectangle(Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitZ()), InputError);
}

TEST_CASE("disc and rectangle have their area, inertia and axis", "[unit][coupling]")
{
  PlatenSpec spec;
  spec.mesh = make_rectangle({1.0, 2.0, 3.0}, {0.0, 3.0, 0.0}, {0.0, 0.0, 2.0});
  CHECK(spec.mesh.axis == Vec3(1.0, 0.0, 0.0));
  spec.mass = 5.0;
  spec.is_free_to_tilt = true;
  // m/12 (2a)^2 or m/12 (2b)^2, whichever the first axis is.
  const double I = RigidPlaten(spec).inertia();
  CHECK((I == Approx(5.0 / 12.0 * 36.0) || I == Approx(5.0 / 12.0 * 16.0)));

  spec.mesh = make_disc({0.0, 0.0, 1.0}, {0.0, 2.0, 0.0}, 2.0, 400);
  CHECK(spec.mesh.axis == Vec3(0.0, 1.0, 0.0));
  // m r^2/4; the polygon outside the circle is larger by (pi/n)^2/3 in r^2.
  CHECK(RigidPlaten(spec).inertia() == Approx(5.0 * 4.0 / 4.0).epsilon(1e-4));
  const dem::Wall wall =
      RigidPlaten(spec).interface(dem::LinearMaterial{1e9, 2.0, 0.0, 0.0}).wall;
  for (std::size_t t = 0; t < wall.topology.triangles.size(); ++t)
    CHECK((normal(wall, static_cast<int>(t)) - spec.mesh.axis).norm() < 1e-12);
  for (std::size_t k = 1; k < spec.mesh.x.size(); ++k)
    CHECK((spec.mesh.x[k] - spec.mesh.x[0]).norm() > 2.0);
}
