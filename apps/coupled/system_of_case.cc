#include "apps/coupled/system_of_case.h"

#include "apps/run/progress.h"
#include "apps/run/ranks.h"
#include "coupling/equilibrium.h"
#include "dem/specimen/surface_load.h"
#include "fem/mesh_library.h"

#include <cmath>
#include <optional>
#include <sstream>

namespace mergel::apps {

void load_mesh_library()
{
  on_every_rank([] { fem::mesh_library(); });
}

fem::FarField make_far_field(CoupledCase& c, MPI_Comm comm)
{
  load_mesh_library();
  fem::FarField far_field(c.far_field, comm);
  // The corners of the prism are the interface nodes of the surface; those of a half do not
  // close a ring.
  int corners = 0;
  for (const Eigen::Vector3d& x : far_field.interface().x)
    if (std::abs(x.z()) < fem::coincidence * c.height) ++corners;
  if (auto* half = std::get_if<dem::HalfCylinder>(&c.specimen.region))
    half->segments = corners - 1;
  else
    std::get<dem::Cylinder>(c.specimen.region).segments = corners;
  return far_field;
}

coupling::CoupledSpec coupled_spec(const CoupledCase& c)
{
  coupling::CoupledSpec spec;
  spec.material = c.material;
  spec.motion = {dem::Vec3(0.0, 0.0, -c.gravity), c.damping, c.free_rotation,
                 c.inertia_factor, c.largest_overlap};
  spec.skin = dem::skin_under_penetration * c.specimen.sizes.smallest();
  spec.step = c.step;
  spec.mass_scaling = c.mass_scaling;
  if (c.is_half())
    spec.symmetry = c.symmetry == Symmetry::mirror ? coupling::SymmetryPlane::bonded
                                                   : coupling::SymmetryPlane::contact;
  spec.strengths = c.strengths;
  spec.is_smooth_while_held = c.surcharge > 0.0;
  spec.largest_subcycle = static_cast<std::size_t>(c.largest_subcycle);
  return spec;
}

std::vector<coupling::StructureSpec> structures(const CoupledCase& c,
                                                fem::FarField far_field)
{
  std::vector<coupling::StructureSpec> specs;
  specs.push_back({"far_field",
                   std::make_unique<coupling::FarFieldStructure>(std::move(far_field),
                                                                 c.model, c.collar_height),
                   c.interface, c.interface_bond != InterfaceBond::frictional,
                   c.interface_bond == InterfaceBond::breakable});
  return specs;
}

void apply_surcharge(const CoupledCase& c, dem::Particles& p)
{
  if (c.surcharge > 0.0)
    p.applied_force = dem::surface_load(p, c.specimen.region, c.surcharge);
}

namespace {

/// rho c of plane compression waves [Pa s/m]; -1 < nu < 0.5.
double impedance(double rho, double E, double nu)
{
  return std::sqrt(rho * E * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)));
}

} // namespace

std::string report_on_impedance(const CoupledCase& c)
{
  if (c.model != coupling::FarFieldStructure::Model::elastic) return "";
  const fem::FarFieldSpec& f = c.far_field;
  const double far = impedance(f.rho, f.E, f.nu);
  std::ostringstream out;
  out.precision(3);
  out << "far field: impedance rho c " << far << " Pa s/m";
  if (!c.rock) return out.str() + '\n';
  const double rock = impedance(f.rho, c.rock->E, c.rock->nu), ratio = rock / far;
  out << ", that of the rock " << rock << " Pa s/m, ratio " << ratio << '\n';
  if (std::abs(ratio - 1.0) > 0.1)
    out << "warning: rock and far field differ in impedance by more than 10 %, so waves "
           "come "
           "back from the interface: leave out `Far field/Young's modulus` and `Poisson "
           "ratio`, which then follow from `elasticity from`\n";
  return out.str();
}

const fem::FarField& far_field_of(const coupling::CoupledSystem& coupled)
{
  return dynamic_cast<const coupling::FarFieldStructure&>(
             *coupled.structures.front().structure)
      .far_field();
}

void equilibrate(coupling::CoupledSystem& coupled, double ratio, std::size_t max_steps,
                 const std::function<void()>& after_step)
{
  std::optional<Progress> progress;
  const coupling::EquilibriumReport report{
      .begin = [&](const std::string& phase) { progress.emplace(phase); },
      .update = [&](double fraction,
                    const std::string& detail) { progress->update(fraction, detail); },
      .done = [&](const std::string& detail) { progress->done(detail); }};
  coupling::equilibrate(coupled, {ratio, max_steps}, report, after_step);
}

} // namespace mergel::apps
