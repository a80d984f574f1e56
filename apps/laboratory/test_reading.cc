#include "apps/laboratory/test_reading.h"

#include "apps/laboratory/stages.h"
#include "dem/element/element_analysis.h"
#include "dem/error.h"
#include "dem/io/readable.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace mergel::apps {

namespace {

constexpr double collapse = 0.1;      // share of the peak by which the stress falls
constexpr double unconfined = 0.01;   // lateral stress over the largest q
constexpr double slack = 1e-9;        // of the strain: a record at a bound counts
constexpr double end_share = 0.1;     // of the strain, over which the end is a mean
constexpr double steady_ratio = 0.05; // change of q/p over its value

/// "triaxial" of "triaxial at 1 MPa to axial strain = 2 %".
std::string kind_of(const std::string& stage)
{
  return stage.substr(0, stage.find(' '));
}

bool is_resumed(const std::string& stage)
{
  const std::string kind = kind_of(stage);
  return kind == "resume" || kind.starts_with("unload") || kind == "reload";
}

/// The first and the last stage that are read together, from 0.
struct Span {
  std::size_t first, last;
};

Span span_from(std::size_t first, const std::vector<std::string>& stages, std::size_t n)
{
  std::size_t last = first;
  while (last + 1 < n && is_resumed(stages[last + 1])) ++last;
  return {first, last};
}

/// @param n stages that were begun, > 0
Span choose(const std::vector<std::string>& stages, std::size_t n)
{
  const auto first_of = [&](auto&& is_it) {
    std::size_t k = 0;
    while (k < n && !is_it(stages[k])) ++k;
    return k;
  };
  const auto is_compressed = [](const std::string& stage) {
    const bool is_extended = stage.find("= -") != std::string::npos;
    return (kind_of(stage) == "triaxial" || kind_of(stage) == "compression") &&
           !is_extended;
  };
  const auto is_of = [](const char* kind) {
    return [kind](const std::string& stage) { return kind_of(stage) == kind; };
  };
  if (const std::size_t k = first_of(is_compressed); k < n) return span_from(k, stages, n);
  if (const std::size_t k = first_of(is_of("tension")); k < n)
    return span_from(k, stages, n);
  if (const std::size_t k = first_of(is_of("oedometer")); k < n)
    return span_from(k, stages, n);
  std::size_t chosen = n, last = 0;
  for (std::size_t k = 0; k < n; ++k) {
    if (kind_of(stages[k]) == "isotropic") chosen = k;
    if (!is_resumed(stages[k])) last = k;
  }
  return span_from(chosen < n ? chosen : last, stages, n);
}

/// Read the records of these stages in which the axial strain goes on.
void read_curve(TestReading& r, const dem::Table& history, const Span& span)
{
  const dem::Table rows = from_stages(
      history, {static_cast<int>(span.first) + 1, static_cast<int>(span.last) + 1});
  const auto& strain = rows.column("axial strain", "-");
  const auto &p = rows.column("p", "Pa"), &q = rows.column("q", "Pa");
  const auto& e = rows.column("void ratio", "-");
  const auto& stage = rows.column("stage", "-");
  const std::vector<double> part = parts_of(rows);
  const double direction = strain.back() < 0.0 ? -1.0 : 1.0;
  double progress = -std::numeric_limits<double>::infinity();
  std::size_t last = 0;                            // row that goes on
  bool has_turned = false, has_other_part = false; // since then
  for (std::size_t row = 0; row < rows.n_rows; ++row) {
    has_other_part = has_other_part || stage[row] != stage[last] || part[row] != part[last];
    if (!(direction * strain[row] > progress)) {
      has_turned = has_turned || direction * strain[row] < progress;
      continue;
    }
    // Within one stage the axial strain may turn by itself, as in an isotropic one.
    if (has_turned && has_other_part) r.loops.push_back(r.curve.size());
    has_turned = has_other_part = false;
    last = row;
    progress = direction * strain[row];
    r.curve.push_back({strain[row], p[row], q[row], e[row]});
  }
}

/// Mean of the records whose strain is this share of the last one.
StressState mean_of(const std::vector<StressState>& curve, double from, double to)
{
  const double end = std::abs(curve.back().strain);
  StressState mean{0.0, 0.0, 0.0, 0.0};
  double n = 0.0;
  for (const StressState& s : curve) {
    const double strain = std::abs(s.strain);
    if (strain < (from - slack) * end || strain > (to + slack) * end) continue;
    ++n;
    mean.strain += s.strain;
    mean.p += s.p;
    mean.q += s.q;
    mean.e += s.e;
  }
  if (n == 0.0) return {}; // records are further apart
  return {mean.strain / n, mean.p / n, mean.q / n, mean.e / n};
}

/// The state at this strain, linear between records.
StressState state_at(const std::vector<StressState>& curve, double strain)
{
  for (std::size_t k = 1; k < curve.size(); ++k) {
    const StressState &a = curve[k - 1], &b = curve[k];
    if ((a.strain - strain) * (b.strain - strain) > 0.0) continue;
    const double t = (strain - a.strain) / (b.strain - a.strain); // strains differ
    return {strain, a.p + t * (b.p - a.p), a.q + t * (b.q - a.q), a.e + t * (b.e - a.e)};
  }
  return {};
}

double mean_stress(const StressState& s)
{
  return s.p;
}
double axial_stress(const StressState& s)
{
  return s.circle().sigma_1;
}

/// The first state at which this stress passes the value `at`.
StressState state_at_stress(const std::vector<StressState>& curve,
                            double (*stress)(const StressState&), double at)
{
  for (std::size_t k = 1; k < curve.size(); ++k) {
    const double strain = curve[k - 1].strain, a = stress(curve[k - 1]),
                 b = stress(curve[k]);
    if (a == b || (a - at) * (b - at) > 0.0) continue;
    return state_at(curve, strain + (at - a) / (b - a) * (curve[k].strain - strain));
  }
  return {};
}

void read_moduli(TestReading& r, const RunFindings& found)
{
  const auto of_stage = found.stages.find(r.stage);
  if (of_stage == found.stages.end()) return;
  const Findings& stage = of_stage->second;
  r.E = stage.at("Young's modulus [Pa]");
  r.nu = stage.at("Poisson's ratio [-]");
  r.K = stage.at("bulk modulus [Pa]");
  r.M = stage.at("constrained modulus [Pa]");
  r.tensile_strength = stage.at("tensile strength [Pa]");
  StressState yield;
  if (r.is_sheared())
    yield = state_at(r.curve, stage.at("strain at yield [-]"));
  else if (r.kind == TestKind::isotropic)
    yield = state_at_stress(r.curve, mean_stress, stage.at("isotropic yield [Pa]"));
  else if (r.kind == TestKind::oedometer)
    yield = state_at_stress(r.curve, axial_stress, stage.at("oedometric yield [Pa]"));
  else if (r.kind == TestKind::other)
    yield = state_at_stress(r.curve, mean_stress, stage.at("p at yield [Pa]"));
  if (std::isfinite(yield.p)) r.yield = yield;
}

void read_peak(TestReading& r)
{
  const bool is_isotropic = r.kind == TestKind::isotropic;
  if (!is_isotropic && !r.is_sheared()) return;
  dem::Curve all{{}, {}, r.loops};
  for (const StressState& s : r.curve) {
    all.strain.push_back(s.strain);
    all.stress.push_back(is_isotropic ? s.p : s.q);
  }
  const dem::Curve curve = dem::without_reloading(all);
  r.largest = state_at(r.curve, dem::peak(curve).strain);
  if (const auto drop = dem::first_drop(curve, collapse)) {
    r.peak = state_at(r.curve, drop->peak.strain);
    r.minimum = state_at(r.curve, drop->minimum.strain);
  }
}

StressState before_end(const TestReading& r)
{
  return mean_of(r.curve, 1.0 - 2.0 * end_share, 1.0 - end_share);
}

double volume_rate_of(const TestReading& r)
{
  const StressState before = before_end(r);
  return (before.e - r.end.e) / (1.0 + before.e) / (r.end.strain - before.strain);
}

/// Why the end is not taken for a critical state.
std::string lacks_of_critical(const TestReading& r)
{
  char text[160];
  if (!r.is_sheared()) return "not sheared";
  if (r.kind == TestKind::unconfined) return "unconfined";
  if (r.end.strain < critical_strain) {
    std::snprintf(text, sizeof text, "ends at %.2g %% of axial strain, before %g %%",
                  100.0 * r.end_strain, 100.0 * critical_strain);
    return text;
  }
  const StressState before = before_end(r);
  const double change = r.end.q / r.end.p / (before.q / before.p) - 1.0;
  if (!(std::abs(change) < steady_ratio)) {
    std::snprintf(text, sizeof text, "q/p changes by %.2g %% at the end, more than %g %%",
                  100.0 * change, 100.0 * steady_ratio);
    return text;
  }
  return "";
}

/// Stages of the case that the history has.
std::size_t n_begun(const dem::Table& history, const TestCase& test_case)
{
  const auto& stage = history.column("stage", "-");
  const double begun = *std::max_element(stage.begin(), stage.end());
  return std::min(static_cast<std::size_t>(std::max(begun, 0.0)), test_case.stages.size());
}

TestReading brazilian(const dem::Table& history, const TestCase& test_case,
                      const std::optional<RunFindings>& found)
{
  TestReading r;
  r.test_case = test_case;
  r.kind = TestKind::brazilian;
  r.is_finished = found.has_value();
  r.not_critical = "not sheared";
  r.end_strain = history.column("diametral strain", "-").back();
  for (const double stress : history.column("2P/(pi D t)", "Pa"))
    if (std::isfinite(stress) && !(stress <= r.brazilian_strength))
      r.brazilian_strength = stress;
  return r;
}

} // namespace

