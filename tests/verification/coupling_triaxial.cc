// coupling/README.md, Membrane and Triaxial test: a bonded specimen between platens in a membrane
// under a cell pressure.
#include "tests/support/catch.h"

#include "coupling/triaxial/triaxial_test.h"
#include "dem/assembly/averages.h"
#include "dem/specimen/bonding.h"

using namespace mergel;
using namespace mergel::coupling;
using dem::Vec3;

namespace {

constexpr double radius = 1.6e-3, height = 4e-3;

/// Some 130 particles of the size of the paper's at S = 5, elastic bonds.
dem::SpecimenSpec specimen()
{
  dem::SpecimenSpec s;
  s.region = dem::Cylinder{radius, height, 24};
  s.sizes = dem::Grading(dem::UniformSizes{0.33e-3, 0.668e-3});
  s.rho = 2556.0;
  s.porosity = 0.55;
  s.contact = dem::LinearMaterial{0.63e9, 2.4, 0.3, 5e-5};
  s.coordination = 5.5;
  s.g_b = 1.3e-4;
  return s;
}

CoupledSpec coupled_spec(const dem::SpecimenSpec& s)
{
  CoupledSpec spec;
  dem::DamageBond bond;
  bond.E = 22.5e9;
  bond.kappa = 2.4;
  bond.sigma_t = bond.sigma_c = bond.C = 1e13; // does not break
  bond.u_c = 2e-5;
  bond.theta_c = 0.04;
  spec.material = {bond, s.contact};
  spec.motion.damping = 0.7;
  spec.skin = 5e-5;
  spec.step.safety = 0.9;
  return spec;
}

fem::Tube tube()
{
  fem::Tube t = fem::Tube::with_node_distance(radius, -height, height, 0.25e-3);
  t.radius /= std::cos(dem::pi / t.n_around);
  return t;
}

/// A specimen between level platens in a membrane.
struct Cell {
  RigidPlaten *bottom, *top;
  MembraneStructure* membrane;
  std::unique_ptr<CoupledSystem> system;

  Cell()
  {
    const dem::SpecimenSpec s = specimen();
    const dem::Packing packing = dem::pack(
        s, [](double) {}, MPI_COMM_SELF);
    const dem::Bonding bonding = dem::choose_bonds(s, packing.particles, packing.cell);
    const dem::ContactLaw wall = dem::without_gap(s.contact);
    std::vector<StructureSpec> specs;
    const auto platen = [&](const char* name, double z, double axis) {
      PlatenSpec p;
      p.mesh = make_disc({0.0, 0.0, z}, {0.0, 0.0, axis}, 1.6 * radius, 16);
      auto structure = std::make_unique<RigidPlaten>(std::move(p));
      RigidPlaten* added = structure.get();
      specs.push_back({name, std::move(structure), wall});
      return added;
    };
    bottom = platen("bottom", -height, 1.0);
    top = platen("top", 0.0, -1.0);
    auto structure = std::make_unique<MembraneStructure>(
        fem::make_membrane(tube(), {0.87e6, 0.3e-3, 1000.0}), tube(), MembraneEnds::free,
        0.7, *bottom, *top);
    membrane = structure.get();
    specs.push_back({"membrane", std::move(structure), dem::with_friction(wall, 0.0)});
    system = std::make_unique<CoupledSystem>(coupled_spec(s), std::move(specs),
                                             packing.particles, bonding, MPI_COMM_SELF);
    system->settling.phase = Settling::Phase::done;
  }

  void run(int n, double from, double to)
  {
    for (int k = 1; k <= n; ++k) {
      membrane->set_pressure(from + (to - from) * k / n);
      system->step([](double) {});
    }
  }
};

/// sum of f (x) x over the nodes of a wall, -f on the wall: symmetric part [J].
dem::Mat3 virial_of(const dem::Wall& wall)
{
  dem::Mat3 sum = dem::Mat3::Zero();
  for (std::size_t k = 0; k < wall.x.size(); ++k)
    sum -= wall.f.value(k) * wall.x[k].transpose();
  return 0.5 * (sum + sum.transpose());
}

} // namespace

