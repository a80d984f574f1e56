#include "apps/specimen/specimen.h"

#include "apps/case/unusual.h"
#include "apps/run/progress.h"
#include "apps/run/ranks.h"
#include "apps/run/same_input.h"
#include "dem/text.h"

#include <iostream>
#include <sstream>

namespace mergel::apps {

namespace {

dem::Sample read_or_make(const CaseFile& file, const SpecimenKeys& k)
{
  if (!k.sample.empty()) {
    dem::Sample sample;
    on_every_rank([&] {
      try {
        sample = dem::read_sample(k.sample);
      } catch (const InputError& e) {
        file.refuse("Specimen", "file", e.what());
      }
      const std::string differs = dem::difference(sample, recipe(k));
      if (!differs.empty())
        file.refuse(
            "Specimen", "file",
            differs + "; make a new sample, or clear the key to make the specimen in this "
                      "run");
      if (sample.packing.particles.size() < dem::fewest_particles)
        file.refuse("Specimen", "file",
                    "holds " + std::to_string(sample.packing.particles.size()) +
                        " particles, and a specimen needs two at least: make a new sample");
    });
    require_same_bytes(sample.sum, "Specimen/file = " + k.sample.string());
    return sample;
  }

  Progress progress("specimen");
  dem::Sample sample;
  try {
    sample.packing = dem::pack(
        k.specimen, [&](double fraction) { progress.update(fraction); }, MPI_COMM_WORLD);
  } catch (const InputError& e) {
    file.refuse("Specimen", "porosity", e.what());
  }
  sample.bonding =
      dem::choose_bonds(k.specimen, sample.packing.particles, sample.packing.cell);
  sample.recipe = recipe(k);
  progress.done(std::to_string(sample.packing.particles.size()) + " particles");
  return sample;
}

/// Of the coordination: a specimen of a thousand particles has it to a percent [-].
constexpr double coordination_tolerance = 0.05;

double coordination(const dem::Sample& sample)
{
  return 2.0 * static_cast<double>(sample.bonding.pairs.size()) /
         static_cast<double>(sample.packing.particles.size());
}

} // namespace

dem::Sample obtain_sample(const CaseFile& file, const SpecimenKeys& k)
{
  dem::Sample sample = read_or_make(file, k);
  dem::draw_strengths(k.strengths, sample.packing.particles);
  const double Z = coordination(sample), wanted = k.specimen.coordination;
  if (Z < (1.0 - coordination_tolerance) * wanted)
    std::cout << lines_of({"Specimen/coordination = " + three_digits(wanted) +
                           " is wanted, and pairs up to `bond gap` give " +
                           three_digits(Z) +
                           ": raise `Specimen/bond gap` or lower the coordination"});
  return sample;
}

std::string report(const SpecimenKeys& k, const dem::Sample& sample)
{
  const dem::SpecimenSpec& s = k.specimen;
  const dem::Packing& p = sample.packing;
  const dem::ParticleRange range = dem::describe_particles(p.particles);
  const dem::SizeReport sizes = dem::describe_sizes(s.sizes, p.particles);
  const double Z = coordination(sample);
  std::ostringstream out;
  out.precision(4);
  out << "specimen: " << p.particles.size() << " particles of " << 1e3 * range.d_min
      << " to " << 1e3 * range.d_max << " mm, S " << range.S_min << " to " << range.S_max
      << "; porosity " << p.porosity << " in the core (wanted " << s.porosity << "), "
      << p.whole_porosity << " in the whole region; pressure " << 1e-3 * p.pressure
      << " kPa";
  if (s.compaction == dem::Compaction::confined)
    out << " (wanted " << 1e-3 * s.pressure << ')';
  if (p.pressure > 0.0) out << ", which the contacts keep: a test begins under it";
  if (s.compaction == dem::Compaction::confined)
    out << "; friction while packed " << p.friction;
  if (k.is_granular())
    out << "; granular, without bonds";
  else
    out << "; " << sample.bonding.pairs.size() << " bonds, Z = 2 N_bonds/N = " << Z
        << " (wanted " << s.coordination << "), N_bonds/N = " << 0.5 * Z
        << ", bonded up to " << sample.bonding.limit / s.sizes.smallest() << " d00 S";
  out << "; largest overlap " << p.overlap
      << "\ngrain sizes at S = 1 by mass, made (wanted): d10 " << 1e3 * sizes.d_10 << " ("
      << 1e3 * s.sizes.sieve(0.1) << ") mm, d50 " << 1e3 * sizes.d_50 << " ("
      << 1e3 * s.sizes.sieve(0.5) << ") mm, d90 " << 1e3 * sizes.d_90 << " ("
      << 1e3 * s.sizes.sieve(0.9) << ") mm; the curves differ by " << sizes.distance_by_mass
      << " at most";
  if (p.cell.is_periodic())
    out << "\nperiodic box as made: " << 1e3 * p.cell.size.x() << " x "
        << 1e3 * p.cell.size.y() << " x " << 1e3 * p.cell.size.z() << " mm";
  return out.str() + report(k.strengths, p.particles);
}

Summary summary(const SpecimenKeys& k, const dem::Sample& sample)
{
  const dem::SpecimenSpec& s = k.specimen;
  const dem::Packing& p = sample.packing;
  const dem::ParticleRange range = dem::describe_particles(p.particles);
  const dem::SizeReport sizes = dem::describe_sizes(s.sizes, p.particles);
  std::vector<std::pair<const char*, double>> numbers{
      {"particles [-]", static_cast<double>(p.particles.size())},
      {"porosity [-]", p.porosity},
      {"porosity wanted [-]", s.porosity},
      {"porosity of the whole region [-]", p.whole_porosity},
      {"pressure [Pa]", p.pressure},
      {"friction while packed [-]", p.friction},
      {"bonds [-]", static_cast<double>(sample.bonding.pairs.size())},
      {"coordination Z = 2 N_bonds/N [-]", coordination(sample)},
      {"coordination wanted [-]", s.coordination},
      {"N_bonds/N [-]", 0.5 * coordination(sample)},
      {"largest bonded gap over S [m]", sample.bonding.limit},
      {"largest overlap over distance [-]", p.overlap},
      {"smallest S [-]", range.S_min},
      {"largest S [-]", range.S_max},
      {"smallest diameter [m]", range.d_min},
      {"largest diameter [m]", range.d_max},
      {"d10 at S = 1 [m]", sizes.d_10},
      {"d10 wanted [m]", s.sizes.sieve(0.1)},
      {"d50 at S = 1 [m]", sizes.d_50},
      {"d50 wanted [m]", s.sizes.sieve(0.5)},
      {"d90 at S = 1 [m]", sizes.d_90},
      {"d90 wanted [m]", s.sizes.sieve(0.9)},
      {"largest difference of the size curves by mass [-]", sizes.distance_by_mass},
      {"largest difference of the size curves by number [-]", sizes.distance_by_number},
      {"periodic edge x [m]", p.cell.size.x()},
      {"periodic edge y [m]", p.cell.size.y()},
      {"periodic edge z [m]", p.cell.size.z()}};
  if (k.strengths.is_on()) {
    const dem::StrengthSpread drawn = dem::describe_strengths(p.particles);
    numbers.insert(
        numbers.end(),
        {{"mean strength factor of the particles [-]", drawn.mean},
         {"coefficient of variation of the strength factors [-]", drawn.variation},
         {"smallest strength factor [-]", drawn.smallest},
         {"largest strength factor [-]", drawn.largest}});
  }
  Summary found;
  for (const auto& [name, value] : numbers) found.number(name, value);
  return found;
}

} // namespace mergel::apps
