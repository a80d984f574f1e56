#include "apps/element/element_case.h"

#include "apps/case/units.h"
#include "apps/case/words.h"
#include "apps/specimen/specimen.h"
#include "dem/error.h"
#include "dem/io/table.h"
#include "dem/text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace mergel::apps {

namespace {

void declare_size_effect(CaseFile& file, SizeEffectKeys& e)
{
  const auto section = file.section("Size effect");
  file.flag("size effect", e.is_on,
            "Multiply the strengths of the bonds by psi (B_ref/B)^0.18, Eqs. 17-19.");
  file.quantity("sample width", e.width, "m", non_negative,
                "B; 0 takes the mean edge of the cell.", "mm");
  file.quantity("reference width", e.law.reference_width, "m", positive,
                "B_ref, at which the strengths of section Bond hold.", "mm");
  file.number("psi", e.law.psi, positive,
              "Factor at any width but the reference's, Eq. 16.");
}

void declare_loading(CaseFile& file, ElementCase& c)
{
  const auto section = file.section("Loading");
  c.leg_texts.assign(most_legs, "");
  for (std::size_t k = 0; k < most_legs; ++k)
    file.text(key_of_leg(k), c.leg_texts[k],
              k > 0
                  ? "The next leg; empty: the test ends before."
                  : std::string("A leg of the path: ") + forms_of_leg +
                        ". Compression is positive, z is the axis, strains count from the "
                        "start of the leg (resume, unload, reload: of the leg resumed).",
              k > 0 ? Default::present : Default::none);
  file.number(
      "inertial number", c.inertial_number, inside(0.0, 0.1),
      "I = rate d sqrt(rho/p) of the driven strain, d the mean grain by mass, rho its "
      "density; quasi-static below 1e-3.");
  file.quantity("reference pressure", c.reference_pressure, "Pa", positive,
                "Stands for p in I where |p| is below.", "MPa");
  file.number("strain limit", c.strain_limit, inside(0.0, 0.9),
              "A test that comes so far, from the edges it began with, ends there.");
  file.number(
      "reversal", c.reversal, inside(0.0, 1.0),
      "A leg to a stress that falls back by this share of the way it had made has met "
      "an unstable point: it ends the test.");
}

void declare_motion(CaseFile& file, ElementCase& c)
{
  const auto section = file.section("Motion");
  file.number("damping", c.damping, from_to(0.0, 1.0).named("alpha"),
              "Local non-viscous damping of the grains' motion against the cell.");
  file.number("time step safety", c.safety, above_to(0.0, 1.0),
              "Share of the critical time step that is used.");
  file.flag("free rotation", c.free_rotation,
            "Let grains without a living bond spin; the paper holds them.");
}

void declare_analysis(CaseFile& file, ElementCase& c)
{
  const auto section = file.section("Analysis");
  file.number(
      "secant from", c.secant_from, non_negative,
      "Strain of the leg at which the secant for moduli and Poisson's ratio starts.");
  file.number("secant to", c.secant_to, positive, "Strain at which it ends.");
  file.number("yield offset", c.yield_offset, positive,
              "Strain by which the line of the modulus is moved for the yield point.");
  file.text(
      "critical states", c.critical_text,
      "Folders of other element runs, with blanks between: their last states and this "
      "run's are fitted by the critical state line.");
}

/// Refuse a cell that the strain limit would make too small for its grains.
void check_size(const CaseFile& file, const ElementCase& c)
{
  const dem::Grading& sizes = c.specimen.specimen.sizes;
  const double range = c.contact.g_a + dem::usual_skin * sizes.smallest();
  const double least = dem::least_edge(sizes.largest(), range, c.specimen.S);
  const double edge = c.specimen.edges.minCoeff();
  // A confined cell is a little smaller, and the limit is looked at when a line is due.
  if (0.99 * edge * (1.0 - c.strain_limit - c.record_every) < least)
    file.refuse(
        "Loading", "strain limit",
        "the cell, an edge of which is " + dem::shortest(1e3 * edge) +
            " mm, would become shorter than twice the reach of its largest grains, " +
            dem::shortest(1e3 * least) + " mm: lower it, or take a larger cell");
}

/// The leg that one after these would resume.
const dem::Leg& resumed(const std::vector<dem::Leg>& legs)
{
  const auto at = std::find_if(legs.rbegin(), legs.rend(), [](const dem::Leg& leg) {
    return leg.kind != dem::PathKind::resume;
  });
  require(at != legs.rend(), "there is no leg before to resume");
  return *at;
}

/// Where another run ended, from its folder of results.
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

} // namespace

