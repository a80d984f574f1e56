#include "apps/pile/pile_restart.h"

#include "apps/pile/installation.h"
#include "dem/error.h"

#include <algorithm>
#include <sstream>

namespace mergel::apps {

namespace {

using Kind = PileStage::Kind;

/// The case of the checkpoint.
PileCase earlier_case(const Restart& restart)
{
  CaseFile file;
  PileCase c;
  declare(file, c);
  file.read_text(restart.checkpoint.label.case_text, restart.file.string());
  complete(file, c);
  return c;
}

/// Refuse another final depth once the pile slows down for the old or the new one: the
/// velocity near the end depends on the final depth. At its old end the pile may go deeper.
void check_final_depth(const CaseFile& file, const Restart& restart, const PileCase& c)
{
  const CaseFile::Change* change = find_change(restart, "Pile", "final depth");
  if (!change) return;
  const Push push = Installation::push_in(restart.checkpoint.state);
  const double end = c.travel();
  if (push.is_over()) {
    if (end > push.tip) return;
    file.refuse("Pile", "final depth",
                "was " + change->was +
                    ", where the pile stands in the checkpoint: it can only go deeper. "
                    "Raise it, or choose an older checkpoint");
  }
  if (push.tip <= std::min(push.end, end) - PenetrationRate(c).ramp()) return;
  file.refuse("Pile", "final depth",
              "was " + change->was + ", and in the checkpoint, with the tip at " +
                  mm_text(push.tip) +
                  ", the pile has begun to slow down for one of the two depths: "
                  "restore it, and raise it when the run is finished; or choose an older "
                  "checkpoint");
}

/// Refuse another stage among the first n.
void check_fixed(const CaseFile& file, const Restart& restart, const PileCase& c,
                 const PileCase& earlier, const StagePosition& at)
{
  for (std::size_t k = 0; k < at.n_fixed(); ++k) {
    const std::string was = name_of(earlier.stages[k]);
    const std::string message =
        "was `" + was + "`, which is " + (k < at.n_done ? "done" : "under way") +
        " in the checkpoint: restore it and add stages behind it, or choose an older "
        "checkpoint";
    if (k >= c.stages.size())
      throw InputError("--restart " + restart.file.string() + ": Loading/" +
                       key_of_pile_stage(k) + " " + message);
    if (c.stages[k] == earlier.stages[k]) continue;
    if (c.has_stages()) file.refuse("Loading", key_of_pile_stage(k), message);
    file.refuse("Pile", "final depth", message);
  }
}

/// Refuse another value of a key on which one of the stages from `from` to `to` depends.
template <class Depends>
void check_key(const CaseFile& file, const Restart& restart, const std::string& section,
               const std::string& key, const PileCase& earlier, std::size_t from,
               std::size_t to, Depends&& depends)
{
  const CaseFile::Change* change = find_change(restart, section, key);
  if (!change) return;
  for (std::size_t k = from; k < to; ++k)
    if (depends(earlier.stages[k]))
      file.refuse(section, key,
                  "was " + change->was + ", and `" + name_of(earlier.stages[k]) +
                      "` has begun with it in the checkpoint: restore it, or choose an "
                      "older checkpoint");
}

} // namespace

std::string mm_text(double x)
{
  std::ostringstream out;
  out << 1e3 * x << " mm";
  return out.str();
}

void check_changed_stages(const CaseFile& file, const Restart& restart, const PileCase& c)
{
  if (restart.changed.empty() || !Installation::is_in(restart.checkpoint.state)) return;
  const PileCase earlier = earlier_case(restart);
  if (!c.has_stages() && !earlier.has_stages()) return check_final_depth(file, restart, c);

  const StagePosition at = Installation::stages_in(restart.checkpoint.state);
  check_fixed(file, restart, c, earlier, at);
  const auto check = [&](const char* section, const char* key, std::size_t from,
                         auto&& depends) {
    check_key(file, restart, section, key, earlier, from, at.n_fixed(), depends);
  };
  check("Loading", "displacement rate", at.n_done,
        [](const PileStage& s) { return s.kind == Kind::pull || s.kind == Kind::push; });
  check("Loading", "force ramp", at.n_done,
        [](const PileStage& s) { return s.is_by_force(); });
  check("Pile", "mass", 0,
        [](const PileStage& s) { return s.is_by_force() || s.kind == Kind::push; });
}

} // namespace mergel::apps
