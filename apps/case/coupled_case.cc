#include "apps/case/coupled_case.h"

#include "apps/case/motion_keys.h"
#include "apps/case/unusual.h"
#include "dem/error.h"
#include "dem/text.h"

#include <cmath>

namespace mergel::apps {

namespace {

void declare_far_field(CaseFile& file, CoupledCase& c)
{
  const auto section = file.section("Far field");
  fem::FarFieldSpec& f = c.far_field;
  using Model = coupling::FarFieldStructure::Model;
  file.choice("model", c.model,
              std::vector<std::pair<std::string, Model>>{{"elastic", Model::elastic},
                                                         {"rigid", Model::rigid}},
              "Elastic solid, or the same walls held fixed.");
  file.quantity("chamber diameter", f.chamber_diameter, "m", positive,
                "Outer diameter of the far field.", "mm");
  file.quantity("chamber height", f.chamber_height, "m", positive,
                "From the surface to the fixed base.", "mm");
  file.quantity("cell size", f.cell_size, "m", positive,
                "Edge of the cells, and of the wall faces, at the DEM region.", "mm");
  file.former_name("growth", "mesh growth ratio");
  file.number("mesh growth ratio", f.growth, between(1.0, 3.0),
              "Ratio of neighbouring cell sizes away from the DEM region.");
  {
    const auto only = file.only_if("model", {"elastic"});
    file.path("elasticity from", c.elasticity_from,
              "Results folder of a test of the rock, `mergel element` with a stage of "
              "compression or triaxial: its summary.json gives E and nu.");
    file.derived("Young's modulus", f.E, "Pa", positive,
                 "required without `elasticity from`", "E of the intact rock.", "GPa");
    file.derived("Poisson ratio", f.nu, "1", from_to(0.0, 0.5).named("nu"),
                 "required without `elasticity from`", "nu of the intact rock.");
    file.derived("K0", f.K0, "1", non_negative, "nu/(1 - nu)",
                 "Initial horizontal over vertical stress; by default that of an elastic "
                 "solid that has settled between rollers.");
    file.choice(
        "outer boundary", f.outer,
        std::vector<std::pair<std::string, fem::FarFieldSpec::Outer>>{
            {"roller", fem::FarFieldSpec::Outer::roller},
            {"fixed", fem::FarFieldSpec::Outer::fixed},
            {"pressure", fem::FarFieldSpec::Outer::pressure}},
        "Chamber wall: no radial displacement, none at all, or a flexible wall under "
        "`side pressure`.");
    file.integer("largest subcycle", c.largest_subcycle, between(1.0, 10.0),
                 "Largest number of steps after which the far field's own forces act, by "
                 "impulse; fewer where its frequency asks for it. 1: at every step.");
  }
  {
    const auto only = file.only_if("outer boundary", {"pressure"});
    file.quantity(
        "side pressure", c.side_pressure, "Pa", non_negative,
        "On the chamber wall. It strains the chamber, whose initial stress is that "
        "at rest.",
        "kPa");
  }
  file.quantity(
      "surcharge", c.surcharge, "Pa", non_negative,
      "Vertical pressure on the surface of particles and far field: the state of a "
      "pile that starts at depth.",
      "kPa");
  file.choice("interface", c.interface_bond,
              std::vector<std::pair<std::string, InterfaceBond>>{
                  {"bonded", InterfaceBond::bonded},
                  {"breakable", InterfaceBond::breakable},
                  {"frictional", InterfaceBond::frictional}},
              "How particles are held at the far field: elastic bonds, bonds that may "
              "break, contact only.");
  file.derived(
      "interface modulus", c.interface_modulus, "Pa", positive, "that between particles",
      "Modulus of the contact of particles with the far field, in the sense of the "
      "contact law. Both sides are the same rock: by default `Contact/effective "
      "modulus` (linear), or half of `Contact/Young's modulus` (hertz).",
      "GPa");
  file.derived("interface friction", c.interface_friction, "1", non_negative,
               "Contact/friction", "Friction coefficient of that contact.");
  file.former_name("lip", "collar height");
  file.derived(
      "collar height", c.collar_height, "m", non_negative, "Specimen/diameter/5",
      "Height of the collar above the surface that keeps debris inside; by default "
      "above the heave of a pile that fits the region.",
      "mm");
}

void declare_motion(CaseFile& file, CoupledCase& c)
{
  const auto section = file.section("Motion");
  file.quantity("gravity", c.gravity, "m/s2", non_negative,
                "Downwards, on particles and far field.");
  file.number("damping", c.damping, from_to(0.0, 1.0).named("alpha"),
              "Local non-viscous damping of particles and far field.");
  declare(file, motion_keys(c));
  file.former_name("balance", "unbalanced-force tolerance");
  file.number("unbalanced-force tolerance", c.unbalanced_tolerance, inside(0.0, 1.0),
              "Unbalanced-force ratio at which a state counts as equilibrium.");
}

/// E and nu where the case does not give them: those of the test that it names.
void complete_elasticity(CaseFile& file, CoupledCase& c)
{
  const std::filesystem::path& folder = c.elasticity_from;
  if (folder.empty()) {
    for (const char* key : {"Young's modulus", "Poisson ratio"})
      if (!file.is_given("Far field", key))
        throw InputError(
            file.where("Far field", key) +
            ": must be given, or `elasticity from` names the results folder of "
            "a `mergel element` test that has measured it");
    return;
  }
  std::error_code error;
  const bool is_known = file.is_given("Far field", "Young's modulus") &&
                        file.is_given("Far field", "Poisson ratio");
  if (is_known && !std::filesystem::exists(folder, error)) return; // a resolved case
  try {
    c.rock = measured_elasticity(folder);
  } catch (const InputError& e) {
    if (is_known && file.is_continued()) return; // as above: the test is on its way again
    file.refuse("Far field", "elasticity from", e.what());
  }
  file.derive("Far field", "Young's modulus", c.rock->E);
  file.derive("Far field", "Poisson ratio", c.rock->nu);
}

} // namespace

void declare(CaseFile& file, CoupledCase& c)
{
  c.is_side_meshed = true;
  declare(file, static_cast<SpecimenKeys&>(c));
  declare(file, c.bond);
  declare(file, c.contact);
  declare_far_field(file, c);
  declare_motion(file, c);
}

void complete(CaseFile& file, CoupledCase& c)
{
  dem::SpecimenSpec& s = c.specimen;
  fem::FarFieldSpec& f = c.far_field;
  c.material = {c.bond.chosen(), c.contact.chosen()};
  if (c.shape == SpecimenKeys::Shape::periodic_box)
    file.refuse("Specimen", "shape",
                "the far field takes a cylinder or half of one: use `half cylinder`, or "
                "`cylinder` for the full model");
  const auto mm = [](double x) { return dem::rounded(1e3 * x) + " mm"; };
  if (c.diameter >= f.chamber_diameter)
    file.refuse(
        "Specimen", "diameter",
        "the DEM region does not fit the far field: must be below `Far field/chamber "
        "diameter`, " +
            mm(f.chamber_diameter));
  if (c.height >= f.chamber_height)
    file.refuse(
        "Specimen", "height",
        "the DEM region does not fit the far field: must be below `Far field/chamber "
        "height`, " +
            mm(f.chamber_height));
  if (f.cell_size > 0.5 * c.diameter)
    file.refuse("Far field", "cell size", "must be at most half of `Specimen/diameter`");

  f.extent = c.is_half() ? fem::Extent::half : fem::Extent::full;
  f.region_diameter = c.diameter;
  f.region_height = c.height;
  f.rho = s.rho * (1.0 - s.porosity);
  if (c.model == coupling::FarFieldStructure::Model::elastic) {
    complete_elasticity(file, c);
    file.derive("Far field", "K0", f.nu / (1.0 - f.nu));
    f.gravity = c.gravity;
    f.surcharge = c.surcharge;
    if (f.outer == fem::FarFieldSpec::Outer::pressure) f.side_pressure = c.side_pressure;
  } else { // a wall: it has neither strain nor stress
    f.E = 1.0;
    f.nu = f.K0 = f.gravity = 0.0;
  }
  file.derive("Far field", "interface modulus",
              0.5 * dem::modulus_at_rigid_wall(c.material.contact));
  file.derive("Far field", "interface friction", dem::friction(c.material.contact));
  file.derive("Far field", "collar height", 0.2 * c.diameter);
  f.damping = c.damping;
  complete(file, motion_keys(c));
  c.interface = wall_contact(c.material.contact, c.interface_modulus, c.interface_friction);
  try {
    f.check();
  } catch (const std::invalid_argument& e) {
    throw InputError(file.where("Far field", "chamber diameter") + ": " + e.what());
  }
  s.free_rotation = c.free_rotation;
  complete(file, static_cast<SpecimenKeys&>(c), c.material.contact);
  refuse_impossible(file, c.bond, c.contact);
  if (c.model == coupling::FarFieldStructure::Model::elastic)
    refuse_other_rock(file, "Far field", "Young's modulus", f.E, c.bond);
}

} // namespace mergel::apps
