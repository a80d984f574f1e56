#include "apps/rock_case.h"

#include "apps/progress.h"
#include "dem/io/history.h"

#include <cmath>
#include <sstream>

namespace mergel::apps {

namespace {

void declare_specimen(CaseFile& file, RockCase& c)
{
  const auto section = file.section("Specimen");
  dem::SpecimenSpec& s = c.specimen;
  s.d_min = s.d_max = s.rho = s.porosity = s.coordination = s.g_b = unset;
  s.scale = {unset, unset, unset, unset};
  file.quantity("diameter", c.diameter, "m", positive,
                "Diameter of the DEM region, a half cylinder cut at y = 0.", "mm");
  file.quantity("height", c.height, "m", positive, "Height of the DEM region.", "mm");
  file.quantity("smallest diameter", s.d_min, "m", positive,
                "Smallest grain at S = 1, d00; diameters are uniform in number.", "mm");
  file.quantity("largest diameter", s.d_max, "m", positive, "Largest grain at S = 1.",
                "mm");
  file.quantity("grain density", s.rho, "kg/m3", positive,
                "Density of the grains, not of the rock.");
  file.number("porosity", s.porosity, inside(0.0, 1.0),
              "Target porosity of the core, by true sphere volumes.");
  file.number("coordination", s.coordination, positive,
              "Target Z = 2 N_bonds/N; the bond gap may end it earlier.");
  file.quantity("bond gap", s.g_b, "m", non_negative,
                "Largest gap that is bonded, g_b at S = 1; scales with S, Eq. 8.", "mm");
  file.number("inner upscaling", s.scale.S_inner, positive,
              "Upscaling ratio S up to the inner radius.");
  file.number("outer upscaling", s.scale.S_outer, positive,
              "Upscaling ratio S from the outer radius on; linear between.");
  file.quantity("inner radius", s.scale.r_inner, "m", non_negative,
                "Distance from the axis up to which S is the inner upscaling.", "mm");
  file.quantity("outer radius", s.scale.r_outer, "m", positive,
                "Distance from the axis from which S is the outer upscaling.", "mm");
  file.choice("symmetry", c.symmetry,
              std::vector<std::pair<std::string, dem::Symmetry>>{
                  {"mirror", dem::Symmetry::mirror}, {"wall", dem::Symmetry::wall}},
              "Cut plane: grains bonded to their mirror image, or images in contact only.");
  file.integer("seed", s.seed, non_negative, "Of the random cloud of grains.");
  file.path("file", c.sample,
            "A specimen made before by mergel sample; empty: make it for this run.");
}

void declare_far_field(CaseFile& file, RockCase& c)
{
  const auto section = file.section("Far field");
  fem::FarFieldSpec& f = c.far_field;
  file.choice("model", c.model,
              std::vector<std::pair<std::string, FarFieldModel>>{
                  {"elastic", FarFieldModel::elastic}, {"rigid", FarFieldModel::rigid}},
              "Elastic solid, or the same walls held fixed.");
  file.quantity("chamber diameter", f.chamber_diameter, "m", positive,
                "Outer diameter of the far field.", "mm");
  file.quantity("chamber height", f.chamber_height, "m", positive,
                "From the surface to the fixed base.", "mm");
  file.quantity("cell size", f.cell_size, "m", positive,
                "Edge of the cells, and of the wall faces, at the DEM region.", "mm");
  file.number("growth", f.growth, between(1.0, 3.0),
              "Ratio of neighbouring cell sizes away from the DEM region.");
  file.quantity("Young's modulus", f.E, "Pa", positive, "E of the intact rock.", "GPa");
  file.number("Poisson ratio", f.nu, from_to(0.0, 0.5).named("nu"),
              "nu of the intact rock.");
  f.K0 = 0.163;
  file.number("K0", f.K0, non_negative, "Initial horizontal over vertical stress.");
  file.choice("outer boundary", f.outer,
              std::vector<std::pair<std::string, fem::FarFieldSpec::Outer>>{
                  {"roller", fem::FarFieldSpec::Outer::roller},
                  {"fixed", fem::FarFieldSpec::Outer::fixed}},
              "Chamber wall: no radial displacement, or none at all.");
  file.choice("interface", c.interface_bond,
              std::vector<std::pair<std::string, dem::InterfaceBond>>{
                  {"bonded", dem::InterfaceBond::bonded},
                  {"breakable", dem::InterfaceBond::breakable},
                  {"frictional", dem::InterfaceBond::frictional}},
              "How grains hold to the far field: elastic bonds, bonds that may break, "
              "contact only.");
  c.interface = {0.63e9, 2.4, 0.3, 0.0};
  file.quantity("interface modulus", c.interface.E, "Pa", positive,
                "Effective modulus of the contact of grains with the far field.", "GPa");
  file.number("interface friction", c.interface.mu, non_negative,
              "Friction coefficient of that contact.");
  file.quantity("lip", c.lip, "m", non_negative,
                "Height of the rim above the surface that keeps debris inside.", "mm");
}

void declare_motion(CaseFile& file, RockCase& c)
{
  const auto section = file.section("Motion");
  file.quantity("gravity", c.gravity, "m/s2", non_negative,
                "Downwards, on grains and far field.");
  file.number("damping", c.damping, from_to(0.0, 1.0).named("alpha"),
              "Local non-viscous damping of grains and far field.");
  file.number("time step safety", c.safety, above_to(0.0, 1.0),
              "Share of the critical time step that is used.");
  file.flag("free rotation", c.free_rotation,
            "Let grains without a living bond spin; the paper holds them.");
  file.number("balance", c.balance, inside(0.0, 1.0),
              "Unbalanced-force ratio at which a state counts as equilibrium.");
}

} // namespace

void declare(CaseFile& file, RockCase& c)
{
  declare_specimen(file, c);
  declare(file, c.bond);
  declare(file, c.material.contact);
  declare_far_field(file, c);
  declare_motion(file, c);
}

void complete(const CaseFile& file, RockCase& c)
{
  dem::SpecimenSpec& s = c.specimen;
  fem::FarFieldSpec& f = c.far_field;
  c.material.bond = c.bond.chosen();
  if (s.d_max < s.d_min)
    file.refuse("Specimen", "largest diameter", "must not be below `smallest diameter`");
  if (s.scale.r_outer <= s.scale.r_inner)
    file.refuse("Specimen", "outer radius", "must be beyond `inner radius`");
  const auto mm = [](double x) { return dem::shortest(1e3 * x) + " mm"; };
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

  f.region_diameter = c.diameter;
  f.region_height = c.height;
  f.rho = s.rho * (1.0 - s.porosity);
  f.gravity = c.gravity;
  f.damping = c.damping;
  c.interface.kappa = c.material.contact.kappa;
  s.g_a = c.material.contact.g_a;
  s.region.radius = 0.5 * c.diameter;
  s.region.height = c.height;
  s.region.segments =
      2; // refined below, once the far field has its mesh; enough for the checks

  try {
    f.check();
  } catch (const std::invalid_argument& e) {
    throw InputError(file.where("Far field", "chamber diameter") + ": " + e.what());
  }
  const double largest = s.d_max * std::max(s.scale.S_inner, s.scale.S_outer);
  if (largest >= 0.5 * std::min(0.5 * c.diameter, c.height))
    file.refuse("Specimen",
                s.scale.S_inner > s.scale.S_outer ? "inner upscaling" : "outer upscaling",
                "the largest grain, " + mm(largest) +
                    ", does not fit the region: lower the ratio or enlarge the region");
  if (dem::most_grains(s) > dem::grains_limit)
    file.refuse(
        "Specimen", "smallest diameter",
        "the region may hold more than 2e7 grains: raise the diameters or the upscaling "
        "ratio");
  // Shells ten times the volume of their spheres: a slip of units, no rock.
  if (dem::effective_solid_fraction(s) > 10.0 * (1.0 - s.porosity))
    file.refuse("Contact", "activation gap",
                "with it the grains reach ten times their volume: lower it, or raise "
                "`Specimen/smallest "
                "diameter`, " +
                    mm(s.d_min));
  try {
    s.check();
  } catch (const InputError& e) {
    file.refuse("Specimen", "porosity", e.what());
  }
}

std::vector<std::pair<std::string, std::string>> recipe(const RockCase& c)
{
  const dem::SpecimenSpec& s = c.specimen;
  const auto text = [](double x) { return dem::shortest(x); };
  return {{"diameter", text(c.diameter) + " m"},
          {"height", text(c.height) + " m"},
          {"faces around the side", std::to_string(s.region.segments)},
          {"smallest diameter", text(s.d_min) + " m"},
          {"largest diameter", text(s.d_max) + " m"},
          {"grain density", text(s.rho) + " kg/m3"},
          {"porosity", text(s.porosity)},
          {"coordination", text(s.coordination)},
          {"bond gap", text(s.g_b) + " m"},
          {"activation gap", text(s.g_a) + " m"},
          {"inner upscaling", text(s.scale.S_inner)},
          {"outer upscaling", text(s.scale.S_outer)},
          {"inner radius", text(s.scale.r_inner) + " m"},
          {"outer radius", text(s.scale.r_outer) + " m"},
          {"seed", std::to_string(s.seed)}};
}

dem::Sample obtain_sample(const CaseFile& file, const RockCase& c)
{
  if (!c.sample.empty()) {
    dem::Sample sample;
    try {
      sample = dem::read_sample(c.sample);
    } catch (const InputError& e) {
      file.refuse("Specimen", "file", e.what());
    }
    const std::string differs = dem::difference(sample, recipe(c));
    if (!differs.empty())
      file.refuse("Specimen", "file",
                  differs +
                      "; make a new sample, or clear the key to make it for this run");
    return sample;
  }

  Progress progress("specimen");
  dem::Sample sample;
  try {
    sample.packing =
        dem::pack(c.specimen, [&](double fraction) { progress.update(fraction); });
  } catch (const InputError& e) {
    file.refuse("Specimen", "porosity", e.what());
  }
  sample.bonding = dem::choose_bonds(c.specimen, sample.packing.particles, {});
  sample.recipe = recipe(c);
  progress.done(std::to_string(sample.packing.particles.size()) + " grains");
  return sample;
}

std::string report(const RockCase& c, const dem::Sample& sample)
{
  const dem::SpecimenReport r =
      dem::describe(c.specimen, sample.packing.particles, sample.bonding);
  std::ostringstream out;
  out.precision(4);
  out << "specimen: " << r.n_particles << " grains of " << 1e3 * r.d_min << " to "
      << 1e3 * r.d_max << " mm, S " << r.S_min << " to " << r.S_max << "; porosity "
      << sample.packing.porosity << " in the core (wanted " << c.specimen.porosity << "), "
      << sample.packing.whole_porosity << " in all; " << r.n_bonds
      << " bonds, Z = 2 N_bonds/N = " << r.coordination << " (wanted "
      << c.specimen.coordination << "), N_bonds/N = " << 0.5 * r.coordination
      << ", bonded up to " << r.largest_gap / c.specimen.d_min << " d00 S; largest overlap "
      << sample.packing.overlap;
  return out.str();
}

} // namespace mergel::apps
