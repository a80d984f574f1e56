#include "apps/triaxial/band_summary.h"

#include "apps/case/words.h"
#include "apps/triaxial/band_output.h"
#include "dem/element/element_analysis.h"
#include "dem/text.h"

#include <cmath>
#include <ostream>

namespace mergel::apps {

namespace {

constexpr double degree = dem::pi / 180.0;
constexpr double around_peak = 2e-3; ///< axial strain on either side of the peak [-]

bool is_compressed(const TriaxialPoint& p, std::size_t stage)
{
  return p.analysed.stage == stage && !p.analysed.is_approach && p.whole.q() > 0.0 &&
         p.whole.stress.minCoeff() >= 0.0;
}

/// From the points of a stage whose axial strain is in [from, to].
std::optional<double> psi_between(const std::vector<TriaxialPoint>& points,
                                  std::size_t stage, double from, double to)
{
  std::vector<double> axial, volumetric;
  for (const TriaxialPoint& p : points) {
    const double e = p.whole.axial_strain();
    if (!is_compressed(p, stage) || e < from || e > to) continue;
    axial.push_back(e);
    volumetric.push_back(p.whole.volumetric_strain());
  }
  const auto line = axial.size() < 3 ? std::nullopt : dem::fit_line(axial, volumetric);
  if (!line) return {};
  return dem::dilation_angle(line->slope);
}

struct At {
  const char* when;
  std::optional<MobilisedAngles> angles;
};

std::string json_of(const At& at)
{
  if (!at.angles) return "";
  const dem::BandAngles b = dem::band_angles(at.angles->phi, at.angles->psi);
  std::string text;
  const auto add = [&](const char* name, double value) {
    text += std::string(",\n      \"") + name + " " + at.when +
            " [degree]\": " + number_in_json(value / degree);
  };
  add("friction angle", at.angles->phi);
  add("dilation angle", at.angles->psi);
  add("45 + phi/2", b.coulomb);
  add("45 + psi/2", b.roscoe);
  add("mean of both", b.arthur);
  return text;
}

std::string json_of(const coupling::BandRecord& r, double d_50)
{
  std::string text;
  for (const auto& [name, found] : localisations(r)) {
    text += std::string(",\n      \"") + name + "\": {";
    const char* comma = "";
    for (const BandColumn& c : band_columns(found, d_50)) {
      text += std::string(comma) + "\n        \"" + c.name + " [" + c.unit +
              "]\": " + number_in_json(c.value);
      comma = ",";
    }
    text += "\n      }";
  }
  return text;
}

double percent(double share)
{
  return std::round(100.0 * share);
}

/// "6.4 degrees to the horizontal, 6.5 d50 thick": no band where the shares are even.
void say(std::ostream& out, const dem::Slab& slab, double d_50)
{
  out << slab.angle() / degree << " degrees to the horizontal, " << slab.thickness() / d_50
      << " d50 thick";
}

void say(std::ostream& out, const char* tenth, const dem::Localisation& found, double d_50)
{
  out << "slab at ";
  say(out, found.band, d_50);
  out << ", with " << percent(found.band.share) << " % of the most " << tenth
      << " tenth (even: " << percent(found.band.even) << " %); in one slab of 10 d50 "
      << percent(found.of_ten.share) << " % (even: " << percent(found.of_ten.even)
      << " %)\n";
  if (!found.has_second()) return;
  out << "    a second one at ";
  say(out, found.second, d_50);
  out << " holds another " << percent(found.of_second()) << " % of it\n";
}

} // namespace

std::optional<MobilisedAngles> angles_at_peak(const std::vector<TriaxialPoint>& points,
                                              std::size_t stage)
{
  const TriaxialPoint *peak = nullptr, *first = nullptr, *last = nullptr;
  double phi = 0.0;
  for (const TriaxialPoint& p : points) {
    if (!is_compressed(p, stage)) continue;
    if (!first) first = &p;
    last = &p;
    const double here = dem::friction_angle(p.whole.stress);
    if (peak && here <= phi) continue;
    peak = &p;
    phi = here;
  }
  if (!peak || peak == first || peak == last) return {}; // loaded on, or unloaded, there
  const double e = peak->whole.axial_strain();
  const auto psi = psi_between(points, stage, e - around_peak, e + around_peak);
  if (!psi) return {};
  return MobilisedAngles{phi, *psi};
}

std::optional<MobilisedAngles> angles_at_end(const std::vector<TriaxialPoint>& points,
                                             std::size_t stage, double increment)
{
  const TriaxialPoint* last = nullptr;
  for (const TriaxialPoint& p : points)
    if (is_compressed(p, stage)) last = &p;
  if (!last) return {};
  const double e = last->whole.axial_strain();
  const auto psi = psi_between(points, stage, e - increment, e);
  if (!psi) return {};
  return MobilisedAngles{dem::friction_angle(last->whole.stress), *psi};
}

void summarise_bands(Summary& summary, const std::vector<coupling::BandRecord>& bands,
                     const std::vector<TriaxialPoint>& points,
                     const std::vector<StageLabel>& labels, double d_50)
{
  std::string text = "[";
  const char* comma = "\n";
  std::ostream& out = summary.closing;
  out.precision(3);
  for (std::size_t k = 0; k < bands.size(); ++k) {
    const coupling::BandRecord& r = bands[k];
    if (k + 1 < bands.size() && bands[k + 1].stage == r.stage) continue;
    const At at_peak{"at the peak", angles_at_peak(points, r.stage)},
        at_end{"at the end", angles_at_end(points, r.stage, r.increment)};
    const std::string number = labels[r.stage].name();
    text +=
        std::string(comma) + "    {\n      \"number\": " + in_json(number) +
        ",\n      \"axial strain [-]\": " + number_in_json(r.axial_strain) +
        ",\n      \"increment of the axial strain [-]\": " + number_in_json(r.increment) +
        json_of(at_peak) + json_of(at_end) + json_of(r, d_50) + "\n    }";
    comma = ",\n";
    out << "stage " << number << ", shear strain: ";
    say(out, "sheared", r.shear, d_50);
    out << "  in the last " << 100.0 * r.increment << " % of axial strain: ";
    say(out, "sheared", r.shear_increment, d_50);
    if (at_peak.angles) {
      const dem::BandAngles b = dem::band_angles(at_peak.angles->phi, at_peak.angles->psi);
      out << "  at the peak phi " << at_peak.angles->phi / degree << ", psi "
          << at_peak.angles->psi / degree << " degrees: 45 + phi/2 " << b.coulomb / degree
          << ", 45 + psi/2 " << b.roscoe / degree << ", mean " << b.arthur / degree
          << " degrees\n";
    }
    out << "  compaction: ";
    say(out, "compacted", r.compaction, d_50);
    out << "  in the last " << 100.0 * r.increment << " % of axial strain: ";
    say(out, "compacted", r.compaction_increment, d_50);
  }
  summary.json("localisation", text + (bands.empty() ? "]" : "\n  ]"));
}

} // namespace mergel::apps
