#include "apps/element/element_output.h"

#include "apps/laboratory/test_reading.h"
#include "apps/run/progress.h"
#include "apps/run/restart.h"
#include "apps/run/step_report.h"
#include "dem/text.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mergel::apps {

namespace {

const std::vector<std::string> columns{
    "time [s]",
    "stage [-]",
    "part [-]",
    "cycle [-]",
    "axial strain [-]",
    "lateral strain [-]",
    "volumetric strain [-]",
    "axial strain of the stage [-]",
    "volumetric strain of the stage [-]",
    "controlled strain of the stage [-]",
    "strain x [-]",
    "strain y [-]",
    "axial stress [Pa]",
    "lateral stress x [Pa]",
    "lateral stress y [Pa]",
    "p [Pa]",
    "q [Pa]",
    "axial traction on the faces [Pa]",
    "lateral traction on the faces [Pa]",
    "antisymmetric part of the stress [-]",
    "void ratio [-]",
    "porosity [-]",
    "broken bonds [-]",
    "broken in tension [-]",
    "broken in compression [-]",
    "broken in shear [-]",
    "broken in bending [-]",
    "Z of bonds [-]",
    "Z of contacts [-]",
    "bond fabric xx [-]",
    "bond fabric yy [-]",
    "bond fabric zz [-]",
    "contact fabric xx [-]",
    "contact fabric yy [-]",
    "contact fabric zz [-]",
    "bond fabric xy [-]",
    "bond fabric xz [-]",
    "bond fabric yz [-]",
    "contact fabric xy [-]",
    "contact fabric xz [-]",
    "contact fabric yz [-]",
    "stress xy [Pa]",
    "stress xz [Pa]",
    "stress yz [Pa]",
    "elastic energy of bonds [J]",
    "elastic energy of contacts [J]",
    "kinetic energy [J]",
    "bond plasticity and damage [J]",
    "energy released at bond breakage [J]",
    "friction [J]",
    "damping [J]",
    "rotation-constraint loss [J]",
    "boundary work [J]",
    "energy error [-]",
    "time step [s]",
    "stable step [s]",
    "inertial number [-]",
    "unbalanced-force ratio [-]",
};

double count(std::size_t n)
{
  return static_cast<double>(n);
}

} // namespace

ElementHistory::ElementHistory(const std::filesystem::path& file) : history_(file, columns)
{
}

namespace {

dem::HistoryMark mark_in(const dem::State& state)
{
  const auto& mark = state.get_rows<std::uint64_t>("output_history", 2);
  return {mark[0], mark[1]};
}

} // namespace

ElementHistory::ElementHistory(const std::filesystem::path& file,
                               const std::filesystem::path& earlier,
                               const dem::State& state)
    : history_(file, columns, earlier, mark_in(state))
{
}

void ElementHistory::save(dem::State& state, const ElementHistory* history)
{
  const dem::HistoryMark mark = history ? history->history_.mark() : dem::HistoryMark{};
  state.add_common<std::uint64_t>("output_history", {mark.bytes, mark.sum});
}

std::string ElementHistory::check(const std::filesystem::path& file,
                                  const dem::State& state)
{
  return report_on_history(file, mark_in(state));
}

void ElementHistory::add(const dem::ElementRecord& r, const StageLabel& stage)
{
  const dem::CellAverages& a = r.averages;
  const dem::EnergyBalance& e = r.balance;
  const dem::Mat3 &b = a.bond_fabric, &k = a.contact_fabric;
  history_.add({r.time,
                count(stage.number),
                static_cast<double>(stage.part),
                count(stage.cycle),
                r.whole.axial_strain(),
                r.whole.lateral_strain(),
                r.whole.volumetric_strain(),
                r.of_stage.axial_strain(),
                r.of_stage.volumetric_strain(),
                r.controlled_strain,
                r.whole.strain.x(),
                r.whole.strain.y(),
                -a.stress(2, 2),
                -a.stress(0, 0),
                -a.stress(1, 1),
                r.whole.p(),
                r.whole.q(),
                -a.traction.z(),
                -0.5 * (a.traction.x() + a.traction.y()),
                a.antisymmetric,
                a.void_ratio,
                a.porosity,
                count(r.broken),
                count(r.broken_by[0]),
                count(r.broken_by[1]),
                count(r.broken_by[2]),
                count(r.broken_by[3]),
                a.bond_coordination,
                a.contact_coordination,
                b(0, 0),
                b(1, 1),
                b(2, 2),
                k(0, 0),
                k(1, 1),
                k(2, 2),
                b(0, 1),
                b(0, 2),
                b(1, 2),
                k(0, 1),
                k(0, 2),
                k(1, 2),
                -a.stress(0, 1),
                -a.stress(0, 2),
                -a.stress(1, 2),
                e.bonds,
                e.contacts,
                e.kinetic,
                e.plastic,
                e.breakage_release,
                e.slip,
                e.damping,
                e.rotation_constraint,
                e.cell_work,
                r.energy_error,
                r.time_step,
                r.stable_step,
                r.inertial_number,
                r.unbalanced});
}

