#include "apps/triaxial/triaxial_case.h"

#include "apps/case/motion_keys.h"
#include "apps/case/unusual.h"
#include "apps/coupled/system_of_case.h"
#include "dem/text.h"

#include <algorithm>
#include <cmath>

namespace mergel::apps {

namespace {

/// Latex [Pa]: for a membrane that bears no pressure.
constexpr double latex_modulus = 1.4e6;
/// E t over sigma_3 d50 below which the pores of the surface burst a membrane [-]: a flat disc
/// over a pore of radius a has its limit at p = 0.58 E t/a, and a is some 0.4 d50.
constexpr double smallest_stiffness = 0.7;
/// Radius of the platens over that of the specimen, which may bulge [-].
constexpr double platen_radius = 1.8;
constexpr int platen_sides = 24;
constexpr double most_nodes = 1e6; ///< of a membrane

void declare_membrane(CaseFile& file, MembraneKeys& m)
{
  const auto section = file.section("Membrane");
  file.flag("membrane", m.is_there,
            "A flexible membrane around the specimen, under the cell pressure. Without it "
            "the test is unconfined.");
  const auto only = file.only_if("membrane", {"true"});
  file.quantity("thickness", m.material.thickness, "m", positive, "At rest.", "mm");
  file.derived("Young's modulus", m.material.E, "Pa", positive,
               "largest cell pressure times d50 over the thickness",
               "At small strain; incompressible neo-Hookean. The default holds over the "
               "pores of the specimen's surface, which grow with the upscaling; with less "
               "than 0.7 of it they would burst the membrane.",
               "MPa");
  file.quantity("density", m.material.rho, "kg/m3", positive, "Of the membrane.");
  file.derived("node distance", m.node_distance, "m", positive, "half of d50",
               "Of the mesh; at most the diameter of the smallest particle.", "mm");
  file.choice(
      "compression", m.material.compression,
      std::vector<std::pair<std::string, fem::Compression>>{
          {"wrinkles", fem::Compression::wrinkles}, {"carried", fem::Compression::carried}},
      "Under compression the membrane wrinkles and carries nothing (tension field), "
      "or it carries compression as a solid does.");
  using Ends = coupling::MembraneEnds;
  file.choice(
      "ends", m.ends,
      std::vector<std::pair<std::string, Ends>>{{"free", Ends::free},
                                                {"fixed", Ends::fixed}},
      "Ends of the membrane in the plane of the platens; along the axis they are tied to "
      "them.");
  file.derived("contact modulus", m.contact_modulus, "Pa", positive,
               "that between particles",
               "Modulus of the contact of particles with the membrane, in the sense of the "
               "contact law.",
               "GPa");
  file.number("friction", m.friction, non_negative, "Between membrane and particles.");
  file.integer("largest subcycle", m.largest_subcycle, between(1.0, 10.0),
               "Largest number of steps after which stretch and pressure act, by impulse; "
               "fewer where the frequencies ask for it. 1: at every step.");
}

void declare_platens(CaseFile& file, PlatenKeys& p)
{
  const auto section = file.section("Platens");
  using Seat = PlatenKeys::Seat;
  file.choice("top", p.seat,
              std::vector<std::pair<std::string, Seat>>{
                  {"fixed", Seat::fixed}, {"spherical seat", Seat::spherical}},
              "Upper platen: always level, or free to tilt about its centre.");
  {
    const auto only = file.only_if("top", {"spherical seat"});
    file.derived("mass", p.mass, "kg", positive, "that of the specimen",
                 "Of the platen, for its tilting.", "g");
  }
  file.derived("contact modulus", p.contact_modulus, "Pa", positive, "that of rigid walls",
               "Modulus of the contact of particles with a platen, in the sense of the "
               "contact law. Only the particle yields: by default 2 `Contact/effective "
               "modulus` (linear), or `Contact/Young's modulus` (hertz).",
               "GPa");
  file.derived("friction", p.friction, "1", non_negative, "Contact/friction",
               "Between platens and particles.");
}

void declare_loading(CaseFile& file, TriaxialCase& c)
{
  const auto section = file.section("Loading");
  declare_stages(file, c.stage_texts);
  file.derived(
      "wave stress", c.wave_stress, "Pa", positive, "40 kPa",
      "Largest stress rho c v of the wave that a platen of the velocity v sends into the "
      "specimen; it limits v. A hundredth of the unconfined strength keeps the platen "
      "forces at both ends within 2 %; by default, without bonds, a tenth of the largest "
      "cell pressure, at most 20 kPa.",
      "kPa");
  file.number(
      "inertial number", c.inertial_number, inside(0.0, 0.1),
      "I = rate d sqrt(rho/p) of the controlled strain, a second limit of the rate; "
      "quasi-static below 1e-3.");
  file.derived(
      "reference pressure", c.reference_pressure, "Pa", positive, "1 MPa",
      "Used in I in place of p where |p| is smaller; a stress off what a stage holds "
      "by more than a hundredth of it starts an approach. By default, without bonds, the "
      "target pressure of the packing.",
      "MPa");
  file.number("strain limit", c.strain_limit, inside(0.0, 0.9),
              "The test ends where a strain since its start exceeds this limit.");
  file.number("reversal", c.reversal, inside(0.0, 1.0),
              "The test ends at an unstable point: a stress on its way to the target falls "
              "back by this fraction of the way made.");
}

void declare_motion(CaseFile& file, TriaxialCase& c)
{
  const auto section = file.section("Motion");
  file.number("damping", c.damping, from_to(0.0, 1.0).named("alpha"),
              "Local non-viscous damping of particles, membrane and tilting platen.");
  declare(file, motion_keys(c));
}

/// Refuse a stage that the cell cannot do.
void check_stages(const CaseFile& file, const TriaxialCase& c)
{
  using dem::PathKind;
  bool is_confined = c.specimen.is_granular(); // under its target pressure
  for (const auto& [number, text] : c.stage_texts) {
    for (const dem::LoadingStage& stage : read_stages(text)) {
      const bool fits =
          stage.kind == PathKind::isotropic || stage.kind == PathKind::triaxial ||
          stage.kind == PathKind::compression || stage.kind == PathKind::resume;
      if (!fits)
        file.refuse(
            "Loading", key_of_stage(number),
            "a triaxial cell does `isotropic`, `triaxial [at STRESS]`, "
            "`compression`, `resume`, `unload`, `reload` and `unload-reload`; other "
            "paths are those of `mergel element`. Extension is `triaxial to axial "
            "strain = -1 %`");
      if (stage.has_lateral && stage.lateral < 0.0)
        file.refuse("Loading", key_of_stage(number),
                    "the cell pressure must not be negative");
      const bool confines =
          stage.kind == PathKind::isotropic || (stage.has_lateral && stage.lateral > 0.0);
      if (confines && !c.membrane.is_there)
        file.refuse("Loading", key_of_stage(number),
                    "a cell pressure needs a membrane: set `Membrane/membrane = true`, or "
                    "load by `compression` for the unconfined test");
      if (stage.kind == PathKind::isotropic && !(stage.target > 0.0))
        file.refuse("Loading", key_of_stage(number),
                    "the target must be positive: a membrane cannot pull");
      if (confines || stage.has_lateral || stage.kind == PathKind::compression)
        is_confined = confines;
      if (stage.kind == PathKind::triaxial && stage.target < 0.0 && !is_confined)
        file.refuse("Loading", key_of_stage(number),
                    "the platens do not pull: extension needs a cell pressure, by "
                    "`isotropic` or `triaxial at STRESS`");
    }
  }
}

} // namespace

void declare(CaseFile& file, TriaxialCase& c)
{
  c.specimen.shape = SpecimenKeys::Shape::cylinder;
  c.specimen.upscaling = SpecimenKeys::Upscaling::uniform;
  declare(file, c.specimen);
  declare(file, c.bond);
  declare(file, c.contact);
  declare_membrane(file, c.membrane);
  declare_platens(file, c.platens);
  declare_loading(file, c);
  declare_motion(file, c);
  {
    const auto section = file.section("Analysis");
    declare(file, c.analysis);
  }
  const auto section = file.section("Output");
  file.number("record every", c.record_every, inside(0.0, 0.1),
              "Controlled strain between two lines of history.csv.");
  file.number(
      "localisation every", c.localisation_every, inside(0.0, 1.0),
      "Axial strain between two lines of localisation.csv, over which its increments "
      "are taken.");
  declare(file, c.checkpoints);
  using Pictures = TriaxialCase::Pictures;
  file.choice("pictures", c.pictures,
              std::vector<std::pair<std::string, Pictures>>{{"none", Pictures::none},
                                                            {"stages", Pictures::stages},
                                                            {"strain", Pictures::strain}},
              "Of particles, bonds, membrane and platens, for ParaView: none; at the start "
              "and at the end of each stage; or also at intervals of axial strain.");
  const auto only = file.only_if("pictures", {"strain"});
  file.number("picture every", c.picture_every, inside(0.0, 1.0),
              "Axial strain between two pictures.");
}

double TriaxialCase::largest_pressure() const
{
  double p = specimen.is_granular() ? specimen.specimen.pressure : 0.0;
  for (const dem::LoadingStage& stage : stages) {
    if (stage.has_lateral) p = std::max(p, stage.lateral);
    if (stage.kind == dem::PathKind::isotropic && stage.quantity == dem::Quantity::p)
      p = std::max(p, stage.target);
  }
  return p;
}

namespace {

void complete_membrane(CaseFile& file, TriaxialCase& c)
{
  MembraneKeys& m = c.membrane;
  const auto mm = [](double x) { return dem::rounded(1e3 * x) + " mm"; };
  const double d_50 = c.d_50(), p = c.largest_pressure();
  file.derive("Membrane", "Young's modulus",
              p > 0.0 ? p * d_50 / m.material.thickness : latex_modulus);
  file.derive("Membrane", "node distance", 0.5 * d_50);
  file.derive("Membrane", "contact modulus",
              0.5 * dem::modulus_at_rigid_wall(c.material.contact));
  c.membrane_contact = wall_contact(c.material.contact, m.contact_modulus, m.friction);
  if (!m.is_there) return;
  const double holds = p * d_50 / m.material.thickness;
  if (m.material.E < smallest_stiffness * holds)
    file.refuse("Membrane", "Young's modulus",
                "the pores of the surface, of particles of d50 = " + mm(d_50) +
                    ", would burst the membrane at " + dem::rounded(1e-6 * p) +
                    " MPa: E t must be " + dem::rounded(1e-3 * p * d_50) +
                    " kN/m, which is E = " + dem::rounded(1e-6 * holds) +
                    " MPa at this thickness");
  c.tube = fem::Tube::with_node_distance(0.5 * c.specimen.diameter, -c.specimen.height,
                                         c.specimen.height, m.node_distance);
  c.tube.radius /= std::cos(dem::pi / c.tube.n_around); // its faces enclose the specimen
  const double smallest = c.specimen.specimen.sizes.smallest() * c.specimen.S;
  if (c.tube.node_distance() > 1.02 * smallest) // whole numbers of triangles
    file.refuse("Membrane", "node distance",
                "particles would slip through the mesh, whose nodes are " +
                    mm(c.tube.node_distance()) +
                    " apart: at most the diameter of the smallest, " + mm(smallest));
  if (static_cast<double>(c.tube.n_around) * c.tube.n_high > most_nodes)
    file.refuse("Membrane", "node distance",
                "the mesh would have more than a million nodes: half of d50 is " +
                    mm(0.5 * d_50));
}

/// Particles without bonds stand in the membrane only, under a pressure that is known before
/// they are packed.
void check_granular(const CaseFile& file, const TriaxialCase& c)
{
  if (!c.membrane.is_there)
    file.refuse(
        "Membrane", "membrane",
        "particles without bonds, `Specimen/coordination` = 0, fall apart unconfined: "
        "they need the membrane and a cell pressure");
  if (c.specimen.specimen.compaction != dem::Compaction::confined)
    file.refuse(
        "Specimen", "packing",
        "particles without bonds, `Specimen/coordination` = 0, begin the test under "
        "the cell pressure that they are packed under: set `confined` and a `target "
        "pressure`");
  check_granular_stages(file, c.stage_texts);
}

} // namespace

void complete(CaseFile& file, TriaxialCase& c)
{
  if (c.specimen.shape != SpecimenKeys::Shape::cylinder)
    file.refuse("Specimen", "shape", "a triaxial test needs a `cylinder`");
  c.specimen.specimen.free_rotation = c.free_rotation;
  complete(file, motion_keys(c));
  c.material = {c.bond.chosen(), c.contact.chosen()};
  complete(file, c.specimen, c.material.contact);
  if (c.specimen.upscaling != SpecimenKeys::Upscaling::uniform)
    file.refuse("Specimen", "upscaling", "a triaxial test takes `uniform`");
  if (!c.specimen.is_granular()) refuse_impossible(file, c.bond, c.contact);
  check(file, c.analysis);
  complete(file, c.checkpoints);
  c.stages = stages_of(file, c.stage_texts);
  c.stage_labels = labels_of(c.stage_texts);
  if (c.specimen.is_granular())
    check_granular(file, c);
  else if (!c.membrane.is_there || c.stages.front().kind == dem::PathKind::compression)
    refuse_kept_pressure(file, c.specimen, c.bond);
  check_stages(file, c);
  const dem::SpecimenSpec& s = c.specimen.specimen;
  file.derive("Loading", "wave stress",
              c.specimen.is_granular() ? std::min(2e4, 0.1 * c.largest_pressure()) : 4e4);
  file.derive("Loading", "reference pressure", c.specimen.is_granular() ? s.pressure : 1e6);
  complete_membrane(file, c);
  PlatenKeys& p = c.platens;
  file.derive("Platens", "mass",
              c.specimen.specimen.rho * (1.0 - c.specimen.specimen.porosity) *
                  dem::volume(c.specimen.specimen.region));
  file.derive("Platens", "contact modulus", dem::modulus_at_rigid_wall(c.material.contact));
  file.derive("Platens", "friction", dem::friction(c.material.contact));
  c.platen_contact = wall_contact(c.material.contact, p.contact_modulus, p.friction);
}

coupling::SpecimenGeometry geometry_of(const TriaxialCase& c, double porosity)
{
  const double H = c.specimen.height;
  return {-H, H, dem::volume(c.specimen.specimen.region) / H, porosity / (1.0 - porosity)};
}

coupling::CoupledSpec coupled_spec(const TriaxialCase& c)
{
  coupling::CoupledSpec spec;
  spec.material = c.material;
  spec.motion = {dem::Vec3::Zero(), c.damping, c.free_rotation, c.inertia_factor,
                 c.largest_overlap};
  spec.skin = dem::default_skin * c.specimen.specimen.sizes.smallest();
  spec.step = c.step;
  spec.mass_scaling = c.mass_scaling;
  spec.strengths = c.specimen.strengths;
  spec.largest_subcycle = static_cast<std::size_t>(c.membrane.largest_subcycle);
  return spec;
}

std::vector<coupling::StructureSpec> structures(const TriaxialCase& c, MPI_Comm comm)
{
  const double R = 0.5 * c.specimen.diameter;
  std::vector<coupling::StructureSpec> specs;
  const auto add_platen = [&](const char* name, double z, double axis, bool tilts) {
    coupling::PlatenSpec platen;
    platen.mesh = coupling::make_disc({0.0, 0.0, z}, {0.0, 0.0, axis}, platen_radius * R,
                                      platen_sides);
    platen.drive = coupling::VelocityDrive{0.0};
    platen.is_free_to_tilt = tilts;
    platen.mass = tilts ? c.platens.mass : 0.0;
    platen.damping = c.damping;
    auto structure = std::make_unique<coupling::RigidPlaten>(std::move(platen));
    const coupling::RigidPlaten& added = *structure;
    specs.push_back({name, std::move(structure), c.platen_contact});
    return &added;
  };
  const auto* bottom = add_platen("bottom", -c.specimen.height, 1.0, false);
  const auto* top =
      add_platen("top", 0.0, -1.0, c.platens.seat == PlatenKeys::Seat::spherical);
  if (!c.membrane.is_there) return specs;
  load_mesh_library();
  specs.push_back({"membrane",
                   std::make_unique<coupling::MembraneStructure>(
                       fem::make_membrane(c.tube, c.membrane.material, comm), c.tube,
                       c.membrane.ends, c.damping, *bottom, *top),
                   c.membrane_contact});
  return specs;
}

} // namespace mergel::apps
