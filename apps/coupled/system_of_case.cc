#include "apps/coupled/system_of_case.h"

#include "apps/run/progress.h"
#include "coupling/equilibrium.h"

#include <cmath>
#include <optional>

namespace mergel::apps {

fem::FarField make_far_field(CoupledCase& c, MPI_Comm comm)
{
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
