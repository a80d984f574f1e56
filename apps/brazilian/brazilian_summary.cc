#include "apps/brazilian/brazilian_summary.h"

#include "apps/coupled/time_by_parts.h"
#include "apps/run/progress.h"
#include "apps/run/step_report.h"
#include "dem/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>

namespace mergel::apps {

using coupling::BrazilianPoint;
using coupling::DiscBreak;
using coupling::DiscZone;

namespace {

constexpr double degrees = 180.0 / dem::pi;
constexpr std::array<const char*, coupling::n_disc_zones> zone_names{
    "at the centre", "at the plates", "along the loaded diameter", "at the sides"};
constexpr std::array<const char*, dem::n_break_modes> mode_names{"tension", "compression",
                                                                 "shear", "bending"};

const char* name_of(DiscZone zone)
{
  return zone_names.at(static_cast<std::size_t>(zone));
}

/// What the records say of the plates and the energy.
struct Extremes {
  double difference =
      0.0; ///< of the plate forces over the largest load so far, up to the peak
           ///< and once the load is a tenth of it [-]
  double energy_error = 0.0; ///< [-]
};

Extremes extremes_of(const std::vector<BrazilianPoint>& points)
{
  Extremes e;
  const BrazilianPoint& peak = points[coupling::peak_of(points)];
  double largest = 0.0;
  for (const BrazilianPoint& p : points) {
    largest = std::max(largest, p.load);
    e.energy_error = std::max(e.energy_error, std::abs(p.energy_error));
    if (p.strain <= peak.strain && largest > 0.0 && largest >= 0.1 * peak.load)
      e.difference = std::max(e.difference, std::abs(p.difference) / largest);
  }
  return e;
}

/// Tension at the centre over that of an elastic disc under the same load, at the last record
/// up to the peak with at most half of its load [-]. None without such a record, and where the
/// centre bore more than a tenth of that tension before it was loaded: the ratio is not that of the
/// load then.
std::optional<double> centre_ratio(const std::vector<BrazilianPoint>& points,
                                   std::size_t peak, const coupling::DiscGeometry& disc)
{
  std::optional<double> ratio;
  for (std::size_t k = 0; k < peak; ++k) {
    const BrazilianPoint& p = points[k];
    if (p.load > 0.5 * points[peak].load) break;
    if (!(p.load > 0.0)) continue;
    const double elastic =
        coupling::elastic_stress(disc, p.load, coupling::centre_width * disc.diameter).xx;
    ratio.reset();
    if (std::abs(points.front().across) <= 0.1 * elastic) ratio = p.across / elastic;
  }
  return ratio;
}

/// The first breaks, a line of JSON each.
std::string breaks_text(const std::vector<DiscBreak>& breaks,
                        const coupling::DiscGeometry& disc, double peak_load)
{
  std::ostringstream out;
  out << "[";
  const std::size_t n = std::min(first_breaks, breaks.size());
  for (std::size_t k = 0; k < n; ++k) {
    const DiscBreak& b = breaks[k];
    const auto number = [&](const char* name, double value) {
      out << '"' << name << "\": " << number_in_json(value) << ", ";
    };
    out << (k > 0 ? ",\n    {" : "\n    {");
    number("x [m]", b.x.x());
    number("y [m]", b.x.y());
    number("z [m]", b.x.z());
    number("distance to the loaded diameter [m]", std::abs(b.x.x()));
    number("distance to the nearer plate [m]", b.to_plate);
    number("load [N]", b.load);
    number("2P/(pi D t) [Pa]", disc.splitting_stress(b.load));
    number("share of the largest load [-]", b.load / peak_load);
    out << "\"mode\": \"" << mode_names.at(static_cast<std::size_t>(b.mode))
        << "\", \"zone\": \"" << name_of(coupling::zone_of(b.x, disc)) << "\"}";
  }
  out << (n > 0 ? "\n  ]" : "]");
  return out.str();
}

} // namespace

std::string sentence_of(coupling::BrazilianOutcome outcome)
{
  switch (outcome) {
  case coupling::BrazilianOutcome::load_fell:
    return "the load fell below its final share";
  case coupling::BrazilianOutcome::strain_limit_reached:
    return "the strain limit was reached";
  case coupling::BrazilianOutcome::goes_on:
    break;
  }
  return "not ended";
}

std::string describe(const BrazilianCase& c, const coupling::BrazilianTest& test)
{
  std::ostringstream out;
  out.precision(4);
  out << "plates: " << 1e3 * test.state().gap_0 << " mm apart, approach at "
      << 1e3 * c.velocity << " mm/s; each sends a wave of " << 1e-3 * test.wave_stress()
      << " kPa into the disc (rho " << test.state().density << " kg/m3)";
  return out.str();
}

void summarise(Summary& summary, const BrazilianCase& c,
               const coupling::BrazilianTest& test, const coupling::CoupledSystem& system,
               const Work& work)
{
  const coupling::DiscGeometry disc = c.disc();
  const std::vector<BrazilianPoint>& points = test.points();
  const std::vector<DiscBreak>& breaks = test.breaks();
  const std::size_t peak = coupling::peak_of(points);
  const BrazilianPoint& at_peak = points[peak];
  const double index = disc.splitting_stress(at_peak.load);
  const Extremes extremes = extremes_of(points);
  const std::optional<double> ratio = centre_ratio(points, peak, disc);
  const std::size_t at_start = std::min(first_breaks, breaks.size());
  const bool has_breaks = at_start > 0;
  const DiscZone began =
      has_breaks ? coupling::where_it_began(breaks, at_start, disc) : DiscZone::sides;
  const bool is_strength = has_breaks && began == DiscZone::centre;
  const auto outcome = coupling::outcome(c, points);
  const auto counts = coupling::count_zones(breaks, at_start, disc);

  summary.text("outcome", sentence_of(outcome));
  summary.number("2P/(pi D t) at the peak [Pa]", index);
  summary.text("2P/(pi D t) is", is_strength ? "the tensile strength" : "an index");
  summary.number("largest load [N]", at_peak.load);
  summary.number("diametral strain at the peak [-]", at_peak.strain);
  summary.number("contact half-angle at the peak [rad]", at_peak.half_angle);
  summary.number("half-angle of all contacts at the peak [rad]", at_peak.outermost);
  summary.number("stress across at the centre at the peak [Pa]", at_peak.across);
  summary.number("stress along at the centre at the peak [Pa]", at_peak.along);
  summary.number("stress across at the centre at the start [Pa]", points.front().across);
  summary.number("stress along at the centre at the start [Pa]", points.front().along);
  if (ratio)
    summary.number("tension at the centre over that of an elastic disc [-]", *ratio);
  summary.count("bonds broken at the peak [-]", at_peak.broken);
  summary.count("bonds broken [-]", points.back().broken);
  summary.text("failure began", has_breaks ? name_of(began) : "nowhere");
  for (std::size_t k = 0; k < coupling::n_disc_zones; ++k)
    summary.count(std::string("first breaks ") + zone_names.at(k) + " [-]", counts.at(k));
  summary.number("share of breaks within D/6 of the loaded diameter, up to the peak [-]",
                 coupling::share_near_diameter(breaks, at_peak.broken, disc));
  summary.number("share of breaks within D/6 of the loaded diameter [-]",
                 coupling::share_near_diameter(breaks, breaks.size(), disc));
  summary.json("first breaks", breaks_text(breaks, disc, at_peak.load));
  summary.number("diametral strain at the end [-]", points.back().strain);
  summary.number("load at the end [N]", points.back().load);
  summary.number("velocity of approach [m/s]", c.velocity);
  summary.number("wave stress of a plate [Pa]", test.wave_stress());
  summary.number("largest difference of the plate forces over the load, up to the peak [-]",
                 extremes.difference);
  summary.number("largest energy error [-]", extremes.energy_error);
  add_alarm(summary, test.state().alarm);
  summary.count("particles [-]", system.assembly.particles.size());
  summary.count("steps [-]", system.n_steps);
  add_step(summary, system.stable_step, system.dt);
  add_mass_scaling(summary, system.assembly.particles);
  summary.number("wall-clock time [s]", work.seconds);

  std::ostream& out = summary.closing;
  out.precision(4);
  out << sentence_of(outcome) << ": largest load " << at_peak.load
      << " N, 2P/(pi D t) = " << 1e-6 * index << " MPa at a diametral strain of "
      << 100.0 * at_peak.strain << " %\n";
  if (has_breaks) {
    out << "failure began " << name_of(began) << ": of the first " << at_start << " breaks";
    for (std::size_t k = 0; k < coupling::n_disc_zones; ++k)
      out << (k > 0 ? ", " : " ") << counts.at(k) << ' ' << zone_names.at(k);
    out << "; the first at " << 100.0 * breaks.front().load / at_peak.load
        << " % of the largest load\n";
    if (!is_strength)
      out << "it did not begin at the centre, where the elastic tension is 2P/(pi D t): "
             "the "
             "value is an index, not the tensile strength\n";
  } else {
    out << "no bond broke: 2P/(pi D t) is no strength\n";
  }
  out << "contact half-angle at the peak " << degrees * at_peak.half_angle
      << " degrees, all contacts within " << degrees * at_peak.outermost << "; "
      << 100.0 * coupling::share_near_diameter(breaks, breaks.size(), disc) << " % of "
      << breaks.size() << " breaks within D/6 of the loaded diameter\n";
  if (ratio)
    out << "tension at the centre " << *ratio
        << " of that of an elastic disc, at half of the largest load\n";
  out << "plate forces differ by " << 100.0 * extremes.difference
      << " % of the load at most, up to the peak; largest energy error "
      << extremes.energy_error << " of the work\ntime step " << system.dt << " s, ruled by "
      << dem::what_rules(system.stable_step) << '\n'
      << time_by_parts(system, work, "plates") << "whole run "
      << duration_text(work.seconds);
}

} // namespace mergel::apps
