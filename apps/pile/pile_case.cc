#include "apps/pile/pile_case.h"

#include "dem/text.h"

#include <algorithm>
#include <cmath>

namespace mergel::apps {

double PileCase::tip_height() const
{
  if (surface.polyhedron) return surface.polyhedron->tip_height;
  return tip == Tip::flat ? 0.0 : 0.5 * diameter / std::tan(0.5 * cone_angle);
}

std::string key_of_pile_stage(std::size_t k)
{
  return "stage " + std::to_string(k + 1);
}

double PileCase::deepest() const
{
  double depth = 0.0;
  for (const PileStage& s : stages)
    if (s.kind == PileStage::Kind::penetrate) depth = std::max(depth, s.target);
  return depth;
}

coupling::PileInertia PileCase::inertia() const
{
  return {has_stages() ? modelled_share() * mass : 1.0, assembly.height, assembly.damping};
}

namespace {

void declare_loading(CaseFile& file, PileCase& c)
{
  const auto section = file.section("Loading");
  file.numbered(
      "stage", c.stage_texts,
      std::string("A loading stage: ") + forms_of_pile_stage +
          ". Depths are those of the shoulder; a head force is that of the full pile, "
          "positive downwards. As many stages as needed; the first one penetrates.",
      "The next loading stage.");
  file.derived("displacement rate", c.displacement_rate, "m/s", positive,
               "Pile/penetration rate/10", "Of pull and push, after a ramp.");
  file.derived("force ramp", c.force_ramp, "s", positive,
               "Pile/diameter/4 over the penetration rate",
               "Time in which load and unload change the head force.", "ms");
  file.derived("unbalanced-force tolerance", c.balance_tolerance, "1", inside(0.0, 1.0),
               "1e-3",
               "Unbalanced-force ratio at which hold, load and unload end; looked at every "
               "100 steps.");
  file.derived("largest settlement", c.largest_settlement, "m", positive,
               "Pile/diameter/10",
               "Settlement at which a stage with a prescribed head force ends: the "
               "bearing capacity. The head then holds the pile.",
               "mm");
}

/// Read the stages, or the final depth, which stands for one.
void complete_stages(CaseFile& file, PileCase& c)
{
  c.stages.clear();
  if (std::isfinite(c.final_depth)) {
    if (c.has_stages())
      file.refuse("Pile", "final depth",
                  "is the short form of one stage, and the case gives `Loading/stage " +
                      std::to_string(c.stage_texts.begin()->first) +
                      "` too: keep one of the two");
    c.stages.push_back({PileStage::Kind::penetrate, c.final_depth});
  } else if (!c.has_stages())
    file.refuse(
        "Pile", "final depth",
        "must be given, or loading stages: write \"set final depth = ...\", for "
        "example 8.4 mm, or in section Loading \"set stage 1 = penetrate to depth = "
        "8.4 mm\"");
  for (const auto& [number, text] : c.stage_texts) {
    const std::string key = key_of_pile_stage(number - 1);
    if (number != c.stages.size() + 1)
      file.refuse("Loading", key,
                  "there is no `" + key_of_pile_stage(c.stages.size()) +
                      "`: number the stages from 1 without a gap");
    try {
      c.stages.push_back(read_pile_stage(text));
    } catch (const InputError& e) {
      file.refuse("Loading", key, e.what());
    }
  }
  const auto fault = find_fault(c.stages, {c.tip_height(), c.diameter, c.assembly.height});
  if (!fault) return;
  if (c.has_stages())
    file.refuse("Loading", key_of_pile_stage(fault->stage), fault->message);
  file.refuse("Pile", "final depth", fault->message);
}

/// What the head of the pile needs besides its stages.
void complete_head(CaseFile& file, PileCase& c)
{
  struct Key {
    const char *section, *name;
    double value, standard;
  };
  constexpr double steel = 7850.0; // [kg/m^3]
  const double bar = 0.25 * dem::pi * c.diameter * c.diameter * c.assembly.height;
  for (const Key& key :
       {Key{"Pile", "mass", c.mass, steel * bar},
        Key{"Loading", "displacement rate", c.displacement_rate, 0.1 * c.velocity},
        Key{"Loading", "force ramp", c.force_ramp, 0.25 * c.diameter / c.velocity},
        Key{"Loading", "unbalanced-force tolerance", c.balance_tolerance, 1e-3},
        Key{"Loading", "largest settlement", c.largest_settlement, 0.1 * c.diameter}}) {
    if (c.has_stages())
      file.derive(key.section, key.name, key.standard);
    else if (std::isfinite(key.value))
      file.refuse(key.section, key.name,
                  "has no effect with `Pile/final depth`: leave it out, or write loading "
                  "stages");
  }
}

/// Share of the diameter by which a polyhedron may differ from its mirror image: the sagitta of a
/// circle of 32 facets.
constexpr double symmetry_tolerance = 2.5e-3;

std::string mm(double x)
{
  return dem::rounded(1e3 * x) + " mm";
}

/// Whether the polyhedron fits the model.
void check_surface(const CaseFile& file, const PileCase& c)
{
  const dem::Polyhedron& polyhedron = *c.surface.polyhedron;
  if (2.0 * polyhedron.R_outside >= c.assembly.diameter)
    file.refuse("Pile", "surface",
                "the pile is wider than the DEM region: it reaches " +
                    mm(polyhedron.R_outside) +
                    " from its axis, must be below half of `Specimen/diameter`, " +
                    mm(0.5 * c.assembly.diameter) + "; is `surface unit` right?");
  if (!c.assembly.is_half()) return;
  try {
    dem::require_symmetric(polyhedron, symmetry_tolerance * c.diameter);
  } catch (const InputError& e) {
    file.refuse("Pile", "surface", std::string(e.what()) + ", `Specimen/shape = cylinder`");
  }
}

/// The surface of the rock must not close above the pile.
void check_length(const CaseFile& file, const PileCase& c)
{
  const double deepest = c.deepest() + c.tip_height();
  if (c.surface.polyhedron->length >= deepest) return;
  file.refuse("Pile", "surface",
              "the pile is " + mm(c.surface.polyhedron->length) +
                  " long, and its tip goes down to " + mm(deepest) +
                  ": it would be covered. Make it longer, or the stages shallower");
}

} // namespace

void declare(CaseFile& file, PileCase& c)
{
  declare(file, c.assembly);
  {
    const auto section = file.section("Pile");
    file.choice(
        "tip", c.tip,
        std::vector<std::pair<std::string, PileCase::Tip>>{
            {"cone", PileCase::Tip::cone},
            {"flat", PileCase::Tip::flat},
            {"surface", PileCase::Tip::surface}},
        "Lower end of a round pile; or surface: a pile of any shape, read from a file.");
    {
      const auto only = file.only_if("tip", {"cone", "flat"});
      file.quantity("diameter", c.diameter, "m", positive, "Diameter of the shaft.", "mm");
    }
    {
      const auto only = file.only_if("tip", {"cone"});
      file.quantity("cone angle", c.cone_angle, "rad", inside(0.0, dem::pi),
                    "Full angle at the tip.", "degree");
    }
    declare(file, c.surface);
    file.former_name("velocity", "penetration rate");
    file.quantity("penetration rate", c.velocity, "m/s", positive,
                  "Downwards, after a ramp of 0.05 diameters.");
    file.derived(
        "final depth", c.final_depth, "m", positive, "required without stages",
        "Of the shoulder below the surface. Short form of `Loading/stage 1 = penetrate "
        "to depth`; with stages it is left out.",
        "mm");
    file.derived(
        "mass", c.mass, "kg", positive, "that of a steel bar as long as the specimen",
        "Of the full pile, which moves under a prescribed head force; 7850 kg/m3 over "
        "`Specimen/height` by default. Its weight is part of the head force.",
        "g");
    file.number("friction", c.friction, non_negative, "Between pile and particles.");
    file.derived(
        "contact modulus", c.contact_modulus, "Pa", positive, "that of rigid walls",
        "Modulus of the contact between pile and particles, in the sense of the contact "
        "law. Only the particle yields: by default 2 `Contact/effective modulus` (linear), "
        "or `Contact/Young's modulus` (hertz).",
        "GPa");
  }
  declare_loading(file, c);
  const auto section = file.section("Output");
  file.derived("record every", c.record_every, "m", positive, "Pile/diameter/100",
               "Travel of the pile between two lines of history.csv.", "mm");
  file.integer(
      "frames", c.frames, at_least(1.0),
      "Frames of all fields during the first penetration, after the first, and with the "
      "same spacing in later ones; one more at the end of each stage.");
  file.number("averaging length", c.averaging_length, from_to(1.0, 100.0),
              "Height and width of the rings over which the continuum fields are averaged, "
              "over d50 of the particles beside the pile.");
  declare(file, c.checkpoints);
}

void complete(CaseFile& file, PileCase& c)
{
  complete(file, c.assembly);
  if (c.tip == PileCase::Tip::surface) {
    complete_surface(file, c.surface);
    c.diameter = 2.0 * c.surface.polyhedron->R();
    check_surface(file, c);
  } else if (c.diameter >= c.assembly.diameter)
    file.refuse(
        "Pile", "diameter",
        "the pile is wider than the DEM region: must be below `Specimen/diameter`, " +
            mm(c.assembly.diameter) +
            "; bonds break up to some two diameters from the axis");
  complete_stages(file, c);
  if (c.surface.polyhedron) check_length(file, c);
  complete_head(file, c);
  complete(file, c.checkpoints);
  file.derive("Pile", "contact modulus",
              dem::modulus_at_rigid_wall(c.assembly.material.contact));
  file.derive("Output", "record every", 0.01 * c.diameter);
  c.contact = wall_contact(c.assembly.material.contact, c.contact_modulus, c.friction);
}

} // namespace mergel::apps
