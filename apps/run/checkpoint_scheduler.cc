#include "apps/run/checkpoint_scheduler.h"

#include "apps/case/units.h"
#include "apps/case/words.h"
#include "apps/run/progress.h"
#include "apps/run/run_guard.h"
#include "dem/assembly/step.h"
#include "dem/text.h"
#include "dem/timer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

namespace mergel::apps {

namespace fs = std::filesystem;

namespace {

/// Steps between two checks of clock and signals. A check is one global reduction; a step
/// has several.
constexpr std::uint64_t steps_between_checks = 10;

constexpr std::size_t n_kept = 2;

/// The run stops this long before the end of the walltime, plus twice the longest times of
/// a checkpoint and between two checks.
constexpr double margin = 2.0; // [s]

/// Write rate of a slow disk of a cluster, to estimate the time of the first checkpoint.
constexpr double lowest_rate = 20e6; // [bytes/s]

/// All ranks together; collective.
double n_bytes(const dem::State& mine, const dem::Communicator& comm)
{
  std::size_t n = 0;
  for (const auto& [name, array] : mine.arrays())
    n += std::visit([](const auto& v) { return v.size() * sizeof(v[0]); }, array.values);
  return static_cast<double>(comm.global_sum(n));
}

} // namespace

Cadence to_cadence(const std::string& text)
{
  Cadence every;
  if (text == "never") return every;
  const std::string unit = " steps";
  if (text.ends_with(unit)) {
    const char *begin = text.data(), *end = begin + text.size() - unit.size();
    const auto [at, error] = std::from_chars(begin, end, every.steps);
    if (error != std::errc{} || at != end || every.steps == 0)
      throw InputError("must be a whole number of steps, at least 1; expected for example "
                       "\"5000 steps\"");
    return every;
  }
  try {
    every.seconds = to_si(text, "s");
  } catch (const InputError&) {
    throw InputError("must be a time, a number of steps or never; expected for example "
                     "\"10 min\" or \"5000 steps\"");
  }
  if (every.seconds <= 0.0) throw InputError("must be above 0 s, or never");
  return every;
}

void declare(CaseFile& file, CheckpointKey& key)
{
  file.text(
      "checkpoint every", key.text,
      "Wall-clock time or steps between checkpoints (10 min, 5000 steps), or never; the "
      "last two are kept.");
  file.flag("checkpoint at end", key.at_end,
            "Write a checkpoint when the run is finished; --restart takes the run further "
            "from it.");
}

void complete(const CaseFile& file, CheckpointKey& key)
{
  try {
    key.every = to_cadence(key.text);
  } catch (const InputError& e) {
    file.refuse("Output", "checkpoint every", e.what());
  }
}

CheckpointScheduler::CheckpointScheduler(CheckpointSchedule spec)
    : spec_(std::move(spec)), last_(spec_.restarted_from), written_(spec_.clock()),
      asked_(written_)
{
}

int CheckpointScheduler::wish_here(const dem::Communicator& comm, const Position& at)
{
  if (const int signal = signals_.stop(); signal != 0) return stop + signal;
  const double now = spec_.clock();
  between_ = std::max(between_, now - asked_);
  asked_ = now;
  // The clocks of the ranks differ: the first rank decides.
  if (comm.rank() == 0 && now + margin + 2.0 * (longest_ + between_) > spec_.end)
    return stop_in_time;
  const bool is_due = comm.rank() == 0 && now - written_ >= spec_.every.seconds;
  const bool is_at_step = spec_.every.steps > 0 && at.step % spec_.every.steps == 0;
  return is_due || is_at_step || signals_.wants_checkpoint() ? write : none;
}

void CheckpointScheduler::after_step(const dem::Communicator& comm, const Position& at,
                                     const std::function<void(dem::State&)>& save)
{
  const bool is_at_step = spec_.every.steps > 0 && at.step % spec_.every.steps == 0;
  if (!is_at_step && at.step % steps_between_checks != 0) return;
  if (!has_estimate_ && std::isfinite(spec_.end)) {
    dem::State mine(comm.rank());
    save(mine);
    longest_ = n_bytes(mine, comm) / lowest_rate;
    has_estimate_ = true;
  }
  const int wish =
      static_cast<int>(comm.global_max(static_cast<double>(wish_here(comm, at))));
  if (wish == none) return;
  write_now(comm, at, save);
  if (wish == write) return;
  throw Stopped((wish > stop ? "stopped by " + name_of_signal(wish - stop)
                             : "stopped before the end of --walltime") +
                " at step " + std::to_string(at.step) + ", t = " + dem::shortest(at.time) +
                " s (" + at.phase + "), checkpoint " + last_.string() + ". " +
                how_to_continue());
}

void CheckpointScheduler::write_now(const dem::Communicator& comm, const Position& at,
                                    const std::function<void(dem::State&)>& save)
{
  const double start = spec_.clock();
  dem::State mine(comm.rank());
  const fs::path file = spec_.folder / dem::checkpoint_name(at.step);
  try {
    save(mine);
    dem::write_checkpoint(
        file, {MERGEL_VERSION, spec_.job, at.phase, spec_.case_text, at.step, at.time},
        std::move(mine), comm);
  } catch (const CollectiveFailure& e) {
    throw Remedied(e.what() + remedy());
  }
  if (comm.rank() == 0) dem::keep_newest(file, n_kept);
  last_ = file;
  signals_.checkpointed();
  asked_ = written_ = spec_.clock();
  longest_ = n_written_ == 0 ? written_ - start : std::max(longest_, written_ - start);
  has_estimate_ = true;
  ++n_written_;
}

void CheckpointScheduler::at_end(const dem::Communicator& comm, Position at,
                                 const std::function<void(dem::State&)>& save)
{
  at.phase = "finished";
  try {
    write_now(comm, at, save);
  } catch (const CollectiveFailure& e) {
    throw Remedied(std::string("the results are complete, but the run cannot be taken "
                               "further from its end: ") +
                   e.what());
  }
}

std::string CheckpointScheduler::how_to_continue() const
{
  return "Continue with: mergel " + spec_.job + " --restart " +
         in_shell(spec_.folder.string());
}

std::string CheckpointScheduler::remedy() const
{
  if (last_.empty()) return "; there is no checkpoint yet";
  return "; the last good checkpoint is " + last_.string() + ". " + how_to_continue();
}

std::string CheckpointScheduler::remedy_of_instability() const
{
  if (last_.empty()) return remedy();
  return "; the last checkpoint is " + last_.string() +
         ". Continued from it, the same run would fail again. Continue with the change "
         "named above where a restart may make it, or with a smaller time step: mergel " +
         spec_.job + " --restart " + in_shell(spec_.folder.string()) +
         " --set \"Motion/time step safety=...\"";
}

void CheckpointScheduler::rethrow_with_remedy(
    const std::function<void(const std::string&)>& write_results) const
{
  try {
    throw;
  } catch (const Remedied&) {
    throw;
  } catch (const Unstable& e) {
    std::string message = e.what() + remedy_of_instability();
    try {
      if (write_results) write_results(e.what());
    } catch (const CollectiveFailure& also) {
      message +=
          std::string("; the results until then could not be written: ") + also.what();
    }
    throw Remedied(message);
  } catch (const CollectiveFailure& e) {
    throw Remedied(e.what() + remedy());
  } catch (...) {
    const Verdict verdict = judge_current_exception();
    if (verdict.code != exit_failure) throw;
    throw NumericalError(verdict.message + remedy());
  }
}

} // namespace mergel::apps
