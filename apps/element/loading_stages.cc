#include "apps/element/loading_stages.h"

#include "apps/case/cycles.h"
#include "apps/case/units.h"
#include "apps/case/words.h"
#include "dem/error.h"
#include "dem/text.h"

#include <algorithm>
#include <array>
#include <limits>
#include <sstream>
#include <utility>

namespace mergel::apps {

const char* const forms_of_stage =
    "isotropic | oedometer | triaxial [at STRESS] | radial dq/dp = NUMBER or inf | "
    "compression | tension | axes x = RULE, y = RULE, z = RULE (one `strain-controlled`, "
    "the others `fixed` or a STRESS) | resume | unload | reload | unload-reload, then `to` "
    "and the target: p, q, axial stress, lateral stress, axial strain, volumetric strain, "
    "x stress, y stress, x strain or y strain = VALUE; `, N times` behind that of an "
    "unload-reload repeats it";

namespace {

using dem::LoadingStage;
using dem::PathKind;
using dem::Quantity;

const std::vector<std::pair<std::string, PathKind>> kinds{
    {"isotropic", PathKind::isotropic},
    {"oedometer", PathKind::oedometer},
    {"triaxial", PathKind::triaxial},
    {"radial", PathKind::radial},
    {"compression", PathKind::compression},
    {"tension", PathKind::tension},
    {"axes", PathKind::axes},
    {"resume", PathKind::resume},
    {"unload", PathKind::resume},
    {"reload", PathKind::resume},
    {"unload-reload", PathKind::resume}};

const std::vector<std::pair<std::string, Quantity>> quantities{
    {"p", Quantity::p},
    {"q", Quantity::q},
    {"axial stress", Quantity::axial_stress},
    {"lateral stress", Quantity::lateral_stress},
    {"axial strain", Quantity::axial_strain},
    {"volumetric strain", Quantity::volumetric_strain},
    {"x stress", Quantity::x_stress},
    {"y stress", Quantity::y_stress},
    {"x strain", Quantity::x_strain},
    {"y strain", Quantity::y_strain}};

template <class T>
const T& chosen(const std::string& word, const std::vector<std::pair<std::string, T>>& from,
                const std::string& what)
{
  std::vector<std::string> names;
  for (const auto& [name, value] : from) {
    if (name == word) return value;
    names.push_back(name);
  }
  const std::string meant = nearest(word, names);
  throw InputError(what + " " + in_quotes(word) + " is unknown" +
                   (meant.empty() ? ": one of " + joined(names, ", ")
                                  : ": did you mean " + in_quotes(meant) + "?"));
}

double stress(const std::string& text)
{
  return to_si(text, "Pa");
}

/// A number, or one followed by % or percent.
double strain(std::string text)
{
  double per = 1.0;
  for (const std::string unit : {"%", "percent"})
    if (text.ends_with(unit)) {
      text.erase(text.size() - unit.size());
      per = 100.0;
      break;
    }
  return to_si(std::string(trimmed(text)), "1") / per;
}

/// Both sides of "name = value".
std::pair<std::string, std::string> assignment(const std::string& text,
                                               const std::string& example)
{
  const auto at = text.find('=');
  if (at == std::string::npos)
    throw InputError("expected " + in_quotes(example) + " instead of " + in_quotes(text));
  return {std::string(trimmed(text.substr(0, at))),
          std::string(trimmed(text.substr(at + 1)))};
}

/// "x = fixed, y = 0.5 MPa, z = strain-controlled"
std::array<dem::AxisRule, 3> read_rules(const std::string& text)
{
  std::array<dem::AxisRule, 3> rules;
  std::string seen;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const auto [axis, rule] =
        assignment(std::string(trimmed(part)), "z = strain-controlled");
    if (axis.size() != 1 || axis < "x" || axis > "z")
      throw InputError("an axis is x, y or z, not " + in_quotes(axis));
    if (seen.find(axis) != std::string::npos)
      throw InputError("axis " + axis + " has two rules");
    seen += axis;
    dem::AxisRule& r = rules[static_cast<std::size_t>(axis[0] - 'x')];
    if (rule == "driven")
      throw InputError("the rule `driven` is now `strain-controlled`. Rename it");
    if (rule == "strain-controlled")
      r.kind = dem::AxisRule::Kind::strain_controlled;
    else if (rule != "fixed")
      r = {dem::AxisRule::Kind::stress_controlled, stress(rule)};
  }
  if (seen.size() != 3)
    throw InputError("expected a rule for each axis, such as " +
                     in_quotes("axes x = fixed, y = 0.5 MPa, z = strain-controlled"));
  return rules;
}

/// Read the text between the kind and "to".
void read_details(LoadingStage& stage, const std::string& kind, const std::string& details)
{
  if (kind == "radial") {
    const auto [name, value] = assignment(details, "dq/dp = 1.5");
    if (name != "dq/dp")
      throw InputError("a radial stage needs " + in_quotes("dq/dp = NUMBER") +
                       " before `to`");
    stage.slope =
        value == "inf" ? std::numeric_limits<double>::infinity() : to_si(value, "1");
  } else if (kind == "triaxial" && details.starts_with("at ")) {
    stage.has_lateral = true;
    stage.lateral = stress(std::string(trimmed(details.substr(3))));
  } else if (kind == "axes") {
    stage.axes = read_rules(details);
  } else if (!details.empty())
    throw InputError(in_quotes(details) + " is not understood after " + in_quotes(kind) +
                     "; a stage reads: " + forms_of_stage);
}

} // namespace

