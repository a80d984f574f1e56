#include "apps/coupled/coupled_system.h"

#include "apps/run/progress.h"
#include "dem/assembly/distribute.h"
#include "dem/text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace mergel::apps {

namespace {

/// Stiffness that the assembly adds to the interface nodes of the far field [N/m], an upper
/// bound: bonds by their weights, and every contact that may close in full at all corners
/// of the triangles that it can reach (coupling/README.md, Time step).
std::vector<double> interface_springs(const dem::Assembly& assembly,
                                      const coupling::Transfer& transfer)
{
  // From the present positions: the result must not depend on when the lists were built.
  dem::Wall wall = assembly.walls.front();
  dem::rebuild_wall(wall, assembly.particles, assembly.list.skin());
  std::vector<dem::ForceSum> sums(wall.x.size()); // [N/m]
  const auto add = [&](int triangle, const dem::Vec3& weight, double k) {
    const dem::Triangle& t = wall.topology.triangles[static_cast<std::size_t>(triangle)];
    for (int c = 0; c < 3; ++c)
      sums[static_cast<std::size_t>(t[static_cast<std::size_t>(c)])].add(weight[c] * k);
  };
  const auto radius = [&](dem::Index i) { return assembly.particles.state[i].R; };
  for (const dem::WallBond& b : wall.bonds) {
    const double R = radius(b.particle);
    if (b.state.intact > 0.0)
      add(b.anchor.triangle, b.anchor.weight,
          dem::bond_shape(dem::section(assembly.material.bond), R, 1.0 / R).k_n);
  }
  for (std::size_t k = 0; k < wall.contacts.size(); ++k) {
    const double R = radius(wall.contacts[k].particle);
    for (const auto& near : wall.listed[k].near)
      add(near.triangle, dem::Vec3::Ones(),
          dem::linear_stiffness(wall.material, R, 1.0 / R).k_n);
  }
  dem::ExactReduction all;
  for (dem::ForceSum& s : sums) all.add(s);
  all.run(assembly.comm);
  coupling::Nodal k_dem, k_fem;
  for (const dem::ForceSum& s : sums) k_dem.emplace_back(s.value(), 0.0, 0.0);
  transfer.to_fem(k_dem, k_fem);
  std::vector<double> k(k_fem.size());
  for (std::size_t n = 0; n < k.size(); ++n) k[n] = k_fem[n].x();
  return k;
}

} // namespace

fem::FarField make_far_field(CoupledCase& c, MPI_Comm comm)
{
  fem::FarField far_field(c.far_field, comm);
  // The corners of the prism are the interface nodes of the surface.
  int corners = 0;
  for (const Eigen::Vector3d& x : far_field.interface().x)
    if (std::abs(x.z()) < fem::coincidence * c.height) ++corners;
  std::get<dem::HalfCylinder>(c.specimen.region).segments = corners - 1;
  return far_field;
}

CoupledSystem::CoupledSystem(const CoupledCase& c, fem::FarField field,
                             coupling::Interface interface)
    : far_field(std::move(field)), exchange(std::move(interface.transfer), far_field),
      x_interface(far_field.interface().x), model(c.model), safety(c.safety)
{
  assembly.material = c.material;
  assembly.motion = {dem::Vec3(0.0, 0.0, -c.gravity), c.damping, c.free_rotation};
  assembly.list = dem::VerletList(c.material.contact.g_a,
                                  dem::skin_under_pile * c.specimen.sizes.smallest());
  assembly.mirrors.emplace_back();
  assembly.walls.push_back(std::move(interface.wall));
  assembly.wall_bonds_yield = c.interface_bond == InterfaceBond::breakable;
}

CoupledSystem::CoupledSystem(const CoupledCase& c, const dem::Sample& sample,
                             fem::FarField field, coupling::Interface interface,
                             MPI_Comm comm)
    : CoupledSystem(c, std::move(field), std::move(interface))
{
  assembly.particles = sample.packing.particles;
  assembly.bonds = dem::make_bonds(assembly.particles, assembly.cell, sample.bonding.pairs);
  if (c.symmetry == Symmetry::mirror)
    dem::bond_to_mirror(assembly.mirrors.front(), assembly.particles, sample.bonding.limit);
  if (c.interface_bond != InterfaceBond::frictional)
    dem::bond_to_wall(assembly.walls.front(), assembly.particles, sample.bonding.limit);
  dem::distribute(assembly, comm);
  dem::add_forces(assembly, 0.0); // at dt = 0 histories do not change
  dt = dt_before = dem::stable_time_step(assembly, safety);
  lower_time_step(true);
}

void CoupledSystem::lower_time_step(bool far_field_too)
{
  dt = std::min(dt, dem::stable_time_step(assembly, safety));
  if (model == FarFieldModel::elastic && far_field_too) {
    const double far =
        far_field.stable_time_step(interface_springs(assembly, exchange.transfer()));
    dt = std::min(dt, safety * far / std::sqrt(1.0 + assembly.motion.damping));
  }
}

std::string CoupledSystem::where() const
{
  return " (step " + std::to_string(n_steps) + ", t = " + std::to_string(1e3 * time) +
         " ms)";
}

