#include "apps/pile/pile_stages.h"

#include "apps/case/units.h"
#include "apps/case/words.h"
#include "dem/error.h"
#include "dem/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace mergel::apps {

const char* const forms_of_pile_stage = "penetrate to depth = DEPTH | hold | hold for TIME "
                                        "| unload to head force = FORCE | load "
                                        "to head force = FORCE | pull to displacement = "
                                        "LENGTH | push to displacement = LENGTH at "
                                        "height = LENGTH";

namespace {

using Kind = PileStage::Kind;

struct Form {
  const char* word;
  Kind kind;
  const char* quantity; ///< of its target; "" without one
  const char *unit, *shown_unit;
};
constexpr std::array forms{Form{"penetrate", Kind::penetrate, "depth", "m", "mm"},
                           Form{"hold", Kind::hold, "", "s", "ms"},
                           Form{"unload", Kind::unload, "head force", "N", "N"},
                           Form{"load", Kind::load, "head force", "N", "N"},
                           Form{"pull", Kind::pull, "displacement", "m", "mm"},
                           Form{"push", Kind::push, "displacement", "m", "mm"}};

const Form& form_of(Kind kind)
{
  for (const Form& f : forms)
    if (f.kind == kind) return f;
  return forms.front(); // every kind has a form
}

[[noreturn]] void refuse(const std::string& what)
{
  throw InputError(what + "; a stage reads: " + forms_of_pile_stage);
}

const Form& form_named(const std::string& word)
{
  std::vector<std::string> words;
  for (const Form& f : forms) {
    if (f.word == word) return f;
    words.emplace_back(f.word);
  }
  const std::string meant = nearest(word, words);
  refuse("the kind of stage " + in_quotes(word) + " is unknown" +
         (meant.empty() ? "" : ": did you mean " + in_quotes(meant) + "?"));
}

/// The value of "quantity = value".
double value_of(const std::string& text, const std::string& quantity, const char* unit)
{
  const auto at = text.find('=');
  if (at == std::string::npos || trimmed(text.substr(0, at)) != quantity)
    refuse("expected " + in_quotes(quantity + " = ...") + " instead of " + in_quotes(text));
  return to_si(std::string(trimmed(text.substr(at + 1))), unit);
}

} // namespace

PileStage read_pile_stage(const std::string& text)
{
  const std::string all(trimmed(text));
  const auto blank = std::min(all.find(' '), all.size());
  const std::string word = all.substr(0, blank);
  const Form& form = form_named(word);
  std::string rest(trimmed(all.substr(blank)));
  PileStage stage;
  stage.kind = form.kind;
  if (form.kind == Kind::hold) {
    if (rest.empty()) return stage;
    if (!rest.starts_with("for ")) refuse(in_quotes(rest) + " is not understood");
    stage.target = to_si(std::string(trimmed(rest.substr(4))), "s");
    if (!(stage.target > 0.0)) refuse("the time of a hold must be above 0 s");
    return stage;
  }
  if (!rest.starts_with("to ")) refuse(std::string("there is no `to` after ") + form.word);
  rest = trimmed(rest.substr(3));
  if (form.kind == Kind::push) {
    const auto at = rest.find(" at ");
    if (at == std::string::npos)
      refuse("a push needs the height of the pushed point above the surface, as in " +
             in_quotes("at height = 2 mm"));
    stage.height = value_of(std::string(trimmed(rest.substr(at + 4))), "height", "m");
    rest = trimmed(rest.substr(0, at));
    if (!(stage.height >= 0.0)) refuse("the height of a push must be at least 0 mm");
  }
  stage.target = value_of(rest, form.quantity, form.unit);
  if (form.kind == Kind::pull && !(stage.target > 0.0))
    refuse(
        "a pull goes upwards: its displacement must be above 0 mm; downwards the pile goes "
        "by `penetrate` or `load`");
  if (stage.is_by_force() && !(stage.target >= 0.0))
    refuse(
        "a head force presses downwards: it must be at least 0 N; upwards the pile goes by "
        "`pull`");
  return stage;
}

std::string name_of(const PileStage& stage)
{
  const Form& form = form_of(stage.kind);
  const std::string value = with_unit(stage.target, form.unit, form.shown_unit);
  std::string text = form.word;
  if (stage.kind == Kind::hold) return stage.target > 0.0 ? text + " for " + value : text;
  text += std::string(" to ") + form.quantity + " = " + value;
  if (stage.kind == Kind::push)
    text += " at height = " + with_unit(stage.height, "m", "mm");
  return text;
}

