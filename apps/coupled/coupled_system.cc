#include "apps/coupled/coupled_system.h"

#include "apps/run/progress.h"
#include "dem/assembly/distribute.h"
#include "dem/text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace mergel::apps {

namespace {

/// Springs of the rock on the far-field nodes [N/m]: bonds, and every contact that may close,
/// each in full on all corners of the triangles it can reach: a bound.
std::vector<double> interface_springs(const dem::Rock& rock,
                                      const coupling::Transfer& transfer)
{
  // Of the places now, not of those when the lists were built: that instant must not show.
  dem::Wall wall = rock.walls.front();
  dem::rebuild_wall(wall, rock.particles, rock.list.skin());
  std::vector<dem::ForceSum> sums(wall.x.size()); // [N/m]
  const auto add = [&](int triangle, const dem::Vec3& weight, double k) {
    const dem::Triangle& t = wall.topology.triangles[static_cast<std::size_t>(triangle)];
    for (int c = 0; c < 3; ++c)
      sums[static_cast<std::size_t>(t[static_cast<std::size_t>(c)])].add(weight[c] * k);
  };
  const auto radius = [&](dem::Index i) { return rock.particles.body[i].R; };
  for (const dem::WallBond& b : wall.bonds) {
    const double R = radius(b.particle);
    if (b.state.intact > 0.0)
      add(b.anchor.triangle, b.anchor.weight,
          dem::bond_shape(dem::section(rock.material.bond), R, 1.0 / R).k_n);
  }
  for (std::size_t k = 0; k < wall.contacts.size(); ++k) {
    const double R = radius(wall.contacts[k].particle);
    for (const auto& near : wall.listed[k].near)
      add(near.triangle, dem::Vec3::Ones(),
          dem::linear_stiffness(wall.material, R, 1.0 / R).k_n);
  }
  dem::ExactReduction all;
  for (dem::ForceSum& s : sums) all.add(s);
  all.run(rock.comm);
  coupling::Nodal k_dem, k_fem;
  for (const dem::ForceSum& s : sums) k_dem.emplace_back(s.value(), 0.0, 0.0);
  transfer.to_fem(k_dem, k_fem);
  std::vector<double> k(k_fem.size());
  for (std::size_t n = 0; n < k.size(); ++n) k[n] = k_fem[n].x();
  return k;
}

} // namespace

fem::FarField make_far_field(RockCase& c)
{
  fem::FarField far_field(c.far_field, MPI_COMM_WORLD);
  // The corners of the prism are the interface nodes of the surface.
  int corners = 0;
  for (const Eigen::Vector3d& x : far_field.interface().x)
    if (std::abs(x.z()) < 1e-9 * c.height) ++corners;
  std::get<dem::HalfCylinder>(c.specimen.region).segments = corners - 1;
  return far_field;
}

CoupledRock::CoupledRock(const RockCase& c, fem::FarField field,
                         coupling::Interface interface)
    : far_field(std::move(field)), exchange(std::move(interface.transfer), far_field),
      x_interface(far_field.interface().x), model(c.model), safety(c.safety)
{
  rock.material = c.material;
  rock.motion = {dem::Vec3(0.0, 0.0, -c.gravity), c.damping, c.free_rotation};
  // A skin of 0.45 d00 S: some hundred steps between rebuilds under a pile at 1 m/s.
  rock.list = dem::VerletList(c.material.contact.g_a, 0.45 * c.specimen.sizes.smallest());
  rock.mirrors.emplace_back();
  rock.walls.push_back(std::move(interface.wall));
  rock.wall_bonds_yield = c.interface_bond == InterfaceBond::breakable;
}

CoupledRock::CoupledRock(const RockCase& c, const dem::Sample& sample, fem::FarField field,
                         coupling::Interface interface)
    : CoupledRock(c, std::move(field), std::move(interface))
{
  rock.particles = sample.packing.particles;
  rock.bonds = dem::make_bonds(rock.particles, rock.cell, sample.bonding.pairs);
  if (c.symmetry == Symmetry::mirror)
    dem::bond_to_mirror(rock.mirrors.front(), rock.particles, sample.bonding.limit);
  if (c.interface_bond != InterfaceBond::frictional)
    dem::bond_to_wall(rock.walls.front(), rock.particles, sample.bonding.limit);
  dem::share_out(rock, MPI_COMM_WORLD);
  dem::add_forces(rock, 0.0); // nothing has moved yet: histories stay
  dt = dt_before = dem::stable_time_step(rock, safety);
  lower_time_step(true);
}

void CoupledRock::lower_time_step(bool far_field_too)
{
  dt = std::min(dt, dem::stable_time_step(rock, safety));
  if (model == FarFieldModel::elastic && far_field_too) {
    const double far =
        far_field.stable_time_step(interface_springs(rock, exchange.transfer()));
    dt = std::min(dt, safety * far / std::sqrt(1.0 + rock.motion.damping));
  }
}

std::string CoupledRock::where() const
{
  return " (step " + std::to_string(n_steps) + ", t = " + std::to_string(1e3 * time) +
         " ms)";
}

