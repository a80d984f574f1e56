#include "apps/bench/workloads.h"

#include "dem/error.h"
#include "dem/math/morton.h"
#include "dem/math/random.h"
#include "dem/specimen/growth.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <string>

namespace mergel::apps {

namespace {

using namespace dem;

constexpr double unit = 0.1e-3;     ///< mean diameter [m]
constexpr double g_a = 0.1 * unit;  ///< activation gap of W1 [m]; paper: 0.15 d00
constexpr double skin = 0.2 * unit; ///< of the lists [m]; 0.3 d00, as in a run
constexpr double rho = 2556.0;      ///< [kg/m^3]
constexpr double list_life = 250.0; ///< steps between two rebuilds of the lists
constexpr double squeeze = 4e-6;    ///< strain per step of W1
constexpr double slowing = 0.25;    ///< factor of the strain rate, applied twice at yield
constexpr double agitation = 2e-4;  ///< largest random motion in a step of W2, in units

/// Purposes of the random numbers.
enum Draw : std::uint64_t { place = 0, size = 3, push = 4 };

Vec3 random_vector(std::uint64_t seed, std::uint64_t id, std::uint64_t draw)
{
  return {uniform(seed, id, draw), uniform(seed, id, draw + 1),
          uniform(seed, id, draw + 2)};
}

/// Particles in a periodic cube.
struct Cube {
  Particles p;
  PeriodicCell cell;
};

/// Particles at random places, numbered along Morton's curve. With shells of `shell_gap`/2
/// they fill `fraction` of the cube.
Cube draw_cube(const WorkloadSpec& spec, double shell_gap, double fraction)
{
  std::vector<std::pair<std::uint64_t, std::uint64_t>> order; // place on the curve, draw
  order.reserve(spec.n_particles);
  for (std::uint64_t k = 0; k < spec.n_particles; ++k) {
    const Vec3 u = random_vector(spec.seed, k, place);
    const auto slice = [](double a) { return static_cast<std::uint32_t>(a * 0x1p21); };
    order.emplace_back(morton(slice(u.x()), slice(u.y()), slice(u.z())), k);
  }
  std::sort(order.begin(), order.end());

  Cube cube;
  double volume = 0.0;
  for (const auto& [code, k] : order) {
    ParticleState b;
    b.x = random_vector(spec.seed, k, place);
    b.R = 0.5 * unit * (0.8 + 0.4 * uniform(spec.seed, k, size));
    b.m = sphere_mass(b.R, rho);
    volume += sphere_mass(b.R + 0.5 * shell_gap, 1.0);
    cube.p.add(b);
  }
  const double edge = std::cbrt(volume / fraction);
  for (ParticleState& b : cube.p.state) b.x *= edge;
  cube.cell.size = Vec3::Constant(edge);
  return cube;
}

/// Margin of the lists during growth [m].
constexpr double margin = 0.15 * unit;

Region region_of(const Cube& cube)
{
  return PeriodicBox{cube.cell.size};
}

void unnoticed(double) {}

/// The `wanted` pairs with the smallest gaps, in ascending order of their indices.
std::vector<Pair> closest_pairs(const Particles& p, std::size_t wanted)
{
  const PeriodicCell open;
  std::vector<std::pair<double, Pair>> by_gap;
  for (const Pair& q : find_pairs(p, open, 0.6 * unit)) {
    const ParticleState &i = p.state[q.i], &j = p.state[q.j];
    by_gap.emplace_back((j.x - i.x).norm() - (i.R + j.R), q);
  }
  std::sort(by_gap.begin(), by_gap.end());
  by_gap.resize(std::min(wanted, by_gap.size()));
  std::vector<Pair> pairs;
  for (const auto& [gap, q] : by_gap) pairs.push_back(q);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

LinearMaterial particle_contact(double gap)
{
  LinearMaterial c;
  c.E = 0.63e9;
  c.kappa = 2.4;
  c.mu = 0.3;
  c.g_a = gap;
  return c;
}

/// Bond of the paper's rock (Table 1, right) with elastic twist, without softening. It
/// yields at these strengths, or never.
DamageBond non_softening_bond(bool yields)
{
  DamageBond b;
  b.E = 22.5e9;
  b.kappa = 2.4;
  b.twist = Twist::elastic;
  const double out_of_reach = 1e6;
  const double strength = yields ? 1.0 : out_of_reach;
  b.sigma_t = 36e6 * strength;
  b.sigma_c = 198e6 * strength;
  b.C = 40.5e6 * strength;
  b.u_c = unit * out_of_reach;
  b.theta_c = out_of_reach;
  return b;
}

void set_time_step(WorkingAssembly& working)
{
  add_forces(working.assembly, 0.0);
  find_stable_step(working.stable_step, working.assembly, StepSpec{}, 0.0,
                   working.assembly.motion.damping);
  working.dt = working.dt_before = default_safety * working.stable_step.limit;
}

/// Uniform velocity: half the skin in `list_life` steps.
Vec3 flight(double dt)
{
  return {0.5 * skin / (list_life * dt), 0.0, 0.0};
}

void start_compression(WorkingAssembly& working, double edge)
{
  constexpr double heavy = 1e6;
  const double end = 0.5 * edge - unit, rate = squeeze / working.dt;
  for (ParticleState& b : working.assembly.particles.state) {
    const double height = b.x.z() - 0.5 * edge;
    if (std::abs(height) > end) b.m *= heavy;
    b.v = flight(working.dt) - Vec3(0.0, 0.0, rate * height);
  }
}

/// Fraction of the bonds that yield in a step, mean of n steps [-].
double fraction_yielding(WorkingAssembly& working, std::size_t n)
{
  PairLosses& losses = working.assembly.losses;
  const std::size_t before = losses.yielded;
  for (std::size_t k = 0; k < n; ++k) working.step();
  return static_cast<double>(losses.yielded - before) /
         static_cast<double>(n * working.assembly.bonds.size());
}

/// Compress until 0.7 of this fraction yields in a step, then more slowly, so that the
/// fraction is the mean of the next thousand steps.
void compress_until_yielding(WorkingAssembly& working, double share)
{
  constexpr std::size_t max_steps = 10000;
  constexpr int n_slower = 2;
  std::size_t n = 0;
  for (int slower = 0;; ++slower) {
    const std::size_t at_a_time = slower == 0 ? 50 : 200; // a wave passes in some 200 steps
    for (double now = 0.0; now < 0.7 * share; n += at_a_time) {
      if (n >= max_steps)
        throw NumericalError("workload W1: only " + std::to_string(now) +
                             " of the bonds yield in a step after " + std::to_string(n) +
                             " steps of compression, required " + std::to_string(share) +
                             "; lower --yielding");
      now = fraction_yielding(working, at_a_time);
    }
    if (slower == n_slower) return;
    const Vec3 mean = flight(working.dt);
    for (ParticleState& b : working.assembly.particles.state) { // to keep the fraction
      b.v = mean + slowing * (b.v - mean);
      b.omega *= slowing;
    }
  }
}

WorkingAssembly make_block(const WorkloadSpec& spec)
{
  Cube cube = draw_cube(spec, g_a, 0.6);
  const Region region = region_of(cube);
  Growth growth(cube.p, region, g_a, margin);
  constexpr int most_sweeps = 1150;
  grow(growth, {0.6, 1e-3, most_sweeps}, unnoticed);
  const double edge = cube.cell.size.x();
  for (ParticleState& b : cube.p.state) // into the cube, whose faces become free
    for (int a = 0; a < 3; ++a) b.x[a] -= edge * std::floor(b.x[a] / edge);

  WorkingAssembly working;
  Assembly& assembly = working.assembly;
  assembly.particles = std::move(cube.p);
  assembly.material = {non_softening_bond(spec.yielding > 0.0), particle_contact(g_a)};
  assembly.motion.damping = 0.0;
  assembly.list = VerletList(g_a, skin);
  const double wanted = bonds_per_particle * static_cast<double>(spec.n_particles);
  assembly.bonds =
      make_bonds(assembly.particles, assembly.cell,
                 closest_pairs(assembly.particles, static_cast<std::size_t>(wanted + 0.5)));
  set_time_step(working);
  start_compression(working, edge);
  if (spec.yielding > 0.0) compress_until_yielding(working, spec.yielding);
  return working;
}

/// Enlarge the particles in small steps until there are so many contacts per particle.
void press(Cube& cube, Growth& growth, double contacts)
{
  constexpr double swell = 1.001;
  constexpr int most_swells = 200, sweeps = 40;
  const auto wanted = contacts * static_cast<double>(cube.p.size());
  for (int n = 0; n < most_swells; ++n) {
    for (int k = 0; k < sweeps; ++k) growth.sweep(1.0);
    if (static_cast<double>(growth.n_overlaps()) >= wanted) return;
    for (ParticleState& b : cube.p.state) {
      b.R *= swell;
      b.m = sphere_mass(b.R, rho);
    }
    growth.sizes_changed();
  }
  throw NumericalError("workload W2: the particles do not reach " +
                       std::to_string(contacts) + " contacts per particle");
}

WorkingAssembly make_packing(const WorkloadSpec& spec)
{
  Cube cube = draw_cube(spec, 0.0, 0.64);
  const Region region = region_of(cube);
  Growth growth(cube.p, region, 0.0, margin);
  constexpr int sweeps_of_growth = 150; // to full size and no further
  grow(growth, {0.6, 0.0, sweeps_of_growth}, unnoticed);
  press(cube, growth, contacts_per_particle);

  WorkingAssembly working;
  Assembly& assembly = working.assembly;
  assembly.particles = std::move(cube.p);
  assembly.cell = cube.cell;
  assembly.material = {non_softening_bond(false), particle_contact(0.0)};
  assembly.motion.free_rotation = true;
  assembly.list = VerletList(0.0, skin);
  set_time_step(working);
  constexpr int steps_to_settle = 300;
  for (int k = 0; k < steps_to_settle; ++k) working.step();

  assembly.motion.damping = 0.0;
  for (std::size_t i = 0; i < assembly.particles.size(); ++i) {
    const Vec3 u = random_vector(spec.seed, i, push);
    assembly.particles.state[i].v =
        flight(working.dt) + agitation * unit / working.dt * (2.0 * u - Vec3::Ones());
  }
  return working;
}

} // namespace

void WorkloadSpec::check() const
{
  require(n_particles >= 200 && n_particles <= 20000000,
          "mergel bench: --particles = " + std::to_string(n_particles) +
              ": must lie in 200 to 2e7");
  require(yielding >= 0.0 && yielding <= 0.5,
          "mergel bench: --yielding = " + std::to_string(yielding) +
              ": must lie in 0 to 0.5");
  require(yielding == 0.0 || workload == Workload::bonded_block,
          "mergel bench: --yielding: only W1 has bonds. Add --workload W1");
}

void WorkingAssembly::step()
{
  if (n_steps % steps_between_step_checks == 0) {
    update_stable_step(stable_step, assembly, StepSpec{}, n_steps, dt,
                       assembly.motion.damping);
    dt = default_safety * stable_step.limit;
  }
  advance(assembly, dt_before, dt, [](double) {});
  dt_before = dt;
  ++n_steps;
}

WorkingAssembly make_workload(const WorkloadSpec& spec)
{
  spec.check();
  return spec.workload == Workload::bonded_block ? make_block(spec) : make_packing(spec);
}

std::size_t count_contacts(const Assembly& assembly)
{
  return static_cast<std::size_t>(std::count_if(
      assembly.contacts.pairs.begin(), assembly.contacts.pairs.end(), [&](const Pair& q) {
        return read_contact(q, Vec3::Zero(), assembly.particles, assembly.cell,
                            assembly.material.contact)
                   .f_n > 0.0;
      }));
}

std::uint64_t checksum(const Particles& p)
{
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return p.id[a] < p.id[b]; });
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&hash](const Vec3& a) {
    for (const std::byte byte : std::as_bytes(std::span(a.data(), 3))) {
      hash ^= std::to_integer<std::uint64_t>(byte);
      hash *= 0x100000001b3u;
    }
  };
  for (const std::size_t i : order) {
    add(p.state[i].x);
    add(p.state[i].v);
    add(p.state[i].omega);
  }
  return hash;
}

} // namespace mergel::apps
