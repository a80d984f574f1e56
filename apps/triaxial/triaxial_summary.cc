#include "apps/triaxial/triaxial_summary.h"

#include "apps/coupled/time_by_parts.h"
#include "apps/run/progress.h"
#include "apps/run/step_report.h"
#include "apps/triaxial/band_summary.h"
#include "dem/io/state/named_rows.h"
#include "dem/io/state/stage_numbers.h"
#include "dem/text.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mergel::apps {

TriaxialPoint point_of(const coupling::TriaxialRecord& r)
{
  return {{r.stage, r.is_approach, r.controlled_strain, r.of_stage, r.broken},
          r.cell_pressure,
          r.whole};
}

namespace {

template <class Point>
dem::NumbersOf<Point> numbers_of_point(Point& p)
{
  dem::NumbersOf<Point> all{{"controlled strain [-]", &p.analysed.controlled_strain},
                            {"cell pressure [Pa]", &p.cell_pressure}};
  dem::append_vector(all, "stress", "[Pa]", p.whole.stress);
  dem::append_vector(all, "strain", "[-]", p.whole.strain);
  dem::append_vector(all, "stress of the stage", "[Pa]", p.analysed.of_stage.stress);
  dem::append_vector(all, "strain of the stage", "[-]", p.analysed.of_stage.strain);
  return all;
}

template <class Point>
dem::CountsOf<Point> counts_of_point(Point& p)
{
  return {{"stage", &p.analysed.stage},
          {"approaches", &p.analysed.is_approach},
          {"broken bonds", &p.analysed.broken}};
}

template <class Extremes>
dem::NumbersOf<Extremes> numbers_of_extremes(Extremes& e)
{
  return {{"largest q [Pa]", &e.q},
          {"largest difference of the platens [-]", &e.platen_difference},
          {"largest energy error [-]", &e.energy_error},
          {"largest inertial number [-]", &e.inertial_number},
          {"largest tilt [rad]", &e.tilt},
          {"largest stretch [-]", &e.stretch},
          {"largest own load of the membrane [-]", &e.own_load},
          {"void ratio [-]", &e.void_ratio},
          {"membrane penetration [-]", &e.penetration},
          {"volumetric strain [-]", &e.volumetric_strain}};
}

} // namespace

void save(dem::State& state, const std::vector<TriaxialPoint>& points)
{
  dem::save_number_rows(state, "point_numbers", points,
                        [](auto& p) { return numbers_of_point(p); });
  dem::save_count_rows(state, "point_counts", points,
                       [](auto& p) { return counts_of_point(p); });
}

std::vector<TriaxialPoint> load_points(const dem::State& state)
{
  auto points = dem::load_count_rows<TriaxialPoint>(
      state, "point_counts", [](auto& p) { return counts_of_point(p); });
  if (points.empty()) dem::State::refuse("point_counts", "has no record");
  dem::load_number_rows(state, "point_numbers", points,
                        [](auto& p) { return numbers_of_point(p); });
  return points;
}

dem::NumbersOf<TriaxialExtremes> numbers_of(TriaxialExtremes& e)
{
  return numbers_of_extremes(e);
}
dem::NumbersOf<const TriaxialExtremes> numbers_of(const TriaxialExtremes& e)
{
  return numbers_of_extremes(e);
}

void TriaxialExtremes::add(const coupling::TriaxialRecord& r)
{
  const auto raise = [](double& to, double value) { to = std::max(to, std::abs(value)); };
  raise(q, r.whole.q());
  raise(energy_error, r.energy_error);
  raise(inertial_number, r.inertial_number);
  raise(tilt, r.tilt);
  raise(stretch, r.membrane.stretch);
  void_ratio = r.void_ratio;
  penetration = r.membrane.penetration;
  volumetric_strain = r.middle.volumetric;
  const double F = r.F_top + r.F_bottom;
  if (!(q > 0.0) || !(F > 0.0)) return;
  const double reference = std::max(q, r.cell_pressure);
  if (!r.is_approach)
    raise(platen_difference,
          2.0 * (r.F_top - r.F_bottom) / F * r.whole.axial() / reference);
  own_load = (std::abs(r.membrane.axial) + std::abs(r.membrane.hoop)) / reference;
}

