#include "apps/element/element_output.h"

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

void ElementHistory::add(const dem::ElementRecord& r)
{
  const dem::CellAverages& a = r.averages;
  const dem::EnergyBalance& e = r.balance;
  const dem::Mat3 &b = a.bond_fabric, &k = a.contact_fabric;
  history_.add({r.time,
                count(r.stage + 1),
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

namespace {

/// Curve of a stage for the analysis: its records and those of the stages that resume it,
/// without the approach and without the loops of unloading and reloading.
class Backbone {
public:
  Backbone(const std::vector<dem::ElementRecord>& records, std::size_t first,
           std::size_t last)
  {
    for (const dem::ElementRecord& r : records) {
      if (r.stage < first || r.stage > last || r.is_approach) continue;
      if (r.stage == first) direction_ = r.controlled_strain < 0.0 ? -1.0 : 1.0;
    }
    double largest_progress = -1.0;
    for (const dem::ElementRecord& r : records) {
      if (r.stage < first || r.stage > last || r.is_approach) continue;
      if (direction_ * r.controlled_strain <= largest_progress) continue;
      largest_progress = direction_ * r.controlled_strain;
      states_.push_back(r.of_stage);
    }
  }

  bool is_empty() const { return states_.empty(); }
  double direction() const { return direction_; } ///< 1 compression, -1 extension
  const std::vector<dem::SoilState>& states() const { return states_; }

  /// Strain and stress, both with the sign changed in extension.
  template <class Strain, class Stress>
  dem::Curve curve(Strain&& strain, Stress&& stress) const
  {
    dem::Curve c;
    for (const dem::SoilState& s : states_) {
      c.strain.push_back(direction_ * strain(s));
      c.stress.push_back(direction_ * stress(s));
    }
    return c;
  }

private:
  double direction_ = 1.0;
  std::vector<dem::SoilState> states_;
};

/// Names of the results of one curve.
struct CurveNames {
  const char *modulus, *yield, *peak;
};

void read_off(std::vector<Finding>& found, const ElementCase& c, const dem::Curve& curve,
              const CurveNames& names)
{
  const auto E = dem::secant(curve, c.secant_from, c.secant_to);
  if (E) found.push_back({names.modulus, "Pa", *E});
  if (!(dem::peak(curve).stress > 0.0)) return; // unloading: no strength
  if (E) {
    if (const auto y = dem::offset_yield(curve, *E, c.yield_offset, c.secant_from)) {
      found.push_back({names.yield, "Pa", y->stress});
      found.push_back({"strain at yield", "-", y->strain});
    }
  }
  const dem::CurvePoint top = dem::peak(curve);
  found.push_back({names.peak, "Pa", top.stress});
  found.push_back({"strain there", "-", top.strain});
  if (const auto first = dem::first_collapse(curve, 0.02);
      first && first->stress < top.stress)
    found.push_back({"first peak before a collapse", "Pa", first->stress});
  const dem::CurvePoint low = dem::minimum_after_peak(curve);
  if (low.stress < 0.98 * top.stress)
    found.push_back({"minimum after the peak", "Pa", low.stress});
}

using State = const dem::SoilState&;
double axial_strain(State s)
{
  return s.axial_strain();
}
double volumetric_strain(State s)
{
  return s.volumetric_strain();
}
double axial_stress(State s)
{
  return s.axial();
}
double deviator(State s)
{
  return s.q();
}
double mean_pressure(State s)
{
  return s.p();
}

void read_poisson(std::vector<Finding>& found, const ElementCase& c, const Backbone& stage)
{
  const auto swelling =
      stage.curve(axial_strain, [](State s) { return -s.lateral_strain(); });
  if (const auto nu = dem::secant(swelling, c.secant_from, c.secant_to))
    found.push_back({"Poisson's ratio", "-", *nu});
}

/// In extension q and q/p are negative. States with p below 1 % of its largest value are
/// left out, and so is the friction angle of a state in tension, which cohesion bears.
void read_stress_ratio(std::vector<Finding>& found, const Backbone& stage)
{
  double eta_peak = 0.0, p_most = 0.0;
  for (const dem::SoilState& s : stage.states()) p_most = std::max(p_most, s.p());
  for (const dem::SoilState& s : stage.states())
    if (s.p() > 0.01 * p_most && std::abs(s.q() / s.p()) > std::abs(eta_peak))
      eta_peak = s.q() / s.p();
  found.push_back({"largest q/p", "-", eta_peak});
  const dem::SoilState& end = stage.states().back();
  if (!(end.p() > 0.01 * p_most)) return;
  found.push_back({"q/p at the end", "-", end.q() / end.p()});
  if (end.stress.minCoeff() >= 0.0) // p > 0
    found.push_back({"friction angle at the end", "degree",
                     dem::friction_angle(end.stress) * 180.0 / dem::pi});
}

void read_resumed(std::vector<Finding>& found,
                  const std::vector<dem::ElementRecord>& records, std::size_t stage)
{
  const auto is_of = [&](const dem::ElementRecord& r) { return r.stage == stage; };
  const auto first = std::find_if(records.begin(), records.end(), is_of);
  const auto last = std::find_if(records.rbegin(), records.rend(), is_of);
  if (first == records.end()) return;
  const dem::SoilState &a = first->of_stage, &b = last->of_stage;
  if (a.axial_strain() != b.axial_strain())
    found.push_back({"secant modulus of the stage", "Pa",
                     (b.axial() - a.axial()) / (b.axial_strain() - a.axial_strain())});
}

std::optional<std::size_t>
broken_in_approach(const std::vector<dem::ElementRecord>& records, std::size_t stage)
{
  const auto is_of = [&](const dem::ElementRecord& r) { return r.stage == stage; };
  const auto first = std::find_if(records.begin(), records.end(), is_of);
  if (first == records.end() || !first->is_approach) return {};
  auto last = first; // the first record after the approach, if it ends
  while (last->is_approach && last + 1 != records.end() && is_of(*(last + 1))) ++last;
  return last->broken - first->broken;
}

void read_path(std::vector<Finding>& found, const ElementCase& c,
               const dem::LoadingStage& stage, const Backbone& way)
{
  const bool is_extension = way.direction() < 0.0;
  switch (stage.kind) {
  case dem::PathKind::isotropic:
    read_off(found, c, way.curve(volumetric_strain, mean_pressure),
             {"bulk modulus", "isotropic yield", "largest p"});
    break;
  case dem::PathKind::oedometer:
    read_off(found, c, way.curve(axial_strain, axial_stress),
             {"constrained modulus", "oedometric yield", "largest axial stress"});
    break;
  case dem::PathKind::compression:
    read_off(found, c, way.curve(axial_strain, axial_stress),
             {"Young's modulus", "yield stress", "UCS"});
    read_poisson(found, c, way);
    break;
  case dem::PathKind::tension:
    read_off(found, c, way.curve(axial_strain, axial_stress),
             {"Young's modulus", "yield stress in tension", "tensile strength"});
    break;
  case dem::PathKind::triaxial:
    read_off(found, c, way.curve(axial_strain, deviator),
             is_extension
                 ? CurveNames{"Young's modulus", "-q at yield in extension", "largest -q"}
                 : CurveNames{"Young's modulus", "q at yield", "largest q"});
    read_poisson(found, c, way);
    read_stress_ratio(found, way);
    break;
  case dem::PathKind::radial: // p, or q where p is constant
    if (std::isinf(stage.slope))
      read_off(found, c, way.curve(axial_strain, deviator),
               {"dq over axial strain", "q at yield", "largest q"});
    else
      read_off(found, c, way.curve(volumetric_strain, mean_pressure),
               {"dp over volumetric strain", "p at yield", "largest p"});
    read_stress_ratio(found, way);
    break;
  case dem::PathKind::axes:
    for (int a = 0; a < 3; ++a)
      if (stage.axes[static_cast<std::size_t>(a)].kind ==
          dem::AxisRule::Kind::strain_controlled)
        read_off(found, c,
                 way.curve([a](State s) { return s.strain[a]; },
                           [a](State s) { return s.stress[a]; }),
                 {"modulus along the strain-controlled axis", "stress at yield",
                  "largest stress"});
    read_stress_ratio(found, way);
    break;
  case dem::PathKind::resume:
    break; // read_resumed()
  }
}

} // namespace

std::vector<StageResult> analyse(const ElementCase& c,
                                 const std::vector<dem::Outcome>& outcomes,
                                 const std::vector<dem::ElementRecord>& records)
{
  std::vector<StageResult> results;
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    const dem::LoadingStage& stage = c.stages[k];
    StageResult result{name_of(stage), outcomes[k], broken_in_approach(records, k), {}};
    if (stage.kind == dem::PathKind::resume) {
      read_resumed(result.findings, records, k);
    } else {
      std::size_t last = k;
      while (last + 1 < outcomes.size() && c.stages[last + 1].kind == dem::PathKind::resume)
        ++last;
      if (last > k)
        result.name += ", analysed with the stages up to " + std::to_string(last + 1);
      const Backbone way(records, k, last);
      if (!way.is_empty()) read_path(result.findings, c, stage, way);
    }
    results.push_back(std::move(result));
  }
  return results;
}

CriticalStates critical_states(const ElementCase& c, const dem::ElementRecord& last)
{
  CriticalStates all{c.critical_states, {}};
  all.states.push_back({last.whole.p(), last.whole.q(), last.averages.void_ratio});
  all.line = dem::critical_state_line(all.states);
  return all;
}

namespace {

std::string json_of(const std::vector<StageResult>& stages)
{
  std::string text = "[";
  const char* comma = "\n";
  for (const StageResult& stage : stages) {
    text += std::string(comma) + "    {\n      \"stage\": \"" + stage.name +
            "\",\n      \"outcome\": \"" + dem::sentence_of(stage.outcome) + "\"";
    if (stage.broken_in_approach)
      text += ",\n      \"bonds broken in the approach [-]\": " +
              std::to_string(*stage.broken_in_approach);
    for (const Finding& f : stage.findings)
      text += ",\n      \"" + f.name + " [" + f.unit + "]\": " + dem::shortest(f.value);
    text += "\n    }";
    comma = ",\n";
  }
  return text + "\n  ]";
}

void add_figures(Summary& to, const ElementCase& c, const ElementSummary& s)
{
  to.json("stages", json_of(s.stages));
  to.number("secant from [-]", c.secant_from);
  to.number("secant to [-]", c.secant_to);
  to.number("yield offset [-]", c.yield_offset);
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
  add_figures(summary, c, s);
  std::ostream& out = summary.closing;
  out.precision(4);
  for (std::size_t k = 0; k < s.stages.size(); ++k) {
    const StageResult& stage = s.stages[k];
    out << "stage " << k + 1 << ", " << stage.name << ": "
        << dem::sentence_of(stage.outcome);
    for (const Finding& f : stage.findings) {
      const bool is_stress = f.unit == "Pa";
      out << "; " << f.name << ' ' << (is_stress ? 1e-6 * f.value : f.value)
          << (is_stress       ? " MPa"
              : f.unit == "-" ? ""
                              : " " + f.unit);
    }
    out << '\n';
    if (stage.broken_in_approach.value_or(0) > 0)
      out << "stage " << k + 1 << ": " << *stage.broken_in_approach
          << " bonds broke in the approach to its stress, before its readings\n";
  }
  out << "at the end: p " << 1e-6 * s.last.whole.p() << ", q " << 1e-6 * s.last.whole.q()
      << " MPa, e " << s.last.averages.void_ratio << ", " << s.last.broken
      << " bonds broken (" << s.last.broken_by[0] << " in tension, " << s.last.broken_by[1]
      << " compression, " << s.last.broken_by[2] << " shear, " << s.last.broken_by[3]
      << " bending)\n";
  if (s.critical.line)
    out << "critical states of " << s.critical.states.size()
        << " runs: e = " << s.critical.line->intercept << " - " << -s.critical.line->slope
        << " (p/p_a)^0.7, R2 " << s.critical.line->R2 << '\n';
  out << "largest energy error " << s.worst_energy_error
      << " of the work; strain rate up to " << s.largest_rate
      << " 1/s, inertial number up to " << s.largest_inertial_number;
  if (s.n_limited > 0) out << "; " << s.n_limited << " rates were limited by the servo";
  out << "\ntime step " << s.dt << " s, ruled by " << dem::what_rules(s.stable_step) << '\n'
      << s.n_particles << " particles, " << s.n_steps << " steps, "
      << 1e9 * s.seconds / static_cast<double>(s.n_steps * s.n_particles)
      << " ns per particle and step, whole run " << duration_text(s.seconds);
}

} // namespace mergel::apps
