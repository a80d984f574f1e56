#include "apps/pile/pile_plan.h"

#include "fem/far_field/far_field_geometry.h"

#include <cmath>

namespace mergel::apps {

namespace {

/// Chamber over pile diameter below which its wall is felt at the cone [-]: calibration chambers
/// have 20 and more.
constexpr double narrowest_chamber = 10.0;
/// Widths of the DEM region in pile diameters: bonds break up to some two from the axis.
constexpr double narrowest_region = 4.0;
/// Inertial number of a penetration that is still taken as quasi-static [-]; element tests ask
/// for less.
constexpr double quasi_static_pile = 1e-2;

/// v/D_p d50 sqrt(rho/p), p the pressure at which the bonds under the tip are crushed.
double inertial_number(const PileCase& c)
{
  const dem::BondLaw bond = c.assembly.bond.chosen();
  const double p = std::visit(
      [](const auto& law) {
        const dem::BondShape<double> shape = bond_shape(law, 1.0, 1.0);
        const dem::SingleStrengths s = single_strengths(law, shape);
        return (std::isfinite(s.compression) ? s.compression : s.shear) / shape.A;
      },
      bond);
  return c.velocity / c.diameter * smallest_d_50(c.assembly) *
         std::sqrt(c.assembly.specimen.rho / p);
}

/// Time that the stages take by their targets [s]: without what a hold, a load or an unloading
/// needs until its equilibrium.
double loading_time(const PileCase& c)
{
  // Each of the two ramps of a motion, 0.05 D_p long, takes twice its time at full velocity.
  const double ramps = 0.1 * c.diameter;
  double time = 0.0, tip = 0.0;
  for (const PileStage& s : c.stages) switch (s.kind) {
    case PileStage::Kind::penetrate:
      time += (c.tip_at_end(s) - tip + ramps) / c.velocity;
      tip = c.tip_at_end(s);
      break;
    case PileStage::Kind::pull:
      tip -= s.target;
      [[fallthrough]];
    case PileStage::Kind::push:
      time += std::abs(s.target) / c.displacement_rate;
      break;
    case PileStage::Kind::unload:
    case PileStage::Kind::load:
      time += c.force_ramp;
      break;
    case PileStage::Kind::hold:
      if (std::isfinite(s.target)) time += s.target;
      break;
    }
  return time;
}

} // namespace

Remarks unusual(const PileCase& c)
{
  const CoupledCase& a = c.assembly;
  Remarks remarks;
  expect_at_least(remarks, "D_p/d50", c.diameter / smallest_d_50(a), fewest_across,
                  "the particles under the tip are few, and q_c depends on their size");
  expect_at_least(remarks, "chamber diameter/D_p",
                  a.far_field.chamber_diameter / c.diameter, narrowest_chamber,
                  "the wall of the chamber stiffens what the pile feels");
  expect_at_least(remarks, "Specimen/diameter/D_p", a.diameter / c.diameter,
                  narrowest_region, "bonds break up to two diameters from the axis");
  expect_at_most(remarks, "inertial number v d50/D_p sqrt(rho/p)", inertial_number(c),
                 quasi_static_pile,
                 "the penetration is not quasi-static; lower `Pile/penetration rate`");
  remark_on_specimen(remarks, a);
  remark_on_motion(remarks, a.contact, a.damping);
  remark_on_materials(remarks, a.bond, a.contact);
  remark_on_bonds(remarks, a.bond, a);
  if (a.model == coupling::FarFieldStructure::Model::elastic)
    remark_on_other_rock(remarks, "far field", a.far_field.E, a.bond);
  return remarks;
}

Plan plan_of(const CaseFile& file, const PileCase& c)
{
  CoupledCase a = c.assembly;
  const fem::FarFieldLayers layers =
      fem::layers({0.5 * a.far_field.chamber_diameter, a.far_field.chamber_height,
                   0.5 * a.diameter, a.height, a.far_field.cell_size, a.far_field.growth});
  // Its side has two faces until the mesh is made.
  if (auto* half = std::get_if<dem::HalfCylinder>(&a.specimen.region))
    half->segments = layers.n_around;
  else
    std::get<dem::Cylinder>(a.specimen.region).segments = 2 * layers.n_around;
  Plan plan = plan_of_specimen(file, a, a.material, a.step.safety, a.inertia_factor);
  plan.unusual = unusual(c);
  plan.n_cells = layers.n_cells(a.far_field.extent);
  plan.n_steps = loading_time(c) / plan.step;
  plan.steps_by =
      c.has_stages()
          ? "travel and ramps over rate and step; more to reach each equilibrium"
          : "travel over penetration rate and step; some thousands more to settle";
  return plan;
}

Plan plan_pile(const JobOptions& options)
{
  return plan_case<PileCase>(options);
}

} // namespace mergel::apps