void CoupledRock::even_out()
{
  const double spent = rock.times.total() - rock.times.exchange;
  const double since = spent - spent_before_;
  spent_before_ = spent;
  const double most = rock.comm.global_max(since), least = rock.comm.global_min(since);
  if (most > imbalance_allowed * least) dem::rebalance(rock, since);
}

double CoupledRock::unbalanced() const
{
  const double grains = dem::unbalanced_ratio(rock);
  return model == FarFieldModel::elastic ? std::max(grains, far_field.unbalanced_ratio())
                                         : grains;
}

coupling::InterfaceBalance CoupledRock::balance()
{
  coupling::Nodal x = x_interface, u;
  if (model == FarFieldModel::elastic) {
    far_field.interface_displacement(u);
    for (std::size_t k = 0; k < x.size(); ++k) x[k] += u[k];
  }
  return coupling::interface_balance(exchange, rock.walls.front(), x, rock.comm);
}

CoupledRock::Books CoupledRock::books() const
{
  return {dem::energy_book(rock, dt), far_field.energies()};
}

double CoupledRock::unexplained(const Books& now, const Books& start)
{
  const auto net = [](const fem::Energies& e) {
    return e.kinetic + e.strain - e.interface_work - e.gravity_work -
           e.initial_stress_work + e.damping;
  };
  return dem::unexplained(now.rock, start.rock) + net(now.far_field) - net(start.far_field);
}

namespace {

/// Relax with the walls as `model` says until the unbalanced ratio is below `ratio`.
void relax(CoupledRock& coupled, const char* stage, double ratio, std::size_t most_steps,
           const std::function<void()>& after_step)
{
  Progress progress(stage);
  const auto shown = [](double r) {
    char text[48];
    std::snprintf(text, sizeof text, "unbalanced ratio %.1e", r);
    return std::string(text);
  };
  double now = coupled.unbalanced(), first = now;
  std::size_t& n = coupled.settling.n;
  while (n < most_steps) {
    coupled.step([](double) {});
    ++n;
    if (n % 50 != 0) {
      after_step();
      continue;
    }
    dem::check_overlaps(coupled.rock);
    now = coupled.unbalanced();
    first = std::max(first, now);
    if (coupled.rock.comm.global_sum(coupled.rock.losses.broken) > 0)
      throw Unstable(
          "a bond broke before anything was driven (" + shown(now) +
          "): the specimen is too weak for its own weight, or was made under pressure");
    if (now < ratio) {
      progress.done(shown(now) + ", " + std::to_string(n) + " steps");
      return;
    }
    const double part = std::log(first / now) / std::log(first / ratio);
    progress.update(std::clamp(part, 0.0, 1.0), [&] { return shown(now); });
    after_step();
  }
  throw Unstable(std::string(stage) + ": no equilibrium in " + std::to_string(most_steps) +
                 " steps: " + shown(now) + ", wanted " + dem::shortest(ratio) +
                 "; raise `Motion/damping` or `Motion/balance`");
}

/// Put the far field in static equilibrium under the rock's forces, and the rock with it.
void settle_far_field(CoupledRock& coupled)
{
  dem::Wall& wall = coupled.rock.walls.front();
  const coupling::Nodal x = wall.x;
  const coupling::Nodal u = coupled.exchange.settle(wall);
  // As a motion over one step, so that every history sees it; at rest before and after.
  const double dt = coupled.dt;
  dem::Particles& p = coupled.rock.particles;
  p.for_owned([&](dem::Index i) {
    dem::Body& b = p.body[i];
    const dem::Vec3 moved = coupling::interpolate_inside(x, u, b.x);
    b.x += moved;
    b.v = moved / dt;
    b.omega.setZero();
  });
  coupled.rock.list.invalidate();
  for (std::size_t k = 0; k < u.size(); ++k) wall.v[k] = u[k] / dt;
  dem::add_forces(coupled.rock, dt);
  p.for_owned([&](dem::Index i) { p.body[i].v.setZero(); });
  for (dem::Vec3& v : wall.v) v.setZero();
}

} // namespace

void equilibrate(CoupledRock& coupled, double ratio, std::size_t most_steps,
                 const std::function<void()>& after_step)
{
  using Stage = Settling::Stage;
  const FarFieldModel model = coupled.model;
  if (coupled.settling.stage == Stage::held) {
    coupled.model = FarFieldModel::rigid;
    relax(coupled, "settling in held walls", ratio, most_steps, after_step);
    coupled.model = model;
    if (model == FarFieldModel::elastic) settle_far_field(coupled);
    coupled.settling = {Stage::free, 0};
  }
  if (coupled.settling.stage == Stage::free) {
    if (model == FarFieldModel::elastic)
      relax(coupled, "settling with the far field", ratio, most_steps, after_step);
    coupled.rock.partition.gather_motion(coupled.rock.particles, coupled.rock.comm);
    for (const dem::Body& b : coupled.rock.particles.body) coupled.x_0.push_back(b.x);
    coupled.settling = {Stage::done, 0};
  }
}

} // namespace mergel::apps
