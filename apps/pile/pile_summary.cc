#include "apps/pile/pile_summary.h"

#include "apps/case/unusual.h"
#include "apps/coupled/time_by_parts.h"
#include "apps/run/progress.h"
#include "apps/run/step_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace mergel::apps {

std::size_t count_debris(const dem::Assembly& assembly, double collar_height)
{
  std::size_t n = 0;
  assembly.particles.for_owned(
      [&](dem::Index i) { n += assembly.particles.state[i].x.z() > collar_height; });
  return assembly.comm.global_sum(n);
}

namespace {

/// The pile read as a needle penetration test (Ngan-Tillard et al. 2011): head force over
/// penetration, in proportion to the area of the standard needle of 0.84 mm, and the UCS of its
/// usual correlation, 0.40 NPI^0.93 [MPa, N/mm]. These constants are from memory.
void add_needle_index(Summary& s, const PileRecord& r, double diameter)
{
  if (!(r.F_head > 0.0 && r.tip_depth > 0.0)) return;
  const double share = 0.84e-3 / diameter;
  const double index = 1e-3 * r.F_head / r.tip_depth * share * share;
  s.number("needle penetration index [N/mm]", index);
  s.number("UCS by the needle penetration index, from memory [Pa]",
           0.4e6 * std::pow(index, 0.93));
}

void add_figures(Summary& s, const PileCase& c, const Installation& run,
                 const coupling::CoupledSystem& coupled, std::size_t n_debris,
                 double seconds)
{
  const PileRecord& r = run.last();
  const BreakageCount& broken = run.breakage();
  s.number("D_p [m]", c.diameter);
  s.number("depth [m]", r.depth);
  s.number("tip depth [m]", r.tip_depth);
  s.count("pushes [-]", run.n_pushes());
  s.number("q_c [Pa]", r.q_c);
  s.number("largest q_c [Pa]", run.peak());
  s.number("tip force of the full pile [N]", r.F_tip);
  s.number("shaft force of the full pile [N]", r.F_shaft);
  s.count("stages done [-]", run.position().n_done);
  s.count("stages that ended at the bearing capacity [-]", run.n_at_capacity());
  s.number("head force of the full pile [N]", r.F_head);
  add_needle_index(s, r, c.diameter);
  s.number("lateral head force of the full pile [N]", r.F_lateral);
  s.number("lateral displacement of the head [m]", r.displacement);
  s.number("rotation of the head [rad]", r.rotation);
  s.number("largest overlap [-]", run.largest_overlaps().largest);
  s.count("most pairs that overlap by more than 0.3 [-]",
          run.largest_overlaps().beyond_mark);
  s.count("most pairs that overlap by more than 0.5 [-]",
          run.largest_overlaps().beyond_high_mark);
  s.count("bonds [-]", run.n_bonds());
  s.count("bonds broken [-]", r.broken);
  s.count("bonds between particles [-]", run.n_between());
  s.count("broken between particles [-]", broken.all);
  s.count("broken within 2 D_p of the axis [-]", broken.near);
  s.count("broken more than D_p above the shoulder [-]", broken.above);
  s.count("broken below the shoulder within 2 D_p of the tip [-]", broken.at_tip);
  s.count("broken above the shoulder away from the shaft [-]", broken.away);
  s.count("particles above the collar [-]", n_debris);
  s.number("largest energy error [-]", run.worst_energy_error());
  add_alarm(s, run.energy_alarm());
  s.number("largest interface force error [-]", run.worst_interface().force);
  s.number("largest interface moment error [-]", run.worst_interface().moment);
  s.number("largest interface power error [-]", run.worst_interface().power);
  s.count("particles [-]", coupled.assembly.particles.size());
  s.count("far-field cells [-]", far_field_of(coupled).n_cells());
  s.count("steps [-]", coupled.n_steps);
  add_step(s, coupled.stable_step, coupled.dt);
  const coupling::Structure& far_field = *coupled.structures.front().structure;
  if (far_field.moves()) {
    s.count("steps from kick to kick by the far field's own forces [-]",
            far_field.subcycle().n);
    s.number("limit of these steps [-]", far_field.subcycle().limit);
  }
  add_mass_scaling(s, coupled.assembly.particles);
  s.number("wall-clock time [s]", seconds);
}

/// How far the crushed zone is from the far field, which does not break.
void add_reach(Summary& s, const PileCase& c, double distance)
{
  if (!std::isfinite(distance)) return; // no bond has broken
  const dem::SpecimenSpec& spec = c.assembly.specimen;
  const double d_50 =
      spec.sizes.sieve(0.5) * std::max(spec.scale.S_inner, spec.scale.S_outer);
  s.number("distance of the outermost break from the far field [m]", distance);
  s.number("distance of the outermost break from the far field over D_p [-]",
           distance / c.diameter);
  s.number("distance of the outermost break from the far field over d50 there [-]",
           distance / d_50);
  s.closing << "the bond that broke closest to the far field was " << 1e3 * distance
            << " mm from it (" << distance / c.diameter << " D_p, " << distance / d_50
            << " d50 there)\n";
  Remarks remarks;
  expect_at_least(remarks, "distance of the outermost break from the far field/d50",
                  distance / d_50, 2.0,
                  "the crushed zone has reached the far field, which does not break; widen "
                  "`Specimen/diameter` or `Specimen/height`");
  s.closing << lines_of(remarks);
}

/// "; the far field's own forces act at every 2nd step (limit 2.04)".
std::string subcycle_text(const coupling::Structure& far_field)
{
  if (!far_field.moves()) return "";
  const auto subcycle = far_field.subcycle();
  constexpr std::array<const char*, 11> ordinals{"",    "",    "2nd", "3rd", "4th", "5th",
                                                 "6th", "7th", "8th", "9th", "10th"};
  std::ostringstream text;
  text.precision(3);
  text << "; the far field's own forces act at every ";
  if (subcycle.n > 1) text << ordinals.at(subcycle.n) << ' ';
  text << "step (limit " << subcycle.limit << ')';
  return text.str();
}

} // namespace