std::vector<StagePoint> points_of(const std::vector<dem::ElementRecord>& records)
{
  std::vector<StagePoint> points;
  for (const dem::ElementRecord& r : records)
    points.push_back({r.stage, r.is_approach, r.controlled_strain, r.of_stage, r.broken});
  return points;
}

CriticalStates critical_states(const ElementCase& c, const dem::ElementRecord& last)
{
  CriticalStates all{c.critical_states, {}};
  all.states.push_back({last.whole.p(), last.whole.q(), last.averages.void_ratio});
  all.line = dem::critical_state_line(all.states);
  return all;
}

namespace {

void add_figures(Summary& to, const ElementSummary& s)
{
  to.number("p at the end [Pa]", s.last.whole.p());
  to.number("q at the end [Pa]", s.last.whole.q());
  to.number("void ratio at the end [-]", s.last.averages.void_ratio);
  if (s.critical.line) {
    to.count("critical states fitted [-]", s.critical.states.size());
    to.number("critical state line Gamma [-]", s.critical.line->intercept);
    to.number("critical state line lambda [-]", -s.critical.line->slope);
    to.number("critical state line R2 [-]", s.critical.line->R2);
  }
  to.count("bonds broken [-]", s.last.broken);
  const char* modes[] = {"tension", "compression", "shear", "bending"};
  for (std::size_t k = 0; k < dem::n_break_modes; ++k)
    to.count(std::string("broken in ") + modes[k] + " [-]", s.last.broken_by[k]);
  to.number("boundary work [J]", s.last.balance.cell_work);
  to.number("largest energy error [-]", s.worst_energy_error);
  add_alarm(to, s.alarm);
  to.number("largest strain rate [1/s]", s.largest_rate);
  to.number("largest inertial number [-]", s.largest_inertial_number);
  to.count("rates cut at their limit [-]", s.n_limited);
  to.count("particles [-]", s.n_particles);
  to.count("steps [-]", s.n_steps);
  add_step(to, s.stable_step, s.dt);
  add_mass_scaling(to, *s.particles);
  to.number("wall-clock time [s]", s.seconds);
}

} // namespace

void summarise(Summary& summary, const ElementCase& c, const ElementSummary& s)
{
  summarise(summary, s.stages, c.analysis);
  add_figures(summary, s);
  std::ostream& out = summary.closing;
  out.precision(4);
  out << "at the end: p " << 1e-6 * s.last.whole.p() << ", q " << 1e-6 * s.last.whole.q()
      << " MPa, e " << s.last.averages.void_ratio;
  if (!c.specimen.is_granular())
    out << ", " << s.last.broken << " bonds broken (" << s.last.broken_by[0]
        << " in tension, " << s.last.broken_by[1] << " compression, " << s.last.broken_by[2]
        << " shear, " << s.last.broken_by[3] << " bending)";
  out << '\n';
  if (s.critical.line)
    out << "critical states of " << s.critical.states.size()
        << " runs: e = " << s.critical.line->intercept << " - " << -s.critical.line->slope
        << " (p/p_a)^0.7, R2 " << s.critical.line->R2 << '\n';
  if (const double strain = s.last.of_stage.axial_strain();
      s.critical.line && strain < critical_strain)
    out << "unusual: the last state of this run is one of them, no critical state: it ends "
           "at "
        << 100.0 * strain << " % of axial strain, before " << 100.0 * critical_strain
        << " %\n";
  out << servo_text(s.n_limited, s.n_steps) << "largest energy error "
      << s.worst_energy_error << " of the work; strain rate up to " << s.largest_rate
      << " 1/s, inertial number up to " << s.largest_inertial_number;
  out << "\ntime step " << s.dt << " s, ruled by " << dem::what_rules(s.stable_step) << '\n'
      << s.n_particles << " particles, " << s.n_steps << " steps, "
      << 1e9 * s.seconds / static_cast<double>(s.n_steps * s.n_particles)
      << " ns per particle and step, whole run " << duration_text(s.seconds);
}

} // namespace mergel::apps
