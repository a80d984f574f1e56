#include "apps/element/stage_analysis.h"

#include "apps/case/words.h"
#include "dem/element/element_analysis.h"
#include "dem/text.h"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace mergel::apps {

void declare(CaseFile& file, AnalysisKeys& keys)
{
  file.number(
      "secant from", keys.secant_from, non_negative,
      "Strain of the stage at which the secant for moduli and Poisson's ratio starts.");
  file.number("secant to", keys.secant_to, positive, "Strain at which it ends.");
  file.number("yield offset", keys.yield_offset, positive,
              "Strain by which the secant line is offset for the yield point.");
}

void check(const CaseFile& file, const AnalysisKeys& keys)
{
  if (keys.secant_to <= keys.secant_from)
    file.refuse("Analysis", "secant to", "must be beyond `secant from`");
}

namespace {

/// Difference of controlled strains below which two records are at one strain: the first record
/// of a stage is at that of the last one of the stage before [-].
constexpr double round_off = 1e-12;

/// Curve of a stage for the analysis: its records and those of the stages that resume it,
/// without the approach and without the loops of unloading and reloading.
class Backbone {
public:
  Backbone(const std::vector<StagePoint>& points, std::size_t first, std::size_t last)
  {
    for (const StagePoint& p : points) {
      if (p.stage < first || p.stage > last || p.is_approach) continue;
      if (p.stage == first) direction_ = p.controlled_strain < 0.0 ? -1.0 : 1.0;
    }
    double largest_progress = -1.0;
    bool is_in_loop = false;
    for (const StagePoint& p : points) {
      if (p.stage < first || p.stage > last || p.is_approach) continue;
      const double progress = direction_ * p.controlled_strain;
      if (progress <= largest_progress) {
        is_in_loop = is_in_loop || progress < largest_progress - round_off;
        continue;
      }
      if (is_in_loop) loops_.push_back(states_.size());
      is_in_loop = false;
      largest_progress = progress;
      states_.push_back(p.of_stage);
    }
  }

  bool is_empty() const { return states_.empty(); }
  double direction() const { return direction_; } ///< 1 compression, -1 extension
  const std::vector<dem::SoilState>& states() const { return states_; }