std::vector<LoadingStage> read_stages(const std::string& text)
{
  const Cycles cycles = cycles_in(text);
  const std::string padded = cycles.text + " ";
  const auto to = padded.find(" to ");
  if (to == std::string::npos)
    throw InputError(std::string("there is no `to`; a stage reads: ") + forms_of_stage);
  const std::string head(trimmed(padded.substr(0, to)));
  const auto blank = std::min(head.find(' '), head.size());
  const std::string kind = head.substr(0, blank);

  LoadingStage stage;
  stage.kind = chosen(kind, kinds, "the kind of stage");
  read_details(stage, kind, std::string(trimmed(head.substr(blank))));
  const auto [name, value] =
      assignment(std::string(trimmed(padded.substr(to + 4))), "axial strain = 2 %");
  stage.quantity = chosen(name, quantities, "the quantity");
  stage.target = dem::is_strain(stage.quantity) ? strain(value) : stress(value);
  if (stage.kind != PathKind::resume) stage.check(); // else by the stage that it resumes
  if (kind != "unload-reload") {
    if (cycles.is_given)
      throw InputError(
          "only an `unload-reload` is repeated: leave the number of times out");
    return {stage};
  }
  LoadingStage back = stage;
  back.returns = true;
  std::vector<LoadingStage> parts;
  for (std::size_t k = 0; k < cycles.n; ++k) parts.insert(parts.end(), {stage, back});
  return parts;
}

std::string key_of_stage(std::size_t number)
{
  return "stage " + std::to_string(number);
}

void declare_stages(CaseFile& file, StageTexts& texts)
{
  file.former_name("leg N", "stage N");
  file.numbered(
      "stage", texts,
      std::string("A loading stage: ") + forms_of_stage +
          ". Compression is positive, z is the axis, strains count from the start of the "
          "stage (resume, unload, reload: of the stage resumed). Where a stage needs "
          "another lateral stress, that comes first, at constant q (from zero isotropic); "
          "strains count from its end. As many stages as needed: stage 2, stage 3 and so "
          "on.",
      "The next loading stage.", Default::none);
}

namespace {

/// The stage that a `resume` after these stages resumes.
const dem::LoadingStage& resumed(const std::vector<dem::LoadingStage>& stages)
{
  const auto at =
      std::find_if(stages.rbegin(), stages.rend(), [](const dem::LoadingStage& stage) {
        return stage.kind != dem::PathKind::resume;
      });
  require(at != stages.rend(), "there is no stage before to resume");
  return *at;
}

/// Whether the target of a stage of the words `unload` or `unload-reload` lies beyond that of the
/// stage before, on its way: that would be loading.
bool loads_on(const std::string& text, const LoadingStage& stage,
              const std::vector<LoadingStage>& before)
{
  if (stage.returns || !text.starts_with("unload") || before.empty()) return false;
  const LoadingStage& last = before.back();
  if (last.returns || last.quantity != stage.quantity) return false;
  double start = 0.0; // of the last stage; strains of each count from its own
  if (before.size() > 1 && before[before.size() - 2].quantity == last.quantity &&
      (last.kind == PathKind::resume || !dem::is_strain(last.quantity)))
    start = before[before.size() - 2].target;
  return (stage.target - last.target) * (last.target - start) >= 0.0;
}

/// Refuse targets that no specimen reaches.
void require_possible(const std::string& text, const LoadingStage& stage,
                      const std::vector<LoadingStage>& before)
{
  require(!dem::is_strain(stage.quantity) || stage.target < 1.0,
          "a compression of 100 % leaves nothing of the specimen: strains are engineering "
          "strains, and must be below 100 %");
  require(
      !loads_on(text, stage, before),
      "the target lies beyond that of the stage before, so this would load on: unload to "
      "less, or write `resume`");
}

} // namespace

std::vector<LoadingStage> stages_of(const CaseFile& file, const StageTexts& texts)
{
  std::vector<LoadingStage> stages;
  std::size_t n_read = 0;
  for (const auto& [number, text] : texts) {
    if (number != ++n_read)
      file.refuse("Loading", key_of_stage(number),
                  "there is no `" + key_of_stage(n_read) +
                      "`: number the stages from 1 without a gap");
    try {
      for (const dem::LoadingStage& stage : read_stages(text)) {
        if (stage.kind == dem::PathKind::resume) stage.check_after(resumed(stages));
        require_possible(text, stage, stages);
        stages.push_back(stage);
      }
    } catch (const std::invalid_argument& e) {
      file.refuse("Loading", key_of_stage(number), e.what());
    }
  }
  return stages;
}

