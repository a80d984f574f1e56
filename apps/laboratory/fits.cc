#include "apps/laboratory/fits.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace mergel::apps {

namespace {

/// Pressures that differ by less than this share of the larger are one.
constexpr double same_pressure = 0.05;
constexpr double degree = dem::pi / 180.0;
/// Volumetric over axial strain rate at which the volume is still steady [-].
constexpr double steady_volume = 0.1;

std::size_t n_pressures(const std::vector<TestReading>& tests,
                        const std::vector<std::size_t>& chosen)
{
  std::vector<double> pressures;
  for (const std::size_t k : chosen)
    pressures.push_back(tests[k].kind == TestKind::unconfined ? 0.0 : tests[k].confinement);
  std::sort(pressures.begin(), pressures.end());
  std::size_t n = pressures.empty() ? 0 : 1;
  for (std::size_t k = 1; k < pressures.size(); ++k)
    if (pressures[k] - pressures[k - 1] > same_pressure * pressures[k]) ++n;
  return n;
}

/// @param reason why a test is left out; empty: it is not
template <class Reason>
Selection select(const std::vector<TestReading>& tests, std::size_t n_needed,
                 const std::string& what, Reason&& reason)
{
  Selection s;
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const std::string why = reason(tests[k]);
    if (why.empty())
      s.tests.push_back(k);
    else
      s.left_out.push_back(tests[k].label + ": " + why);
  }
  const std::size_t n = n_pressures(tests, s.tests);
  if (n < n_needed)
    s.why_not = what + " at " + std::to_string(n) + " confining pressure" +
                (n == 1 ? "" : "s") + "; " + (n_needed == 2 ? "two" : "three") +
                " are needed";
  return s;
}

/// None where the strength falls with the pressure beyond what the scatter may do.
void set_line(StrengthFit& fit)
{
  fit.line = dem::coulomb_line(fit.circles);
  const double error =
      fit.line && std::isfinite(fit.line->phi_error) ? fit.line->phi_error : 0.0;
  if (fit.line && fit.line->phi > -2.0 * error) return;
  fit.line.reset();
  fit.of.why_not = "the strength falls with the confining pressure";
}

std::string with_error(double value, double error, const std::string& unit)
{
  char text[80];
  if (error > 0.0) { // two digits of the error, and the value to the same place
    const auto places = static_cast<int>(1.0 - std::floor(std::log10(error)));
    std::snprintf(text, sizeof text, "%.*f +- %.*f", std::clamp(places, 0, 9), value,
                  std::clamp(places, 0, 9), error);
  } else {
    std::snprintf(text, sizeof text, "%.4g", value);
  }
  return text + (unit.empty() ? "" : " " + unit);
}

} // namespace

std::optional<double> StrengthFit::R2() const
{
  if (!line || circles.size() < 3) return {};
  return line->R2;
}

std::string StrengthFit::caution() const
{
  if (!line || std::abs(volume_rate) <= steady_volume) return "";
  char text[120];
  std::snprintf(
      text, sizeof text,
      "caution: the volume still changes by %.2g of the axial strain, so this is no "
      "critical state yet",
      volume_rate);
  return text;
}

StrengthFit peak_strength(const std::vector<TestReading>& tests)
{
  StrengthFit fit;
  fit.of = select(tests, 2, "peaks of q", [](const TestReading& t) -> std::string {
    if (!t.is_sheared()) return "not sheared";
    if (!t.peak) return "q falls from no peak by a tenth";
    const bool is_collapse = t.kind == TestKind::triaxial && t.end.p > 0.0 &&
                             t.peak->q / t.peak->p < t.end.q / t.end.p;
    return is_collapse ? "collapse: q/p is smaller at the peak than at the end" : "";
  });
  for (const std::size_t k : fit.of.tests) fit.circles.push_back(tests[k].peak->circle());
  if (!fit.of.why_not.empty()) return fit;
  set_line(fit);
  return fit;
}

StrengthFit critical_strength(const std::vector<TestReading>& tests)
{
  StrengthFit fit;
  fit.of = select(tests, 2, "critical states",
                  [](const TestReading& t) { return t.not_critical; });
  for (const std::size_t k : fit.of.tests) {
    fit.circles.push_back(tests[k].end.circle());
    if (std::abs(tests[k].volume_rate) > std::abs(fit.volume_rate))
      fit.volume_rate = tests[k].volume_rate;
  }
  if (!fit.of.why_not.empty()) return fit;
  set_line(fit);
  return fit;
}

CriticalFit critical_states_of(const std::vector<TestReading>& tests)
{
  CriticalFit fit;
  fit.of = select(tests, 3, "critical states",
                  [](const TestReading& t) { return t.not_critical; });
  if (!fit.of.why_not.empty()) return fit;
  std::vector<dem::CriticalState> states;
  std::vector<double> p, q, rates;
  for (const std::size_t k : fit.of.tests) {
    const StressState& end = tests[k].end;
    states.push_back({end.p, end.q, end.e});
    p.push_back(end.p);
    q.push_back(end.q);
    rates.push_back(tests[k].volume_rate);
  }
  const auto [low, high] = std::minmax_element(rates.begin(), rates.end());
  fit.volume_rates = {*low, *high};
  fit.line = dem::critical_state_line(states);
  fit.ratio = dem::stress_ratio(p, q);
  return fit;
}

std::string in_words(const dem::CoulombLine& line)
{
  return "c = " + with_error(1e-6 * line.c, 1e-6 * line.c_error, "MPa") +
         ", phi = " + with_error(line.phi / degree, line.phi_error / degree, "degrees");
}

std::string in_words(const dem::StraightLine& line)
{
  char R2[40];
  std::snprintf(R2, sizeof R2, ", R2 = %.4f", line.R2);
  return "e = " + with_error(line.intercept, std::sqrt(line.intercept_variance), "") +
         " - (" + with_error(-line.slope, std::sqrt(line.slope_variance), "") +
         ") (p/p_a)^0.7" + R2;
}

std::string in_words(const dem::StressRatio& ratio)
{
  return "q/p = " + with_error(ratio.M, ratio.M_error, "") + ", phi = " +
         with_error(dem::friction_angle_of_ratio(ratio.M) / degree, no_value, "degrees");
}

std::string volume_in_words(const CriticalFit& fit)
{
  char text[80];
  std::snprintf(text, sizeof text,
                "volume still changes by %.2g to %.2g of the axial strain",
                fit.volume_rates[0], fit.volume_rates[1]);
  return text;
}

} // namespace mergel::apps