namespace {

std::string mm(double x)
{
  return dem::rounded(1e3 * x) + " mm";
}

/// What is known of a pile before the run.
struct Known {
  double depth = 0.0; ///< of the shoulder, but for its motion under a head force [m]
  std::optional<double> force; ///< of the head [N]
  bool is_moved_by_force = false;
  std::optional<PileStage> before, push;
};

std::string fault_of_penetration(const PileStage& s, const Known& now,
                                 const PileLimits& limits)
{
  const double tip = s.target + limits.tip_height;
  if (tip + limits.diameter > limits.height)
    return "the tip would reach " + mm(tip) +
           ", less than a diameter above the floor of the DEM region at " +
           mm(limits.height) + "; give a smaller depth, or raise `Specimen/height`";
  if (!now.before) {
    if (tip > 0.0) return "";
    return "the pile starts with its tip at the surface: the depth of the shoulder must be "
           "above " +
           mm(-limits.tip_height);
  }
  const bool is_allowed =
      now.is_moved_by_force ? s.target >= now.depth : s.target > now.depth;
  if (is_allowed) return "";
  return "the pile is " + mm(now.depth) +
         " deep after the stage before: the depth must be larger; upwards it goes by "
         "`pull`";
}

std::string fault_of_pull(const PileStage& s, const Known& now, const PileLimits& limits)
{
  const double tip = now.depth + limits.tip_height;
  if (s.target < tip) return "";
  return "the tip is " + mm(tip) +
         " deep after the stage before and would leave the rock: " +
         "the displacement must be smaller";
}

std::string fault_of_force(const PileStage& s, const Known& now)
{
  if (!now.force) return "";
  const bool is_load = s.kind == Kind::load;
  if (is_load ? s.target > *now.force : s.target < *now.force) return "";
  return "the head force is " + dem::rounded(*now.force) + " N after the stage before: " +
         (is_load ? "a load must be larger; use `unload`"
                  : "an unloading must end below it; use `load`");
}

std::string fault_of_push(const PileStage& s, const Known& now, const PileLimits& limits)
{
  if (now.depth <= 0.0)
    return "the shoulder of the pile is not below the surface after the stage before: let "
           "it "
           "penetrate first";
  if (now.before->kind == Kind::penetrate || now.before->kind == Kind::pull)
    return "the pile must be at rest: put the stage `hold` before it";
  if (std::abs(s.target) > limits.diameter)
    return "must be at most a pile diameter, " + mm(limits.diameter);
  if (now.push && s.height != now.push->height)
    return "the pile is pushed at one point, at height = " + mm(now.push->height);
  if (s.target == (now.push ? now.push->target : 0.0))
    return "the pushed point is there already; displacements count from the first push";
  return "";
}

std::string fault_of(const PileStage& s, const Known& now, const PileLimits& limits)
{
  if (!now.before && s.kind != Kind::penetrate)
    return "the pile stands on the surface: the first stage must be `penetrate`";
  if (now.push && s.kind != Kind::push && s.kind != Kind::hold)
    return "the pile leans after a push: only `push` and `hold` can follow";
  switch (s.kind) {
  case Kind::penetrate:
    return fault_of_penetration(s, now, limits);
  case Kind::pull:
    return fault_of_pull(s, now, limits);
  case Kind::unload:
  case Kind::load:
    return fault_of_force(s, now);
  case Kind::push:
    return fault_of_push(s, now, limits);
  case Kind::hold:
    break;
  }
  return "";
}

void follow(const PileStage& s, Known& now)
{
  now.before = s;
  if (s.kind == Kind::hold) return; // keeps what there is
  now.is_moved_by_force = s.is_by_force();
  now.force.reset();
  if (s.is_by_force()) now.force = s.target;
  if (s.kind == Kind::penetrate) now.depth = s.target;
  if (s.kind == Kind::pull) now.depth -= s.target;
  if (s.kind == Kind::push) now.push = s;
}

} // namespace

std::optional<StageFault> find_fault(const std::vector<PileStage>& stages,
                                     const PileLimits& limits)
{
  Known now;
  for (std::size_t k = 0; k < stages.size(); ++k) {
    if (std::string message = fault_of(stages[k], now, limits); !message.empty())
      return StageFault{k, std::move(message)};
    follow(stages[k], now);
  }
  return std::nullopt;
}

} // namespace mergel::apps