void summarise(Summary& summary, const PileCase& c, const Installation& run,
               const coupling::CoupledSystem& coupled, const Work& work)
{
  const std::size_t n_debris = count_debris(coupled.assembly, c.assembly.collar_height);
  add_figures(summary, c, run, coupled, n_debris, work.seconds);
  const PileRecord& r = run.last();
  const BreakageCount& broken = run.breakage();
  const auto percent = [](std::size_t part, std::size_t whole) {
    return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
  };
  std::ostream& out = summary.closing;
  out.precision(4);
  out << "pile at " << 1e3 * r.depth << " mm (" << r.depth / c.diameter << " D_p): q_c "
      << 1e-6 * r.q_c << " MPa, largest " << 1e-6 * run.peak() << " MPa; tip " << r.F_tip
      << " N, shaft " << r.F_shaft << " N (full pile)\n";
  const dem::Overlaps& overlaps = run.largest_overlaps();
  if (c.has_stages())
    out << run.position().n_done << " loading stages; head force " << r.F_head
        << " N, lateral " << r.F_lateral << " N at " << 1e3 * r.displacement << " mm and "
        << 1e3 * r.rotation << " mrad (full pile)\n";
  if (overlaps.largest > dem::Overlaps::high_mark)
    out << "largest overlap of two particles " << overlaps.largest
        << " of the smaller radius; at most " << overlaps.beyond_high_mark
        << " pairs beyond " << dem::Overlaps::high_mark << " at a time\n";
  if (run.n_pushes() > 1)
    out << "the pile was pushed " << run.n_pushes()
        << " times, and slowed down at the end of each push\n";
  out << "bonds broken: " << r.broken << " of " << run.n_bonds() << ", " << broken.all
      << " of them between particles: " << percent(broken.near, broken.all)
      << " % within 2 D_p of the axis; when they broke, "
      << percent(broken.at_tip, broken.all)
      << " % below the shoulder within 2 D_p of the tip, " << broken.above
      << " more than D_p above the shoulder, " << broken.away
      << " above the shoulder away from the shaft; " << n_debris
      << " particles are above the collar\n";
  add_reach(summary, c, broken.to_far_field);
  out << "largest energy error " << 100.0 * run.worst_energy_error()
      << " % of the input; largest interface errors " << run.worst_interface().force
      << " (force), " << run.worst_interface().moment << " (moment), "
      << run.worst_interface().power << " (power)\n"
      << "time step " << coupled.dt << " s, ruled by "
      << dem::what_rules(coupled.stable_step)
      << subcycle_text(*coupled.structures.front().structure) << '\n'
      << time_by_parts(coupled, work, "far field") << "whole run "
      << duration_text(work.seconds);
}

} // namespace mergel::apps
