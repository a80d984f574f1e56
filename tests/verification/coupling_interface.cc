// coupling/README.md, Interface balance: force, moment and power agree to round-off.
#include "coupling/far_field_structure.h"
#include "coupling/interface_balance.h"
#include "dem/assembly/energy_balance.h"
#include "dem/assembly/step.h"
#include "dem/math/random.h"
#include "tests/support/catch.h"
#include "tests/support/small_chamber.h"

using namespace mergel;
using dem::Vec3;

namespace {

fem::FarFieldSpec small_far_field()
{
  fem::FarFieldSpec s = small_chamber();
  s.region_height = 8e-3;
  s.chamber_diameter = s.chamber_height = 20e-3;
  s.gravity = s.damping = 0.0;
  return s;
}

const dem::LinearMaterial contact{0.63e9, 2.4, 0.3, 0.0};

coupling::FarFieldStructure elastic_far_field(double collar_height)
{
  return {fem::FarField(small_far_field()), coupling::FarFieldStructure::Model::elastic,
          collar_height};
}

/// Forces up, structure, velocities down.
void exchange_step(coupling::Exchange& exchange, dem::Wall& wall, double dt)
{
  exchange.sum_forces(wall);
  exchange.step_structure(dt);
  exchange.move_wall(wall, dt);
}

/// Particles pressed into the side and base of the region, some bonded to it, all in
/// motion; no two touch.
dem::Assembly assembly_at(const dem::Wall& wall)
{
  dem::Assembly assembly;
  assembly.material.contact = contact;
  dem::DamageBond bond;
  bond.E = 22.5e9;
  bond.kappa = 2.4;
  bond.sigma_t = 36e6;
  bond.sigma_c = 198e6;
  bond.C = 40.5e6;
  bond.u_c = 4e-6;
  bond.theta_c = 0.04;
  assembly.material.bond = bond;
  assembly.motion.damping = 0.0;
  assembly.list = dem::VerletList(0.0, 2e-5);
  const double R = 0.2e-3, overlap = 1e-6;
  std::uint64_t k = 0;
  for (std::size_t t = 0; t < wall.topology.triangles.size(); t += 3, ++k) {
    const auto u = [&](std::uint64_t draw) { return dem::uniform(7, k, draw); };
    const dem::Triangle& tri = wall.topology.triangles[t];
    Vec3 c = Vec3::Zero();
    for (const int n : tri) c += wall.x[static_cast<std::size_t>(n)] / 3.0;
    if (c.z() > -R) continue; // not on the collar
    dem::ParticleState b;
    b.R = R;
    b.m = dem::sphere_mass(R, 2556.0);
    b.x = c + (R - overlap) * normal(wall, static_cast<int>(t));
    b.v = Vec3(u(0) - 0.5, u(1) - 0.5, u(2) - 0.5);
    b.omega = 1e3 * Vec3(u(3) - 0.5, u(4) - 0.5, u(5) - 0.5);
    assembly.particles.add(b);
  }
  assembly.walls.push_back(wall);
  dem::bond_to_wall(assembly.walls.front(), assembly.particles, 0.0); // those that overlap
  assembly.walls.front().bonds.resize(assembly.walls.front().bonds.size() /
                                      2); // the rest slides
  return assembly;
}

Vec3 momentum(const dem::Particles& p)
{
  Vec3 sum = Vec3::Zero();
  for (const dem::ParticleState& b : p.state) sum += b.m * b.v;
  return sum;
}

} // namespace

TEST_CASE("interface force, moment and power balance to 1e-12", "[verification][coupling]")
{
  coupling::FarFieldStructure far_field = elastic_far_field(1e-3);
  coupling::Interface interface = far_field.interface(contact);
  dem::Assembly assembly = assembly_at(interface.wall);
  coupling::Exchange exchange(interface.transfer, far_field);
  dem::Wall& wall = assembly.walls.front();

  const double dt = 2e-8;
  dem::add_forces(assembly, 0.0);
  coupling::InterfaceBalance worst;
  double work = 0.0;
  for (int n = 0; n < 200; ++n) {
    dem::advance(assembly, dt, dt, [&](double h) { exchange_step(exchange, wall, h); });
    worst = coupling::worst(worst, coupling::interface_balance(exchange, wall, {}));
    for (std::size_t k = 0; k < wall.f.size(); ++k)
      work = std::max(work, wall.f.value(k).norm());
  }
  REQUIRE(work > 0.01); // forces act on the interface [N]
  // Round-off of sums over 100 nodes, plus the quantum of the exact sums, 1e-15 N.
  CHECK(worst.force < 1e-12);
  CHECK(worst.moment < 1e-12);
  CHECK(worst.power < 1e-12);
}