std::string name_of(TestKind kind)
{
  switch (kind) {
  case TestKind::triaxial:
    return "triaxial";
  case TestKind::unconfined:
    return "unconfined";
  case TestKind::tension:
    return "tension";
  case TestKind::isotropic:
    return "isotropic";
  case TestKind::oedometer:
    return "oedometer";
  case TestKind::brazilian:
    return "Brazilian";
  case TestKind::other:
    break;
  }
  return "other";
}

void require_numbers_of_case(const dem::Table& history, const TestCase& test_case)
{
  const auto begin = test_case.stages.begin();
  const bool has_loop =
      std::any_of(begin, begin + static_cast<std::ptrdiff_t>(n_begun(history, test_case)),
                  [](const std::string& s) { return kind_of(s) == "unload-reload"; });
  require(
      !has_loop || history.has("part"),
      history.file.string() +
          ": has no column 'part [-]': an earlier version of mergel has written it, "
          "which counts an unload-reload as two stages. Repeat the run, or leave it out.");
}

TestReading reading_of(const dem::Table& history, const TestCase& test_case,
                       const std::optional<RunFindings>& found)
{
  if (history.has("2P/(pi D t)") && history.has("diametral strain"))
    return brazilian(history, test_case, found);
  require(is_element_history(history) || is_triaxial_history(history),
          history.file.string() +
              ": is the history of no element, triaxial or Brazilian test.");
  const std::size_t n = n_begun(history, test_case);
  require(n > 0, history.file.string() + ": holds no stage of its resolved.prm.");
  require_numbers_of_case(history, test_case);

  TestReading r;
  r.test_case = test_case;
  const Span span = choose(test_case.stages, n);
  r.stage = span.first + 1;
  read_curve(r, history, span);
  require(r.curve.size() > 1,
          history.file.string() + ": stage " + std::to_string(r.stage) +
              " has fewer than two records; there is nothing to read yet.");
  r.end = mean_of(r.curve, 1.0 - end_share, 1.0);
  r.end_strain = r.curve.back().strain;

  const std::string kind = kind_of(test_case.stages[span.first]);
  if (kind == "isotropic") r.kind = TestKind::isotropic;
  if (kind == "tension") r.kind = TestKind::tension;
  if (kind == "oedometer") r.kind = TestKind::oedometer;
  if ((kind == "triaxial" || kind == "compression") && r.curve.back().strain > 0.0) {
    double sum = 0.0, q = 0.0;
    for (const StressState& s : r.curve) {
      sum += s.circle().sigma_3;
      q = std::max(q, s.q);
    }
    r.confinement = sum / static_cast<double>(r.curve.size());
    r.kind = r.confinement < unconfined * q ? TestKind::unconfined : TestKind::triaxial;
  }
  r.is_finished = found.has_value();
  if (found) read_moduli(r, *found);
  read_peak(r);
  if (r.is_sheared()) r.volume_rate = volume_rate_of(r);
  r.not_critical = lacks_of_critical(r);
  return r;
}

TestReading read_test(const std::filesystem::path& folder, const std::string& label)
{
  dem::require_folder(folder);
  const dem::Table history = dem::read_table(folder / "history.csv");
  const TestCase test_case = read_test_case(folder);
  TestReading r = reading_of(history, test_case, read_findings(folder));
  r.folder = folder;
  r.label = label;
  return r;
}

std::vector<std::string> folder_labels(const std::vector<std::string>& folders)
{
  std::vector<std::string> names;
  for (const std::string& folder : folders) {
    dem::require_folder(folder);
    names.push_back(std::filesystem::canonical(folder).filename().string());
  }
  std::vector<std::string> sorted = names;
  std::sort(sorted.begin(), sorted.end());
  const bool is_unique = std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
  return is_unique ? names : folders;
}

} // namespace mergel::apps