  /// Strain and stress, both with the sign changed in extension.
  template <class Strain, class Stress>
  dem::Curve curve(Strain&& strain, Stress&& stress) const
  {
    dem::Curve c{{}, {}, loops_};
    for (const dem::SoilState& s : states_) {
      c.strain.push_back(direction_ * strain(s));
      c.stress.push_back(direction_ * stress(s));
    }
    return dem::without_reloading(c);
  }

private:
  double direction_ = 1.0;
  std::vector<dem::SoilState> states_;
  std::vector<std::size_t> loops_; ///< states before which there was a loop
};

/// Names of the results of one curve.
struct CurveNames {
  const char *modulus, *yield, *peak;
};

void read_off(std::vector<Finding>& found, const AnalysisKeys& keys,
              const dem::Curve& curve, const CurveNames& names)
{
  const auto E = dem::secant(curve, keys.secant_from, keys.secant_to);
  if (E) found.push_back({names.modulus, "Pa", *E});
  if (!(dem::peak(curve).stress > 0.0)) return; // unloading: no strength
  if (E) {
    if (const auto y = dem::offset_yield(curve, *E, keys.yield_offset, keys.secant_from)) {
      found.push_back({names.yield, "Pa", y->stress});
      found.push_back({"strain at yield", "-", y->strain});
    }
  }
  const dem::Drop largest = dem::largest_drop(curve);
  found.push_back({names.peak, "Pa", largest.peak.stress});
  found.push_back({"strain there", "-", largest.peak.strain});
  if (largest.minimum.stress < (1.0 - dem::smallest_fall) * largest.peak.stress)
    found.push_back(
        {std::string("minimum after the ") + names.peak, "Pa", largest.minimum.stress});
  const auto first = dem::first_drop(curve, dem::smallest_fall);
  if (!first || !(first->peak.strain < largest.peak.strain)) return;
  found.push_back({"first peak before a collapse", "Pa", first->peak.stress});
  found.push_back({"minimum after the first peak", "Pa", first->minimum.stress});
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

void read_poisson(std::vector<Finding>& found, const AnalysisKeys& keys,
                  const Backbone& stage)
{
  const auto swelling =
      stage.curve(axial_strain, [](State s) { return -s.lateral_strain(); });
  if (const auto nu = dem::secant(swelling, keys.secant_from, keys.secant_to))
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

void read_resumed(std::vector<Finding>& found, const std::vector<StagePoint>& points,
                  std::size_t stage)
{
  const auto is_of = [&](const StagePoint& p) { return p.stage == stage; };
  const auto first = std::find_if(points.begin(), points.end(), is_of);
  const auto last = std::find_if(points.rbegin(), points.rend(), is_of);
  if (first == points.end()) return;
  const dem::SoilState &a = first->of_stage, &b = last->of_stage;
  if (a.axial_strain() == b.axial_strain()) return;
  const double E = (b.axial() - a.axial()) / (b.axial_strain() - a.axial_strain());
  if (E > 0.0) found.push_back({"secant modulus of the stage", "Pa", E}); // else it softens
}

std::optional<std::size_t> broken_in_approach(const std::vector<StagePoint>& points,
                                              std::size_t stage)
{
  const auto is_of = [&](const StagePoint& p) { return p.stage == stage; };
  const auto first = std::find_if(points.begin(), points.end(), is_of);
  if (first == points.end() || !first->is_approach) return {};
  auto last = first; // the first record after the approach, if it ends
  while (last->is_approach && last + 1 != points.end() && is_of(*(last + 1))) ++last;
  return last->broken - first->broken;
}

/// Mean pressure at the offset yield of an approach that raises it: p over volumetric strain, both
/// from where the approach begins.
std::optional<double> yield_in_approach(const std::vector<StagePoint>& points,
                                        std::size_t stage, const AnalysisKeys& keys)
{
  dem::Curve c;
  const dem::SoilState* start = nullptr;
  for (const StagePoint& p : points) {
    if (p.stage != stage || !p.is_approach) continue;
    if (!start) start = &p.of_stage;
    const double strain = p.of_stage.volumetric_strain() - start->volumetric_strain();
    if (!c.strain.empty() && strain <= c.strain.back()) continue; // waves
    c.strain.push_back(strain);
    c.stress.push_back(p.of_stage.p() - start->p());
  }
  const auto K = dem::secant(c, keys.secant_from, keys.secant_to);
  if (!K || !(*K > 0.0)) return {};
  const auto yield = dem::offset_yield(c, *K, keys.yield_offset, keys.secant_from);
  if (!yield) return {};
  return start->p() + yield->stress;
}

bool has_isotropic_yield(const StageResult& result)
{
  return std::any_of(result.findings.begin(), result.findings.end(),
                     [](const Finding& f) { return f.name == "isotropic yield"; });
}

void read_path(std::vector<Finding>& found, const AnalysisKeys& keys,
               const dem::LoadingStage& stage, const Backbone& way)
{
  const bool is_extension = way.direction() < 0.0;
  switch (stage.kind) {
  case dem::PathKind::isotropic:
    read_off(found, keys, way.curve(volumetric_strain, mean_pressure),
             {"bulk modulus", "isotropic yield", "largest p"});
    break;
  case dem::PathKind::oedometer:
    read_off(found, keys, way.curve(axial_strain, axial_stress),
             {"constrained modulus", "oedometric yield", "largest axial stress"});
    break;
  case dem::PathKind::compression:
    read_off(found, keys, way.curve(axial_strain, axial_stress),
             {"Young's modulus", "yield stress", "UCS"});
    read_poisson(found, keys, way);
    break;
  case dem::PathKind::tension:
    read_off(found, keys, way.curve(axial_strain, axial_stress),
             {"Young's modulus", "yield stress in tension", "tensile strength"});
    break;
  case dem::PathKind::triaxial:
    read_off(found, keys, way.curve(axial_strain, deviator),
             is_extension
                 ? CurveNames{"Young's modulus", "-q at yield in extension", "largest -q"}
                 : CurveNames{"Young's modulus", "q at yield", "largest q"});
    read_poisson(found, keys, way);
    read_stress_ratio(found, way);
    break;
  case dem::PathKind::radial: // p, or q where p is constant
    if (std::isinf(stage.slope))
      read_off(found, keys, way.curve(axial_strain, deviator),
               {"dq over axial strain", "q at yield", "largest q"});
    else
      read_off(found, keys, way.curve(volumetric_strain, mean_pressure),
               {"dp over volumetric strain", "p at yield", "largest p"});
    read_stress_ratio(found, way);
    break;
  case dem::PathKind::axes:
    for (int a = 0; a < 3; ++a)
      if (stage.axes[static_cast<std::size_t>(a)].kind ==
          dem::AxisRule::Kind::strain_controlled)
        read_off(found, keys,
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

std::vector<StageResult> analyse(const std::vector<dem::LoadingStage>& stages,
                                 const std::vector<StageLabel>& labels,
                                 const AnalysisKeys& keys,
                                 const std::vector<dem::Outcome>& outcomes,
                                 const std::vector<StagePoint>& points)
{
  std::vector<StageResult> results;
  std::string yielded; // number of the stage in which the specimen has yielded
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    const dem::LoadingStage& stage = stages[k];
    StageResult result{
        labels[k].name(), labels[k].text, outcomes[k], broken_in_approach(points, k), {}};
    result.yield_in_approach = yield_in_approach(points, k, keys);
    if (stage.kind != dem::PathKind::resume) result.yielded_before = yielded;
    if (result.yield_in_approach) yielded = result.number;
    if (stage.kind == dem::PathKind::resume) {
      read_resumed(result.findings, points, k);
    } else {
      std::size_t last = k;
      while (last + 1 < outcomes.size() && stages[last + 1].kind == dem::PathKind::resume)
        ++last;
      if (last > k)
        result.name += ", analysed with the stages up to " + labels[last].name();
      const Backbone way(points, k, last);
      if (!way.is_empty()) read_path(result.findings, keys, stage, way);
      if (has_isotropic_yield(result)) yielded = result.number;
    }
    results.push_back(std::move(result));
  }
  return results;
}

namespace {

std::string json_of(const std::vector<StageResult>& stages)
{
  std::string text = "[";
  const char* comma = "\n";
  for (const StageResult& stage : stages) {
    text += std::string(comma) + "    {\n      \"number\": " + in_json(stage.number) +
            ",\n      \"stage\": " + in_json(stage.name) +
            ",\n      \"outcome\": " + in_json(dem::sentence_of(stage.outcome));
    if (stage.broken_in_approach)
      text += ",\n      \"bonds broken in the approach [-]\": " +
              std::to_string(*stage.broken_in_approach);
    if (stage.yield_in_approach)
      text += ",\n      \"p at yield in the approach [Pa]\": " +
              number_in_json(*stage.yield_in_approach);
    if (!stage.yielded_before.empty())
      text += ",\n      \"yielded before in stage\": " + in_json(stage.yielded_before);
    for (const Finding& f : stage.findings)
      text += ",\n      \"" + f.name + " [" + f.unit + "]\": " + number_in_json(f.value);
    text += "\n    }";
    comma = ",\n";
  }
  return text + "\n  ]";
}

} // namespace

std::string servo_text(std::size_t n_limited, std::size_t n_steps)
{
  if (n_limited == 0) return "";
  return "the servo reached its largest rate " + std::to_string(n_limited) + " times in " +
         std::to_string(n_steps) + " steps: there a stress was not what it should be\n";
}

void summarise(Summary& summary, const std::vector<StageResult>& stages,
               const AnalysisKeys& keys)
{
  summary.json("stages", json_of(stages));
  summary.number("secant from [-]", keys.secant_from);
  summary.number("secant to [-]", keys.secant_to);
  summary.number("yield offset [-]", keys.yield_offset);
  std::ostream& out = summary.closing;
  out.precision(4);
  for (const StageResult& stage : stages) {
    out << "stage " << stage.number << ", " << stage.name << ": "
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
      out << "stage " << stage.number << ": " << *stage.broken_in_approach
          << " bonds broke in the approach to its stress, before its readings\n";
    if (stage.yield_in_approach)
      out << "stage " << stage.number
          << ": the specimen yielded in the approach to its stress, at p "
          << 1e-6 * *stage.yield_in_approach << " MPa, before its readings\n";
    if (!stage.yielded_before.empty())
      out << "stage " << stage.number << ": the specimen had yielded before, in stage "
          << stage.yielded_before << "\n";
  }
}

} // namespace mergel::apps