TEST_CASE("A specimen at rest in a membrane has the virial of cell pressure, platens and "
          "membrane",
          "[verification][coupling]")
{
  constexpr double p = 0.5e6;
  Cell cell;
  cell.run(4000, 0.0, p);
  cell.run(8000, p, p);
  const fem::MembraneMotion& motion = cell.membrane->motion();
  REQUIRE(motion.unbalanced_ratio() < 1e-3);

  // Exact at any time: what the particles feel is what the structures get.
  const InterfaceBalance balance = cell.system->balance();
  CHECK(balance.force < 1e-12);
  CHECK(balance.moment < 1e-12);
  CHECK(balance.power < 1e-12);

  // All branches, each with its whole height.
  const dem::Mat3 of_particles =
      dem::slab_stress(cell.system->assembly, -1.0, 1.0, 1.0) * 2.0;
  const auto& walls = cell.system->assembly.walls;
  const dem::Mat3 of_walls =
      virial_of(walls[0]) + virial_of(walls[1]) + virial_of(walls[2]);
  const double size = of_particles.norm();
  // The particles are at rest to the unbalanced-force ratio.
  CHECK((of_particles - of_walls).norm() < 1e-3 * size);

  // The membrane is at rest too: its wall's virial is that of the pressure less its own tension,
  // but for the ends, which the platens hold along z.
  const fem::NodalField& x = motion.state().x;
  fem::NodalField all, own;
  const fem::Membrane& membrane = motion.membrane();
  membrane.forces(x, p, all);
  membrane.forces(x, 0.0, own);
  const fem::MembraneTensions tensions = motion.membrane().tensions(x);
  double zz = -tensions.axial, pressure_zz = 0.0, ends = 0.0;
  for (Eigen::Index a = 0; a < x.cols(); ++a) {
    pressure_zz += (all(2, a) - own(2, a)) * x(2, a);
    if (motion.free()(2, a) == 0.0)
      ends -= (walls[2].f.value(static_cast<std::size_t>(a)).z() + all(2, a)) * x(2, a);
  }
  zz += pressure_zz + ends;
  CHECK(std::abs(zz - virial_of(walls[2])(2, 2)) < 1e-3 * size);

  // The cell pressure and the hoop tension in the stress of the middle third: 3 %, for the
  // branches at the membrane end beneath its mean surface.
  const double area = dem::volume(specimen().region) / height;
  const dem::Mat3 sigma = dem::slab_stress(cell.system->assembly, -2.0 / 3.0 * height,
                                           -1.0 / 3.0 * height, area);
  const double hoop = 0.5 * tensions.hoop / motion.enclosed().V;
  CHECK(-0.5 * (sigma(0, 0) + sigma(1, 1)) == Approx(p + hoop).epsilon(0.1));
  CHECK(cell.system->assembly.losses.broken == 0);
}

TEST_CASE("The energy of a specimen in a membrane that is loaded closes",
          "[verification][coupling]")
{
  Cell cell;
  const EnergyBalances start = cell.system->energy_balances();
  cell.run(4000, 0.0, 0.5e6);
  cell.top->set_drive(VelocityDrive{0.02});
  cell.bottom->set_drive(VelocityDrive{0.02});
  cell.run(4000, 0.5e6, 0.5e6);
  const EnergyBalances now = cell.system->energy_balances();
  const double work = now.structures.applied_work;
  REQUIRE(work > 1e-6);
  CHECK(std::abs(unexplained(now, start)) < 1e-3 * work);
}

TEST_CASE("The middle third gives back an affine deformation exactly",
          "[verification][coupling]")
{
  Cell cell;
  dem::Assembly& a = cell.system->assembly;
  std::vector<Vec3> x_0;
  for (const dem::ParticleState& b : a.particles.state) x_0.push_back(b.x);
  const MiddleThird middle(x_0, -height, height);
  dem::Mat3 F;
  F << 1.01, 0.02, 0.0, -0.01, 1.02, 0.03, 0.0, 0.01, 0.93;
  for (dem::ParticleState& b : a.particles.state) b.x = F * b.x + Vec3(1e-3, 2e-3, 3e-3);
  const SpecimenStrain strain = middle.strain(a);
  CHECK(strain.axial == Approx(0.07).epsilon(1e-10));
  CHECK(strain.lateral == Approx(-0.015).epsilon(1e-10));
  CHECK(strain.volumetric == Approx(1.0 - F.determinant()).epsilon(1e-10));
}

TEST_CASE("A triaxial test follows its stages and stops when a particle gets outside",
          "[verification][coupling]")
{
  Cell cell;
  TriaxialControl control;
  control.damping = 0.7;
  dem::LoadingStage isotropic;
  isotropic.quantity = dem::Quantity::p;
  isotropic.target = 0.3e6;
  dem::LoadingStage shear;
  shear.kind = dem::PathKind::triaxial;
  shear.quantity = dem::Quantity::axial_strain;
  shear.target = 1e-3;
  control.stages = {isotropic, shear};
  control.wave_stress = 5e4;
  TriaxialTest test(control,
                    {-height, height, dem::volume(specimen().region) / height, 1.2},
                    *cell.system);
  TriaxialRecord r;
  for (std::size_t stage = 0; stage < 2; ++stage) {
    test.begin_stage(stage);
    int n = 0;
    while (test.outcome() == dem::Outcome::goes_on && ++n < 60000) {
      test.step();
      if (test.record_is_due()) r = test.record();
    }
    REQUIRE(test.outcome() == dem::Outcome::done);
  }
  CHECK(r.cell_pressure == Approx(0.3e6).epsilon(0.01));
  CHECK(r.whole.axial_strain() > 8e-4); // the last record, 2e-4 before the end
  // Elastic: 1.1 GPa in a large specimen; with five particles across the platens' share is soft.
  const double E = r.whole.q() / r.of_stage.axial_strain();
  CHECK(E > 0.4e9);
  CHECK(E < 1.2e9);
  CHECK(std::abs(r.F_top - r.F_bottom) < 0.02 * r.F_top);
  CHECK(std::abs(r.energy_error) <
        3e-3); // of little work: a membrane that sinks into pores
  CHECK(r.membrane.delivered == Approx(r.cell_pressure).epsilon(0.03));

  cell.system->assembly.particles.state[10].x = Vec3(3.0 * radius, 0.0, -0.5 * height);
  cell.system->assembly.list.invalidate();
  CHECK_THROWS_AS(
      [&] {
        for (int k = 0; k < 2000; ++k) test.step();
      }(),
      std::exception);
}