TEST_CASE("the wall gets the momentum and energy that the particles lose",
          "[verification][coupling]")
{
  coupling::FarFieldStructure far_field = elastic_far_field(0.0);
  coupling::Interface interface = far_field.interface(contact);
  dem::Assembly assembly = assembly_at(interface.wall);
  coupling::Exchange exchange(interface.transfer, far_field);
  dem::Wall& wall = assembly.walls.front();

  const double dt = 1e-8;
  dem::add_forces(assembly, 0.0);
  const Vec3 before = momentum(assembly.particles);
  const auto start = dem::energy_balance(assembly, dt);
  const double far_start = far_field.energies().net();
  Vec3 impulse = Vec3::Zero();
  for (int n = 0; n < 2000; ++n) {
    for (std::size_t k = 0; k < wall.f.size(); ++k) impulse += dt * wall.f.value(k);
    dem::advance(assembly, dt, dt, [&](double h) { exchange_step(exchange, wall, h); });
  }
  const auto end = dem::energy_balance(assembly, dt);
  const double scale = start.kinetic;

  // 2,000 steps of round-off, each 1e-16 of the momentum that moves.
  CHECK((momentum(assembly.particles) - before + impulse).norm() < 1e-12 * impulse.norm());
  // The far field has what the particles lost. The two energy balances count the same work
  // half a step apart. Each holds on its own, to second order in the step (measured 2e-5 in
  // total).
  CHECK(std::abs(dem::unexplained(end, start)) < 1e-3 * scale);
  CHECK(std::abs(far_field.energies().net() - far_start) < 1e-9 * scale);
  const coupling::StructureEnergies e = far_field.energies();
  CHECK(e.wall_work == Approx(-end.wall_work).epsilon(1e-2));
  CHECK(e.wall_work > 0.0);
}

TEST_CASE("the collar follows the surface nodes and keeps the normals of the side",
          "[verification][coupling]")
{
  fem::FarField far_field(small_far_field());
  const auto& mesh = far_field.interface();
  const coupling::Interface with = coupling::make_interface(mesh, contact, 1e-3);
  CHECK(with.wall.x.size() > mesh.x.size());
  CHECK(with.wall.topology.n_patches == 2); // side with its collar, and base
  for (std::size_t t = mesh.triangles.size(); t < with.wall.topology.triangles.size();
       ++t) {
    const Vec3& corner =
        with.wall.x[static_cast<std::size_t>(with.wall.topology.triangles[t][0])];
    CHECK(normal(with.wall, static_cast<int>(t)).z() == Approx(0.0).margin(1e-12));
    CHECK(normal(with.wall, static_cast<int>(t)).dot(Vec3(corner.x(), corner.y(), 0.0)) <
          0.0); // inwards
  }
  coupling::Nodal v(mesh.x.size(), Vec3(1.0, 2.0, 3.0)), down;
  with.transfer.to_wall(v, down);
  for (const Vec3& each : down) CHECK(each == Vec3(1.0, 2.0, 3.0));
}

TEST_CASE("rebuilding the lists at every step changes no bit, walls and mirror included",
          "[verification][coupling]")
{
  fem::FarField far_field(small_far_field());
  const coupling::Interface interface =
      coupling::make_interface(far_field.interface(), contact, 1e-3);
  const auto run = [&](bool rebuild_always) {
    dem::Assembly assembly = assembly_at(interface.wall);
    assembly.motion.damping = 0.3;
    // A second particle on top of each, and one at the symmetry plane: pairs, walls,
    // mirror, pile.
    const std::size_t n = assembly.particles.size();
    for (std::size_t k = 0; k < n; k += 2) {
      dem::ParticleState b = assembly.particles.state[k];
      b.x += (Vec3(0.0, 2.5e-3, -4e-3) - b.x).normalized() * 1.98 * b.R;
      b.v = -b.v;
      assembly.particles.add(b);
    }
    dem::ParticleState at_cut = assembly.particles.state.front();
    at_cut.x = {0.4e-3, at_cut.R * 0.999, -2e-3};
    assembly.particles.add(at_cut);
    assembly.mirrors.emplace_back();
    assembly.rigid_walls.push_back(dem::make_rigid_wall(dem::cone_ended(0.2e-3, 0.3e-3),
                                                        {0.0, 0.0, -2.2e-3}, contact));
    dem::add_forces(assembly, 0.0);
    for (int s = 0; s < 3000; ++s) {
      if (rebuild_always) assembly.list.invalidate();
      dem::advance(assembly, 2e-8, 2e-8, [](double) {});
    }
    return assembly;
  };
  const dem::Assembly once = run(false), always = run(true);
  CHECK(always.list.n_builds() == 3001);
  CHECK(once.list.n_builds() > 1); // lists were rebuilt
  CHECK(once.list.n_builds() < 300);
  CHECK(once.losses.slip.value() > 0.0);
  for (std::size_t i = 0; i < once.particles.size(); ++i) {
    CHECK(once.particles.state[i].x == always.particles.state[i].x);
    CHECK(once.particles.state[i].omega == always.particles.state[i].omega);
  }
}
