#include "apps/element/element_case.h"

#include "apps/case/motion_keys.h"
#include "apps/case/units.h"
#include "apps/case/unusual.h"
#include "apps/case/word_list.h"
#include "apps/case/words.h"
#include "apps/specimen/specimen.h"
#include "dem/error.h"
#include "dem/io/table.h"
#include "dem/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <string>

namespace mergel::apps {

namespace {

void declare_size_effect(CaseFile& file, SizeEffectKeys& e)
{
  const auto section = file.section("Size effect");
  file.flag("size effect", e.is_on,
            "Multiply the strengths of the bonds by psi (B_ref/B)^0.18, Eqs. 17-19.");
  file.former_name("sample width", "specimen width");
  const auto only = file.only_if("size effect", {"true"});
  e.law.reference_width = e.law.psi = unset;
  file.quantity("specimen width", e.width, "m", non_negative,
                "B; 0 takes the mean edge of the cell.", "mm");
  file.quantity("reference width", e.law.reference_width, "m", positive,
                "B_ref, at which the strengths of section Bond hold.", "mm");
  file.number("psi", e.law.psi, positive,
              "Factor at any width but the reference's, Eq. 16.");
}

void declare_loading(CaseFile& file, ElementCase& c)
{
  const auto section = file.section("Loading");
  declare_stages(file, c.stage_texts);
  file.number(
      "inertial number", c.inertial_number, inside(0.0, 0.1),
      "I = rate d sqrt(rho/p) of the controlled strain, d the mean particle diameter by "
      "mass, rho the particle density; quasi-static below 1e-3.");
  file.derived(
      "reference pressure", c.reference_pressure, "Pa", positive,
      "Bond/tensile strength/40",
      "Used in I in place of p where |p| is smaller; by default half of what a rock "
      "bears in tension, some 1/20 of the strength of its bonds; without bonds the target "
      "pressure of the packing.",
      "MPa");
  file.number("strain limit", c.strain_limit, inside(0.0, 0.9),
              "The test ends where a strain since its start exceeds this limit.");
  file.number(
      "reversal", c.reversal, inside(0.0, 1.0),
      "The test ends at an unstable point: a stress on its way to the target falls back by "
      "this fraction of the way made.");
}

void declare_motion(CaseFile& file, ElementCase& c)
{
  const auto section = file.section("Motion");
  file.number("damping", c.damping, from_to(0.0, 1.0).named("alpha"),
              "Local non-viscous damping of the particles' motion relative to the cell.");
  declare(file, motion_keys(c));
}

void declare_analysis(CaseFile& file, ElementCase& c)
{
  const auto section = file.section("Analysis");
  declare(file, c.analysis);
  file.paths(
      "critical states", c.critical_folders,
      "Results folders of other element runs, separated by blanks, one with a blank in its "
      "name in double quotes: the critical state line is fitted to their final states and "
      "that of this run.");
  file.text("critical state values", c.critical_values,
            "Folder, p [Pa], q [Pa] and void ratio of each of these states, set in a "
            "resolved case: a run that is continued, or where a folder is gone, needs no "
            "file.");
}

/// Refuse a cell that the strain limit would make too small for its particles.
void check_size(const CaseFile& file, const ElementCase& c)
{
  const dem::Grading& sizes = c.specimen.specimen.sizes;
  const double range =
      dem::activation_gap(c.contact.chosen()) + dem::default_skin * sizes.smallest();
  const double smallest = dem::smallest_edge(sizes.largest(), range, c.specimen.S);
  const double edge = c.specimen.edges.minCoeff();
  // A confined cell is a little smaller, and the limit is checked only at the records.
  if (0.99 * edge * (1.0 - c.strain_limit - c.record_every) < smallest)
    file.refuse("Loading", "strain limit",
                "the cell, whose smallest edge is " + dem::rounded(1e3 * edge) +
                    " mm, would become shorter than its largest particles allow, " +
                    dem::rounded(1e3 * smallest) +
                    " mm: lower the limit, or take a larger cell");
}

/// Final state of another run, from its results folder.
dem::CriticalState last_state(const CaseFile& file, const std::filesystem::path& folder)
{
  try {
    const dem::Table table = dem::read_table(folder / "history.csv");
    const auto last = [&](const char* name, const char* unit) {
      return table.column(name, unit).back(); // a table has a row
    };
    return {last("p", "Pa"), last("q", "Pa"), last("void ratio", "-")};
  } catch (const InputError& e) {
    file.refuse("Analysis", "critical states",
                folder.string() + " holds no results of an element test: " + e.what());
  }
}

/// The states in a resolved case, by their folders.
std::map<std::string, dem::CriticalState> known_states(const CaseFile& file,
                                                       const std::string& text)
{
  std::map<std::string, dem::CriticalState> known;
  try {
    const std::vector<std::string> words = words_of(text);
    const auto number = [&](std::size_t k) {
      double value = 0.0;
      const char* end = words[k].data() + words[k].size();
      const auto parsed = std::from_chars(words[k].data(), end, value);
      require(parsed.ec == std::errc{} && parsed.ptr == end && std::isfinite(value),
              words[k] + " is no number. Leave the key out to read the folders");
      return value;
    };
    require(words.size() % 4 == 0,
            "is no list of folders with three numbers each. Leave the key out to read the "
            "folders");
    for (std::size_t k = 0; k < words.size(); k += 4)
      known[words[k]] = {number(k + 1), number(k + 2), number(k + 3)};
  } catch (const InputError& e) {
    file.refuse("Analysis", "critical state values", e.what());
  }
  return known;
}

/// Final states of the other runs: from their folders or, where a run is continued or a
/// folder is gone, from the case. Sets them in the resolved case.
void find_critical_states(CaseFile& file, ElementCase& c)
{
  const char *const section = "Analysis", *const values = "critical state values";
  const bool is_asked_anew = file.is_override(section, "critical states");
  const auto known = known_states(file, c.critical_values.empty() && file.is_continued()
                                            ? file.earlier_value(section, values)
                                            : c.critical_values);
  c.critical_states.clear();
  c.critical_values.clear();
  for (const std::filesystem::path& folder : c.critical_folders) {
    const auto found = known.find(folder.string());
    std::error_code error; // a folder that cannot be reached counts as gone
    const bool is_gone = !std::filesystem::exists(folder, error);
    const bool is_known =
        found != known.end() && (is_gone || (file.is_continued() && !is_asked_anew));
    const dem::CriticalState s = is_known ? found->second : last_state(file, folder);
    c.critical_states.push_back(s);
    c.critical_values += (c.critical_values.empty() ? "" : " ") + as_word(folder.string());
    for (const double value : {s.p, s.q, s.e})
      c.critical_values += ' ' + dem::shortest(value);
  }
  file.resolve(section, values, c.critical_values);
}

} // namespace

void declare(CaseFile& file, ElementCase& c)
{
  c.specimen.shape = SpecimenKeys::Shape::periodic_box;
  c.specimen.upscaling = SpecimenKeys::Upscaling::uniform;
  declare(file, c.specimen);
  declare(file, c.bond);
  declare(file, c.contact);
  declare_size_effect(file, c.size_effect);
  declare_loading(file, c);
  declare_motion(file, c);
  declare_analysis(file, c);
  const auto section = file.section("Output");
  file.number("record every", c.record_every, inside(0.0, 0.1),
              "Controlled strain between two lines of history.csv.");
  declare(file, c.checkpoints);
  file.choice("pictures", c.pictures,
              std::vector<std::pair<std::string, ElementCase::Pictures>>{
                  {"none", ElementCase::Pictures::none},
                  {"stages", ElementCase::Pictures::stages},
                  {"strain", ElementCase::Pictures::strain}},
              "Of particles and bonds, for ParaView: none; at the start and at the end of "
              "each stage; or also at intervals of strain.");
  const auto only = file.only_if("pictures", {"strain"});
  file.number("picture every", c.picture_every, inside(0.0, 1.0),
              "Strain of any edge of the cell between two pictures.");
}

namespace {

/// Tensile force that breaks a bond, over its section [Pa].
double tensile_strength(const dem::BondLaw& bond)
{
  return std::visit(
      [](const auto& law) {
        const dem::BondShape<double> shape = bond_shape(law, 1.0, 1.0);
        return single_strengths(law, shape).tension / shape.A;
      },
      bond);
}

/// What a specimen without bonds needs instead of their strength.
void complete_granular(CaseFile& file, ElementCase& c)
{
  check_granular_stages(file, c.stage_texts);
  if (c.size_effect.is_on)
    file.refuse("Size effect", "size effect",
                "there are no bonds whose strengths could vary, `Specimen/coordination` is "
                "0: use `false`");
  if (c.specimen.specimen.compaction == dem::Compaction::confined)
    file.derive("Loading", "reference pressure", c.specimen.specimen.pressure);
  else if (!file.is_given("Loading", "reference pressure"))
    file.refuse("Loading", "reference pressure",
                "must be given for an `expanded` packing without bonds, whose pressure "
                "nobody knows yet: a pressure that it will have, such as 100 kPa");
}

} // namespace

void complete(CaseFile& file, ElementCase& c)
{
  if (c.specimen.shape != SpecimenKeys::Shape::periodic_box)
    file.refuse("Specimen", "shape", "an element test needs a `periodic box`");
  c.specimen.specimen.free_rotation = c.free_rotation;
  complete(file, motion_keys(c));
  complete(file, c.specimen, c.contact.chosen());
  if (!c.specimen.is_granular()) refuse_impossible(file, c.bond, c.contact);
  check_size(file, c);
  check(file, c.analysis);

  complete(file, c.checkpoints);
  c.stages = stages_of(file, c.stage_texts);
  c.stage_labels = labels_of(c.stage_texts);
  if (c.specimen.is_granular())
    complete_granular(file, c);
  else
    file.derive("Loading", "reference pressure", tensile_strength(c.bond.chosen()) / 40.0);
  find_critical_states(file, c);
}

dem::PeriodicSpecimen obtain_specimen(const CaseFile& file, const ElementCase& c)
{
  dem::Sample sample = obtain_sample(file, c.specimen);
  return {std::move(sample.packing.particles), sample.packing.cell,
          std::move(sample.bonding.pairs)};
}

double specimen_width(const ElementCase& c, const dem::PeriodicSpecimen& specimen)
{
  return c.size_effect.width > 0.0 ? c.size_effect.width : specimen.cell.size.mean();
}

dem::PairMaterials resolved_materials(const ElementCase& c,
                                      const dem::PeriodicSpecimen& specimen)
{
  dem::PairMaterials m{c.bond.chosen(), c.contact.chosen()};
  const double factor = c.size_effect.factor(specimen_width(c, specimen));
  std::visit([&](auto& bond) { bond = with_strengths_times(factor, bond); }, m.bond);
  return m;
}

std::string report(const ElementCase& c, const dem::PeriodicSpecimen& specimen,
                   const dem::PairMaterials& materials)
{
  const dem::ParticleRange range = dem::describe_particles(specimen.particles);
  std::ostringstream out;
  out.precision(4);
  const dem::Vec3 mm = 1e3 * specimen.cell.size;
  const auto n = static_cast<double>(specimen.particles.size());
  out << "specimen: " << n << " particles of " << 1e3 * range.d_min << " to "
      << 1e3 * range.d_max << " mm in a periodic cell of " << mm.x() << " x " << mm.y()
      << " x " << mm.z()
      << " mm, Z = 2 N_bonds/N = " << 2.0 * static_cast<double>(specimen.bonded.size()) / n
      << '\n';
  const auto scaled = [&](const char* name, double at_1) {
    out << ", " << name << ' ' << 1e3 * at_1 * range.S_min;
    if (range.S_max > range.S_min) out << " to " << 1e3 * at_1 * range.S_max;
    out << " mm";
  };
  out << "resolved: S " << range.S_min;
  if (range.S_max > range.S_min) out << " to " << range.S_max;
  if (c.specimen.is_granular()) {
    scaled("g_a", dem::activation_gap(materials.contact));
    const bool has_section = dem::section(materials.bond).E > 0.0; // the key has no default
    return out.str() + " (Eq. 8); granular, without bonds" +
           (has_section ? ": section Bond has no effect" : "");
  }
  if (const auto* b = std::get_if<dem::DamageBond>(&materials.bond)) {
    scaled("u_c", b->u_c);
    scaled("g_a", dem::activation_gap(materials.contact));
    out << " (Eq. 8); sigma_t " << 1e-6 * b->sigma_t << ", sigma_c " << 1e-6 * b->sigma_c
        << ", C " << 1e-6 * b->C << " MPa";
  } else if (const auto* b = std::get_if<dem::ParallelBond>(&materials.bond)) {
    scaled("g_a", dem::activation_gap(materials.contact));
    out << " (Eq. 8); tensile " << 1e-6 * b->sigma_c << ", shear strength "
        << 1e-6 * b->tau_c << " MPa";
  }
  if (c.size_effect.is_on) {
    const double B = specimen_width(c, specimen);
    out << "; strengths include the size effect, times " << c.size_effect.factor(B)
        << " at a width of " << 1e3 * B << " mm (Eq. 18)";
  } else
    out << "; no size effect";
  return out.str() + apps::report(c.specimen.strengths, specimen.particles);
}

} // namespace mergel::apps
