#include "apps/brazilian/brazilian_case.h"

#include "apps/case/motion_keys.h"
#include "apps/case/unusual.h"

namespace mergel::apps {

BrazilianCase::BrazilianCase()
{
  strain_limit = 0.03;
  final_load = 0.5;
  record_every = 1e-4;
}

namespace {

void declare_plates(CaseFile& file, PlateKeys& p)
{
  const auto section = file.section("Plates");
  file.derived("contact modulus", p.contact_modulus, "Pa", positive, "that of rigid walls",
               "Modulus of the contact of particles with a plate, in the sense of the "
               "contact law. Only the particle yields: by default 2 `Contact/effective "
               "modulus` (linear), or `Contact/Young's modulus` (hertz).",
               "GPa");
  file.number("friction", p.friction, non_negative, "Between plates and particles.");
}

void declare_loading(CaseFile& file, BrazilianCase& c)
{
  const auto section = file.section("Loading");
  file.quantity("velocity", c.velocity, "m/s", positive,
                "At which the plates approach each other; each does half of it.", "mm/s");
  file.number("strain limit", c.strain_limit, inside(0.0, 0.5),
              "Diametral strain, approach of the plates over the diameter, at which the "
              "test ends at the latest.");
  file.number("final load", c.final_load, from_to(0.0, 1.0),
              "Share of the largest load; the test ends where the load stays below it. 0: "
              "it goes on to the strain limit.");
}

} // namespace

void declare(CaseFile& file, BrazilianCase& c)
{
  c.specimen.shape = SpecimenKeys::Shape::cylinder;
  c.specimen.upscaling = SpecimenKeys::Upscaling::uniform;
  declare(file, c.specimen);
  declare(file, c.bond);
  declare(file, c.contact);
  declare_plates(file, c.plates);
  declare_loading(file, c);
  {
    const auto section = file.section("Motion");
    file.number("damping", c.damping, from_to(0.0, 1.0).named("alpha"),
                "Local non-viscous damping of the particles.");
    declare(file, motion_keys(c));
  }
  const auto section = file.section("Output");
  file.number("record every", c.record_every, inside(0.0, 0.1),
              "Diametral strain between two lines of history.csv.");
  declare(file, c.checkpoints);
  using Pictures = BrazilianCase::Pictures;
  file.choice(
      "pictures", c.pictures,
      std::vector<std::pair<std::string, Pictures>>{
          {"none", Pictures::none}, {"ends", Pictures::ends}, {"strain", Pictures::strain}},
      "Of particles, bonds, breaks and plates, for ParaView: none; at the start and "
      "at the end; or also at intervals of diametral strain.");
  const auto only = file.only_if("pictures", {"strain"});
  file.number("picture every", c.picture_every, inside(0.0, 1.0),
              "Diametral strain between two pictures.");
}

void complete(CaseFile& file, BrazilianCase& c)
{
  if (c.specimen.shape != SpecimenKeys::Shape::cylinder)
    file.refuse("Specimen", "shape", "a Brazilian test needs a `cylinder`");
  c.specimen.specimen.free_rotation = c.free_rotation;
  complete(file, motion_keys(c));
  c.material = {c.bond.chosen(), c.contact.chosen()};
  complete(file, c.specimen, c.material.contact);
  if (c.specimen.upscaling != SpecimenKeys::Upscaling::uniform)
    file.refuse("Specimen", "upscaling", "a Brazilian test takes `uniform`");
  if (c.specimen.is_granular())
    file.refuse(
        "Specimen", "coordination",
        "a disc without bonds falls apart between its plates. Particles without bonds "
        "are for element and triaxial tests");
  refuse_impossible(file, c.bond, c.contact);
  refuse_kept_pressure(file, c.specimen, c.bond);
  complete(file, c.checkpoints);
  if (!(c.record_every < c.strain_limit))
    file.refuse("Output", "record every", "must be below `Loading/strain limit`");
  file.derive("Plates", "contact modulus", dem::modulus_at_rigid_wall(c.material.contact));
  c.plate_contact =
      wall_contact(c.material.contact, c.plates.contact_modulus, c.plates.friction);
}

coupling::CoupledSpec coupled_spec(const BrazilianCase& c)
{
  coupling::CoupledSpec spec;
  spec.material = c.material;
  spec.motion = {dem::Vec3::Zero(), c.damping, c.free_rotation, c.inertia_factor,
                 c.largest_overlap};
  spec.skin = dem::default_skin * c.specimen.specimen.sizes.smallest();
  spec.step = c.step;
  spec.mass_scaling = c.mass_scaling;
  spec.strengths = c.specimen.strengths;
  return spec;
}

} // namespace mergel::apps