std::string key_of_leg(std::size_t k)
{
  return "leg " + std::to_string(k + 1);
}

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
              "Driven strain from one line of history.csv to the next.");
  declare(file, c.checkpoints);
  file.choice("pictures", c.pictures,
              std::vector<std::pair<std::string, ElementCase::Pictures>>{
                  {"none", ElementCase::Pictures::none},
                  {"legs", ElementCase::Pictures::legs},
                  {"strain", ElementCase::Pictures::strain}},
              "Of grains and bonds, for ParaView: none; at the start and where a leg ends; "
              "or every so much strain besides.");
  const auto only = file.only_if("pictures", {"strain"});
  file.number("picture every", c.picture_every, inside(0.0, 1.0),
              "Strain of any edge of the cell from one picture to the next.");
}

void complete(CaseFile& file, ElementCase& c)
{
  if (c.specimen.shape != SpecimenKeys::Shape::periodic_box)
    file.refuse("Specimen", "shape", "an element test leads a `periodic box`");
  c.specimen.specimen.free_rotation = c.free_rotation;
  complete(file, c.specimen, c.contact);
  check_size(file, c);
  if (c.secant_to <= c.secant_from)
    file.refuse("Analysis", "secant to", "must be beyond `secant from`");

  complete(file, c.checkpoints);
  bool is_over = false;
  for (std::size_t k = 0; k < most_legs; ++k) {
    if (c.leg_texts[k].empty()) {
      is_over = true;
      continue;
    }
    if (is_over)
      file.refuse("Loading", key_of_leg(k), "the leg before is empty: close the gap");
    try {
      for (const dem::Leg& leg : read_legs(c.leg_texts[k])) {
        if (leg.kind == dem::PathKind::resume) leg.check_after(resumed(c.legs));
        c.legs.push_back(leg);
      }
    } catch (const std::invalid_argument& e) {
      file.refuse("Loading", key_of_leg(k), e.what());
    }
  }
  std::istringstream folders(c.critical_text);
  for (std::string folder; folders >> folder;)
    c.critical_states.push_back(last_state(file, folder));
}

dem::PeriodicSpecimen obtain_rock(const CaseFile& file, const ElementCase& c)
{
  dem::Sample sample = obtain_sample(file, c.specimen);
  return {std::move(sample.packing.particles), sample.packing.cell,
          std::move(sample.bonding.pairs)};
}

double sample_width(const ElementCase& c, const dem::PeriodicSpecimen& rock)
{
  return c.size_effect.width > 0.0 ? c.size_effect.width : rock.cell.size.mean();
}

dem::PairMaterials resolved_materials(const ElementCase& c,
                                      const dem::PeriodicSpecimen& rock)
{
  dem::PairMaterials m{c.bond.chosen(), c.contact};
  const double factor = c.size_effect.factor(sample_width(c, rock));
  std::visit([&](auto& bond) { bond = with_strengths_times(factor, bond); }, m.bond);
  return m;
}

std::string report(const ElementCase& c, const dem::PeriodicSpecimen& rock,
                   const dem::PairMaterials& materials)
{
  const dem::GrainRange range = dem::describe_grains(rock.particles);
  std::ostringstream out;
  out.precision(4);
  const dem::Vec3 mm = 1e3 * rock.cell.size;
  const auto n = static_cast<double>(rock.particles.size());
  out << "rock: " << n << " grains of " << 1e3 * range.d_min << " to " << 1e3 * range.d_max
      << " mm in a periodic cell of " << mm.x() << " x " << mm.y() << " x " << mm.z()
      << " mm, Z = 2 N_bonds/N = " << 2.0 * static_cast<double>(rock.bonded.size()) / n
      << '\n';
  const auto scaled = [&](const char* name, double at_1) {
    out << ", " << name << ' ' << 1e3 * at_1 * range.S_min;
    if (range.S_max > range.S_min) out << " to " << 1e3 * at_1 * range.S_max;
    out << " mm";
  };
  out << "resolved: S " << range.S_min;
  if (range.S_max > range.S_min) out << " to " << range.S_max;
  if (const auto* b = std::get_if<dem::DamageBond>(&materials.bond)) {
    scaled("u_c", b->u_c);
    scaled("g_a", materials.contact.g_a);
    out << " (Eq. 8); sigma_t " << 1e-6 * b->sigma_t << ", sigma_c " << 1e-6 * b->sigma_c
        << ", C " << 1e-6 * b->C << " MPa";
  } else if (const auto* b = std::get_if<dem::ParallelBond>(&materials.bond)) {
    scaled("g_a", materials.contact.g_a);
    out << " (Eq. 8); tensile " << 1e-6 * b->sigma_c << ", shear strength "
        << 1e-6 * b->tau_c << " MPa";
  }
  if (c.size_effect.is_on) {
    const double B = sample_width(c, rock);
    out << ", times " << c.size_effect.factor(B) << " for a width of " << 1e3 * B
        << " mm (Eq. 18)";
  } else
    out << ", no size effect";
  return out.str() + apps::report(c.specimen.strengths, rock.particles);
}

} // namespace mergel::apps
