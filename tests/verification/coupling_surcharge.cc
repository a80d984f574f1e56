// coupling/README.md, Surcharge: particles and far field under a pressure on their surface.
#include "coupling/equilibrium.h"
#include "coupling/far_field_structure.h"
#include "dem/specimen/surface_load.h"
#include "tests/support/catch.h"
#include "tests/support/cubic_crystal.h"

using namespace mergel;
using namespace mergel::coupling;
using dem::Vec3;

namespace {

constexpr double d = 1e-3, q = 1e6; // [m], [Pa]
constexpr int n_radius = 6, n_layers = 12;

/// A cubic crystal in a far field of the same E and nu = 0, which is at rest under the
/// surcharge with K0 = 0.
struct Chamber {
  test::CubicCrystal crystal{d};
  std::unique_ptr<CoupledSystem> coupled;
  double area = 0.0; ///< of the surface of the DEM region [m^2]

  explicit Chamber(double damping)
  {
    fem::FarFieldSpec f;
    f.region_diameter = 2.0 * n_radius * d;
    f.region_height = n_layers * d;
    f.chamber_diameter = f.chamber_height = 2.0 * f.region_diameter;
    f.cell_size = 2.0 * d;
    f.E = crystal.E;
    f.rho = crystal.rho;
    f.nu = f.K0 = f.gravity = 0.0;
    f.surcharge = q;
    f.damping = damping;
    fem::FarField far_field(f);
    dem::HalfCylinder region{0.5 * f.region_diameter, f.region_height, -1};
    for (const Vec3& x : far_field.interface().x) region.segments += x.z() > -1e-9;
    area = dem::volume(region) / region.height;
    crystal.fill(
        {-n_radius, 0, -n_layers}, {n_radius, n_radius, 0}, 0.5 * d,
        [&](const Vec3& x) { return dem::is_inside_by(region, x, 0.499 * d); },
        [](const Vec3&) { return false; });
    crystal.particles.applied_force = dem::surface_load(crystal.particles, region, q);

    std::vector<StructureSpec> structures;
    structures.push_back({"far_field",
                          std::make_unique<FarFieldStructure>(
                              std::move(far_field), FarFieldStructure::Model::elastic, 0.0),
                          crystal.contact(), true, false});
    CoupledSpec spec;
    spec.material = crystal.material();
    spec.motion.damping = damping;
    spec.skin = 0.1 * d;
    spec.symmetry = SymmetryPlane::bonded;
    spec.is_smooth_while_held = true;
    coupled = std::make_unique<CoupledSystem>(
        spec, std::move(structures), crystal.particles, crystal.bonding, MPI_COMM_SELF);
  }

  double settlement(std::size_t i) const
  {
    return crystal.particles.state[i].x.z() - coupled->assembly.particles.state[i].x.z();
  }
};

} // namespace

TEST_CASE(
    "the particles carry the surcharge at every depth and settle by sigma h/M, and the "
    "far field stays where it is",
    "[verification][coupling]")
{
  Chamber c(0.7);
  equilibrate(*c.coupled, {1e-5, 100000}, {}, {});
  // nu = 0: M = E. The columns of the crystal fill 80 % of the half polygon and carry all of
  // its surcharge.
  std::vector<double> u(n_layers, 0.0);
  double n_columns = 0.0;
  for (std::size_t i = 0; i < c.crystal.particles.size(); ++i) {
    const double depth = -c.crystal.particles.state[i].x.z();
    u[static_cast<std::size_t>(depth / d)] += c.settlement(i);
    n_columns += depth < d ? 1.0 : 0.0;
  }
  for (double& mean : u) mean /= n_columns;
  const double sigma = q * c.area / (n_columns * d * d);
  for (std::size_t k = 0; k + 1 < n_layers; ++k) {
    const double stress = c.crystal.E * (u[k] - u[k + 1]) / d;
    CAPTURE(k, stress / sigma);
    // The floor, on which the columns stand on 80 % of its area, sinks a little, and they hang
    // on the side there: measured 0.1 % above the middle, 1 % at it, 5 % at the floor.
    CHECK(stress == Approx(sigma).epsilon(k < n_layers / 2 ? 0.015 : 0.06));
  }
  CHECK(u.front() - u.back() == // measured 1.7 % less
        Approx(sigma * (n_layers - 1) * d / c.crystal.E).epsilon(0.03));

  Nodal moved;
  dynamic_cast<const FarFieldStructure&>(*c.coupled->structures[0].structure)
      .far_field()
      .interface_displacement(moved);
  double largest = 0.0;
  for (const Vec3& v : moved) largest = std::max(largest, v.norm());
  CHECK(largest < 0.12 * u.front()); // measured 7 %, at the floor
}

TEST_CASE("the work of a surcharge closes the energy balance of particles and far field",
          "[verification][coupling]")
{
  Chamber c(0.3);
  const EnergyBalances start = c.coupled->energy_balances();
  for (int k = 0; k < 1000; ++k) c.coupled->step([](double) {});
  const EnergyBalances now = c.coupled->energy_balances();
  CHECK(now.assembly.gravity > 1e-4); // [J]
  // Measured 2.4e-7: a closed contact at the start of the step, and round-off.
  CHECK(std::abs(unexplained(now, start)) < 1e-5 * now.assembly.gravity);
}
