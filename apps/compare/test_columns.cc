#include "apps/compare/test_columns.h"

namespace mergel::apps {

namespace {

using Test = const TestReading&;
constexpr double MPa = 1e6, GPa = 1e9, percent = 0.01;

double p_of(const std::optional<StressState>& s)
{
  return s ? s->p : no_value;
}
double q_of(const std::optional<StressState>& s)
{
  return s ? s->q : no_value;
}

} // namespace

const std::vector<TestColumn>& test_columns()
{
  static const std::vector<TestColumn> columns{
      {"confining pressure", "Pa", "sigma_3", "MPa", MPa,
       [](Test t) { return t.confinement; }},
      {"Young's modulus", "Pa", "E", "GPa", GPa, [](Test t) { return t.E; }},
      {"Poisson's ratio", "-", "nu", "-", 1.0, [](Test t) { return t.nu; }},
      {"bulk modulus", "Pa", "K", "GPa", GPa, [](Test t) { return t.K; }},
      {"constrained modulus", "Pa", "M", "GPa", GPa, [](Test t) { return t.M; }},
      {"tensile strength", "Pa", "tension", "MPa", MPa,
       [](Test t) { return t.tensile_strength; }},
      {"largest 2P/(pi D t)", "Pa", "2P/piDt", "MPa", MPa,
       [](Test t) { return t.brazilian_strength; }},
      {"p at yield", "Pa", "p yield", "MPa", MPa, [](Test t) { return p_of(t.yield); }},
      {"q at yield", "Pa", "q yield", "MPa", MPa, [](Test t) { return q_of(t.yield); }},
      {"axial stress at yield", "Pa", "sigma_a yield", "MPa", MPa,
       [](Test t) {
         return t.yield && t.kind == TestKind::oedometer ? t.yield->circle().sigma_1
                                                         : no_value;
       }},
      {"p at the peak", "Pa", "", "MPa", MPa, [](Test t) { return p_of(t.peak); }},
      {"q at the peak", "Pa", "q peak", "MPa", MPa, [](Test t) { return q_of(t.peak); }},
      {"axial strain at the peak", "-", "at", "%", percent,
       [](Test t) { return t.peak ? t.peak->strain : no_value; }},
      {"p at the minimum after the peak", "Pa", "", "MPa", MPa,
       [](Test t) { return p_of(t.minimum); }},
      {"q at the minimum after the peak", "Pa", "q min", "MPa", MPa,
       [](Test t) { return q_of(t.minimum); }},
      {"largest p or q", "Pa", "largest", "MPa", MPa,
       [](Test t) {
         return t.kind == TestKind::isotropic ? p_of(t.largest) : q_of(t.largest);
       }},
      {"axial strain at the end", "-", "", "%", percent,
       [](Test t) { return t.end_strain; }},
      {"p at the end", "Pa", "p end", "MPa", MPa, [](Test t) { return t.end.p; }},
      {"q at the end", "Pa", "q end", "MPa", MPa, [](Test t) { return t.end.q; }},
      {"q/p at the end", "-", "q/p end", "-", 1.0,
       [](Test t) {
         return t.kind == TestKind::triaxial && t.end.p > 0.0 ? t.end.q / t.end.p
                                                              : no_value;
       }},
      {"lateral over axial stress at the end", "-", "K0 end", "-", 1.0,
       [](Test t) {
         const dem::MohrCircle circle = t.end.circle();
         return t.kind == TestKind::oedometer && circle.sigma_1 > 0.0
                    ? circle.sigma_3 / circle.sigma_1
                    : no_value;
       }},
      {"volumetric over axial strain rate at the end", "-", "dv/da", "-", 1.0,
       [](Test t) { return t.volume_rate; }},
      {"void ratio at the end", "-", "e end", "-", 1.0, [](Test t) { return t.end.e; }},
  };
  return columns;
}

std::vector<double> values_of(const TestColumn& column,
                              const std::vector<TestReading>& tests,
                              const std::vector<std::size_t>& members)
{
  std::vector<double> values;
  for (const std::size_t k : members) values.push_back(column.of(tests[k]));
  return values;
}

} // namespace mergel::apps