std::string describe(const TriaxialCase& c, const coupling::TriaxialTest& test)
{
  std::ostringstream out;
  out.precision(4);
  const coupling::TriaxialState& s = test.state();
  if (test.has_membrane()) {
    const fem::MembraneMaterial& m = c.membrane.material;
    out << "membrane: " << test.membrane().motion().membrane().rest().triangles.size()
        << " triangles, nodes " << 1e3 * c.tube.node_distance() << " mm apart, E t "
        << 1e-3 * m.E * m.thickness << " kN/m (E " << 1e-6 * m.E << " MPa, "
        << 1e3 * m.thickness << " mm)\n";
  } else {
    out << "no membrane: unconfined\n";
  }
  const double c_wave = std::sqrt(s.stiffness / s.density);
  out << "platens: at most " << 1e3 * c.wave_stress / (s.density * c_wave)
      << " mm/s each, so that a wave has " << 1e-3 * c.wave_stress << " kPa (rho "
      << s.density << " kg/m3, c " << c_wave << " m/s)";
  return out.str();
}

void summarise(Summary& summary, const TriaxialCase& c, const coupling::TriaxialTest& test,
               const coupling::CoupledSystem& system,
               const std::vector<dem::Outcome>& outcomes,
               const std::vector<TriaxialPoint>& points,
               const std::vector<coupling::BandRecord>& bands,
               const TriaxialExtremes& extremes, const Work& work)
{
  const TriaxialPoint& last = points.back();
  std::vector<StagePoint> analysed;
  for (const TriaxialPoint& p : points) analysed.push_back(p.analysed);
  summarise(summary, analyse(c.stages, c.stage_labels, c.analysis, outcomes, analysed),
            c.analysis);
  summarise_bands(summary, bands, points, c.stage_labels, c.d_50());
  summary.number("p at the end [Pa]", last.whole.p());
  summary.number("q at the end [Pa]", last.whole.q());
  summary.number("largest q [Pa]", extremes.q);
  summary.number("axial strain at the end [-]", last.whole.axial_strain());
  summary.number("volumetric strain at the end [-]", extremes.volumetric_strain);
  summary.number("void ratio at the end [-]", extremes.void_ratio);
  summary.number("membrane penetration at the end [-]", extremes.penetration);
  summary.number("own load of the membrane [-]", extremes.own_load);
  summary.number("largest difference of the platens over the largest q [-]",
                 extremes.platen_difference);
  summary.number("largest stretch of the membrane [-]", extremes.stretch);
  summary.count("bonds broken [-]", last.analysed.broken);
  summary.number("largest energy error [-]", extremes.energy_error);
  add_alarm(summary, test.state().alarm);
  summary.number("largest strain rate [1/s]", test.state().largest_rate);
  summary.number("largest inertial number [-]", extremes.inertial_number);
  summary.count("rates cut at their limit [-]", test.state().n_limited);
  summary.count("particles [-]", system.assembly.particles.size());
  summary.count("steps [-]", system.n_steps);
  add_step(summary, system.stable_step, system.dt);
  if (test.has_membrane()) {
    summary.count("steps from kick to kick by the membrane's own forces [-]",
                  test.membrane().subcycle().n);
    summary.number("limit of these steps [-]", test.membrane().subcycle().limit);
  }
  add_mass_scaling(summary, system.assembly.particles);
  summary.number("wall-clock time [s]", work.seconds);

  std::ostream& out = summary.closing;
  out.precision(4);
  out << "at the end: p " << 1e-6 * last.whole.p() << ", q " << 1e-6 * last.whole.q()
      << " MPa, volumetric strain of the middle third "
      << 100.0 * extremes.volumetric_strain << " %, e " << extremes.void_ratio;
  if (!c.specimen.is_granular()) out << ", " << last.analysed.broken << " bonds broken";
  out << '\n';
  if (test.has_membrane()) {
    out << "membrane: penetration " << 100.0 * extremes.penetration
        << " % of the volume, largest stretch " << extremes.stretch << ", own load "
        << 100.0 * extremes.own_load << " % of the largest q or cell pressure"
        << (extremes.own_load > 0.02 ? " (above 2 %: q is corrected for it)" : "") << '\n';
  }
  out << servo_text(test.state().n_limited, system.n_steps) << "platen forces differ by "
      << 100.0 * extremes.platen_difference
      << " % of the largest q at most; largest energy error " << extremes.energy_error
      << " of the work; strain rate up to " << test.state().largest_rate
      << " 1/s, inertial number up to " << extremes.inertial_number << "\ntime step "
      << system.dt << " s, ruled by " << dem::what_rules(system.stable_step) << '\n'
      << time_by_parts(system, work, test.has_membrane() ? "membrane" : "platens")
      << "whole run " << duration_text(work.seconds);
}

} // namespace mergel::apps