namespace {

/// Whether an axis is without pressure along the stage, or at its target.
bool is_without_pressure(const LoadingStage& s)
{
  const auto is_pulled = [](const dem::AxisRule& r) {
    return r.kind == dem::AxisRule::Kind::stress_controlled && r.stress <= 0.0;
  };
  const bool is_stress = !dem::is_strain(s.quantity) && s.quantity != Quantity::q;
  return s.kind == PathKind::compression || s.kind == PathKind::tension ||
         (s.has_lateral && s.lateral <= 0.0) ||
         (s.kind == PathKind::axes &&
          std::any_of(s.axes.begin(), s.axes.end(), is_pulled)) ||
         (is_stress && s.target <= 0.0);
}

} // namespace

void check_granular_stages(const CaseFile& file, const StageTexts& texts)
{
  for (const auto& [number, text] : texts)
    for (const LoadingStage& stage : read_stages(text))
      if (is_without_pressure(stage))
        file.refuse(
            "Loading", key_of_stage(number),
            "an axis would be without pressure, and particles without bonds, "
            "`Specimen/coordination` = 0, fall apart: confine them, as in `triaxial "
            "at 0.1 MPa`");
}

std::string StageLabel::name() const
{
  constexpr std::array<const char*, 3> letters{"", "a", "b"};
  return std::to_string(number) + letters.at(static_cast<std::size_t>(part)) +
         (is_repeated ? " of cycle " + std::to_string(cycle) : "");
}

std::vector<StageLabel> labels_of(const StageTexts& texts)
{
  std::vector<StageLabel> labels;
  for (const auto& [number, text] : texts) {
    const std::size_t n_parts = read_stages(text).size();
    if (n_parts == 1) {
      labels.push_back({number, 0, 0, text, false});
      continue;
    }
    for (std::size_t k = 0; k < n_parts; ++k) {
      const bool unloads = k % 2 == 0;
      labels.push_back({number, unloads ? 1 : 2, k / 2 + 1,
                        text + (unloads ? ", unloading" : ", reloading"), n_parts > 2});
    }
  }
  return labels;
}

namespace {

/// Direction of the controlled strain in which the path of this stage is loaded: 1 or -1.
double loading_direction(const StageLabel& last, const dem::ActiveStage& before,
                         const dem::ActiveStage& now)
{
  if (last.text.starts_with("unload ")) return -before.direction;
  if (last.text.starts_with("resume")) // it may load and unload
    return now.strain_at_start < 0.0 ? -1.0 : 1.0;
  return before.direction;
}

/// "q is 2.4 MPa" of a stage `unload to q = 9 MPa`.
std::string value_in_words(const std::string& text, const dem::ActiveStage& now)
{
  const auto from = text.find(" to ") + 4;
  std::ostringstream out;
  out.precision(3);
  out << trimmed(text.substr(from, text.find('=') - from)) << " is ";
  if (dem::is_strain(now.quantity))
    out << 100.0 * now.value_at_start << " %";
  else
    out << 1e-6 * now.value_at_start << " MPa";
  return out.str();
}

} // namespace

std::string wrong_direction(const std::vector<StageLabel>& labels,
                            const dem::ActiveStage& before, const dem::ActiveStage& now)
{
  if (labels.size() < 2 || now.returns || now.target == now.value_at_start) return "";
  const StageLabel& label = labels.back();
  const bool unloads = label.text.starts_with("unload");
  if (!unloads && !label.text.starts_with("reload")) return "";
  const double loading = loading_direction(labels[labels.size() - 2], before, now);
  if (now.direction == (unloads ? -loading : loading)) return "";
  return "stage " + label.name() + ", " + label.text + ": " +
         value_in_words(label.text, now) + " where it begins, so it would be " +
         (unloads ? "a loading" : "an unloading") + "; continue with another `Loading/" +
         key_of_stage(label.number) + "`";
}

namespace {

/// A stage of the test with its place in the case.
struct NumberedStage {
  std::size_t number;
  LoadingStage stage; ///< its part follows from `returns`
  bool operator==(const NumberedStage&) const = default;
};

std::vector<NumberedStage> numbered(const StageTexts& texts)
{
  std::vector<NumberedStage> stages;
  for (const auto& [number, text] : texts)
    for (const LoadingStage& stage : read_stages(text)) stages.push_back({number, stage});
  return stages;
}

} // namespace

bool may_go_on(const StageTexts& earlier, const StageTexts& now, std::size_t n_begun)
{
  const auto before = numbered(earlier), after = numbered(now);
  const auto returns = [n_begun](const std::vector<NumberedStage>& stages) {
    return n_begun < stages.size() && stages[n_begun].stage.returns;
  };
  return n_begun <= std::min(before.size(), after.size()) &&
         returns(before) == returns(after) &&
         std::equal(before.begin(), before.begin() + static_cast<std::ptrdiff_t>(n_begun),
                    after.begin());
}

} // namespace mergel::apps
