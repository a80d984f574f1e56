#include "apps/pile/pile_case.h"

#include "dem/text.h"

#include <cmath>

namespace mergel::apps {

double PileCase::tip_height() const
{
  return tip == Tip::flat ? 0.0 : 0.5 * diameter / std::tan(0.5 * cone_angle);
}

void declare(CaseFile& file, PileCase& c)
{
  declare(file, c.assembly);
  {
    const auto section = file.section("Pile");
    file.quantity("diameter", c.diameter, "m", positive, "Diameter of the shaft.", "mm");
    file.choice("tip", c.tip,
                std::vector<std::pair<std::string, PileCase::Tip>>{
                    {"cone", PileCase::Tip::cone}, {"flat", PileCase::Tip::flat}},
                "Shape of the lower end.");
    {
      const auto only = file.only_if("tip", {"cone"});
      file.quantity("cone angle", c.cone_angle, "rad", inside(0.0, dem::pi),
                    "Full angle at the tip.", "degree");
    }
    file.former_name("velocity", "penetration rate");
    file.quantity("penetration rate", c.velocity, "m/s", positive,
                  "Downwards, after a ramp of 0.05 diameters.");
    file.quantity("final depth", c.final_depth, "m", positive,
                  "Of the shoulder below the surface.", "mm");
    file.number("friction", c.friction, non_negative, "Between pile and particles.");
    file.derived(
        "contact modulus", c.contact_modulus, "Pa", positive, "that of rigid walls",
        "Modulus of the contact between pile and particles, in the sense of the contact "
        "law. Only the particle yields: by default 2 `Contact/effective modulus` (linear), "
        "or `Contact/Young's modulus` (hertz).",
        "GPa");
  }
  const auto section = file.section("Output");
  file.derived("record every", c.record_every, "m", positive, "Pile/diameter/100",
               "Travel of the pile between two lines of history.csv.", "mm");
  file.integer("frames", c.frames, at_least(1.0),
               "Frames of all fields during the penetration, after the first.");
  declare(file, c.checkpoints);
}

void complete(CaseFile& file, PileCase& c)
{
  complete(file, c.assembly);
  const auto mm = [](double x) { return dem::shortest(1e3 * x) + " mm"; };
  if (c.diameter >= c.assembly.diameter)
    file.refuse(
        "Pile", "diameter",
        "the pile is wider than the DEM region: must be below `Specimen/diameter`, " +
            mm(c.assembly.diameter) +
            "; bonds break up to some two diameters from the axis");
  const double tip = c.travel();
  if (tip + c.diameter > c.assembly.height)
    file.refuse("Pile", "final depth",
                "the tip would reach " + mm(tip) +
                    ", less than a diameter above the floor of the DEM region at " +
                    mm(c.assembly.height) + "; lower it or raise `Specimen/height`");
  complete(file, c.checkpoints);
  file.derive("Pile", "contact modulus",
              dem::modulus_at_rigid_wall(c.assembly.material.contact));
  file.derive("Output", "record every", 0.01 * c.diameter);
  c.contact = wall_contact(c.assembly.material.contact, c.contact_modulus, c.friction);
}

} // namespace mergel::apps