void CoupledSystem::balance_load()
{
  const double spent = assembly.times.total() - assembly.times.exchange;
  const double since = spent - spent_before_;
  spent_before_ = spent;
  const double most = assembly.comm.global_max(since),
               smallest = assembly.comm.global_min(since);
  if (most > imbalance_allowed * smallest) dem::rebalance(assembly, since);
}

double CoupledSystem::unbalanced() const
{
  const double particles = dem::unbalanced_ratio(assembly);
  return model == FarFieldModel::elastic ? std::max(particles, far_field.unbalanced_ratio())
                                         : particles;
}

coupling::InterfaceBalance CoupledSystem::balance()
{
  coupling::Nodal x = x_interface, u;
  if (model == FarFieldModel::elastic) {
    far_field.interface_displacement(u);
    for (std::size_t k = 0; k < x.size(); ++k) x[k] += u[k];
  }
  return coupling::interface_balance(exchange, assembly.walls.front(), x, assembly.comm);
}

CoupledSystem::EnergyBalances CoupledSystem::energy_balances() const
{
  return {dem::energy_balance(assembly, dt), far_field.energies()};
}

double CoupledSystem::unexplained(const EnergyBalances& now, const EnergyBalances& start)
{
  const auto net = [](const fem::Energies& e) {
    return e.kinetic + e.strain - e.interface_work - e.gravity_work -
           e.initial_stress_work + e.damping;
  };
  return dem::unexplained(now.assembly, start.assembly) + net(now.far_field) -
         net(start.far_field);
}

namespace {

/// Step with the walls of coupled.model until the unbalanced-force ratio is below `ratio`.
void relax(CoupledSystem& coupled, const char* phase, double ratio, std::size_t max_steps,
           const std::function<void()>& after_step)
{
  Progress progress(phase);
  const auto shown = [](double r) {
    char text[48];
    std::snprintf(text, sizeof text, "unbalanced-force ratio %.1e", r);
    return std::string(text);
  };
  double now = coupled.unbalanced(), first = now;
  std::size_t& n = coupled.settling.n;
  while (n < max_steps) {
    coupled.step([](double) {});
    ++n;
    if (n % 50 != 0) {
      after_step();
      continue;
    }
    dem::check_overlaps(coupled.assembly);
    now = coupled.unbalanced();
    first = std::max(first, now);
    if (coupled.assembly.comm.global_sum(coupled.assembly.losses.broken) > 0)
      throw Unstable(
          "a bond broke before equilibrium (" + shown(now) +
          "): the specimen is too weak for its own weight, or was made under pressure");
    if (now < ratio) {
      progress.done(shown(now) + ", " + std::to_string(n) + " steps");
      return;
    }
    const double part = std::log(first / now) / std::log(first / ratio);
    progress.update(std::clamp(part, 0.0, 1.0), [&] { return shown(now); });
    after_step();
  }
  throw Unstable(std::string(phase) + ": no equilibrium in " + std::to_string(max_steps) +
                 " steps: " + shown(now) + ", required " + dem::shortest(ratio) +
                 "; raise `Motion/damping` or `Motion/unbalanced-force tolerance`");
}

/// Put the far field in static equilibrium under the wall forces; the particles follow.
void settle_far_field(CoupledSystem& coupled)
{
  dem::Wall& wall = coupled.assembly.walls.front();
  const coupling::Nodal x = wall.x;
  const coupling::Nodal u = coupled.exchange.settle(wall);
  // As a motion over one step, so that every history is updated; at rest before and after.
  const double dt = coupled.dt;
  dem::Particles& p = coupled.assembly.particles;
  p.for_owned([&](dem::Index i) {
    dem::ParticleState& b = p.state[i];
    const dem::Vec3 moved = coupling::interpolate_inside(x, u, b.x);
    b.x += moved;
    b.v = moved / dt;
    b.omega.setZero();
  });
  coupled.assembly.list.invalidate();
  for (std::size_t k = 0; k < u.size(); ++k) wall.v[k] = u[k] / dt;
  dem::add_forces(coupled.assembly, dt);
  p.for_owned([&](dem::Index i) { p.state[i].v.setZero(); });
  for (dem::Vec3& v : wall.v) v.setZero();
}

} // namespace

void equilibrate(CoupledSystem& coupled, double ratio, std::size_t max_steps,
                 const std::function<void()>& after_step)
{
  using Phase = Settling::Phase;
  const FarFieldModel model = coupled.model;
  if (coupled.settling.phase == Phase::held) {
    coupled.model = FarFieldModel::rigid;
    relax(coupled, "settling in held walls", ratio, max_steps, after_step);
    coupled.model = model;
    if (model == FarFieldModel::elastic) settle_far_field(coupled);
    coupled.settling = {Phase::free, 0};
  }
  if (coupled.settling.phase == Phase::free) {
    if (model == FarFieldModel::elastic)
      relax(coupled, "settling with the far field", ratio, max_steps, after_step);
    coupled.assembly.partition.gather_motion(coupled.assembly.particles,
                                             coupled.assembly.comm);
    for (const dem::ParticleState& b : coupled.assembly.particles.state)
      coupled.x_0.push_back(b.x);
    coupled.settling = {Phase::done, 0};
  }
}

} // namespace mergel::apps
