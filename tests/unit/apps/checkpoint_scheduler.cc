#include "apps/run/checkpoint_scheduler.h"

#include "apps/case/case_file.h"
#include "dem/assembly/step.h"
#include "dem/error.h"
#include "dem/io/history.h"
#include "dem/timer.h"
#include "tests/support/catch.h"
#include "tests/support/temporary_folder.h"

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <new>
#include <sstream>
#include <utility>

#include <sys/wait.h>
#include <unistd.h>

using namespace mergel;
using namespace mergel::apps;
using mergel::match::Contains;
using mergel::match::StartsWith;
namespace fs = std::filesystem;

namespace {

/// The steps, of the first `n`, at which this checkpoint scheduler writes.
std::vector<std::uint64_t> steps_written(CheckpointScheduler& scheduler,
                                         const fs::path& folder, std::uint64_t n)
{
  std::vector<std::uint64_t> steps;
  for (std::uint64_t step = 1; step <= n; ++step) {
    scheduler.after_step(dem::Communicator(), {step, 1e-6, "driving"},
                         [](dem::State& state) {
                           state.add<double>("x", {1.0, 2.0});
                         });
    if (fs::exists(folder / dem::checkpoint_name(step))) steps.push_back(step);
  }
  return steps;
}

std::string content(const fs::path& file)
{
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

} // namespace

TEST_CASE("A cadence is a time, a number of steps or never", "[unit][apps]")
{
  CHECK(to_cadence("10 min").seconds == 600.0);
  CHECK(to_cadence("10 min").steps == 0);
  CHECK(to_cadence("5000 steps").steps == 5000);
  CHECK(std::isinf(to_cadence("5000 steps").seconds));
  CHECK(std::isinf(to_cadence("never").seconds));
  CHECK(to_cadence("never").steps == 0);
  for (const char* wrong : {"", "10", "10 mm", "0 s", "-1 min", "0 steps", "2.5 steps",
                            "-3 steps", "steps", "always"})
    CHECK_THROWS_AS(to_cadence(wrong), InputError);
}

TEST_CASE("Checkpoints are written at their steps, or at the next check after SIGUSR1",
          "[unit][apps]")
{
  const TemporaryFolder folder;
  CheckpointScheduler by_steps({.folder = folder.path,
                                .job = "pile",
                                .case_text = "",
                                .every = to_cadence("7 steps")});
  CHECK(steps_written(by_steps, folder.path, 30) ==
        std::vector<std::uint64_t>{7, 14, 21, 28});
  CHECK(dem::checkpoints_in(folder.path).size() == 2);
  CHECK_THAT(by_steps.remedy(),
             Contains("last good checkpoint is " + folder.path.string()));

  fs::remove_all(folder.path);
  fs::create_directories(folder.path);
  CheckpointScheduler on_signal(
      {.folder = folder.path, .job = "pile", .case_text = "", .every = {}});
  CHECK(steps_written(on_signal, folder.path, 30).empty());
  std::raise(SIGUSR1);
  CHECK(steps_written(on_signal, folder.path, 30) == std::vector<std::uint64_t>{10});
}

TEST_CASE("SIGTERM and the end of the walltime stop a run after a checkpoint",
          "[unit][apps]")
{
  const TemporaryFolder folder;
  CheckpointScheduler scheduler(
      {.folder = folder.path, .job = "pile", .case_text = "", .every = {}});
  std::raise(SIGTERM);
  CHECK_THROWS_WITH(steps_written(scheduler, folder.path, 30),
                    Contains("stopped by SIGTERM at step 10") &&
                        Contains("checkpoint_000000000010.h5") &&
                        Contains("mergel pile --restart " + folder.path.string()));
  CHECK(dem::read_checkpoint(folder.path / dem::checkpoint_name(10)).label.step == 10);

  CheckpointScheduler late(
      {.folder = folder.path, .job = "pile", .case_text = "", .every = {}, .end = 0.0});
  CHECK_THROWS_WITH(steps_written(late, folder.path, 30),
                    Contains("stopped before the end of --walltime at step 10"));
}

TEST_CASE("Ctrl-C, a closed terminal and the limits of a queue stop a run as SIGTERM does",
          "[unit][apps]")
{
  for (const auto& [signal, name] : {std::pair{SIGINT, "SIGINT"},
                                     {SIGHUP, "SIGHUP"},
                                     {SIGXCPU, "SIGXCPU"},
                                     {SIGUSR2, "SIGUSR2"}}) {
    const TemporaryFolder folder;
    std::signal(signal, SIG_DFL); // ignored where the tests run in the background
    CheckpointScheduler scheduler(
        {.folder = folder.path, .job = "pile", .case_text = "", .every = {}});
    std::raise(signal);
    CHECK_THROWS_WITH(steps_written(scheduler, folder.path, 30),
                      Contains("stopped by " + std::string(name) + " at step 10") &&
                          Contains("mergel pile --restart " + folder.path.string()));
    CHECK(fs::exists(folder.path / dem::checkpoint_name(10)));
  }
}

namespace {

/// How a process ends that does this: the number of the signal that ended it, or its exit
/// code with a minus.
int ending_signal(void (*task)())
{
  const pid_t child = ::fork();
  if (child == 0) {
    task();
    ::_exit(0);
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  return WIFSIGNALED(status) ? WTERMSIG(status) : -WEXITSTATUS(status);
}

} // namespace

TEST_CASE("A second Ctrl-C ends a run at once, and what was ignored stays ignored",
          "[unit][apps]")
{
  CHECK(ending_signal([] {
          std::signal(SIGINT, SIG_DFL);
          const Signals signals;
          std::raise(SIGINT);
          if (signals.stop() != SIGINT) ::_exit(1);
        }) == 0);
  CHECK(ending_signal([] {
          std::signal(SIGINT, SIG_DFL);
          const Signals signals;
          std::raise(SIGINT);
          std::raise(SIGINT);
        }) == SIGINT);
  CHECK(ending_signal([] {
          for (const int number : {SIGINT, SIGHUP}) std::signal(number, SIG_IGN);
          ignore_signals();
          for (const int number : {SIGINT, SIGHUP, SIGPIPE})
            std::signal(number, SIG_DFL); // as a library may
          ignore_signals_again();
          const Signals signals;
          for (const int number : {SIGINT, SIGHUP, SIGPIPE}) std::raise(number);
          if (signals.stop() != 0) ::_exit(1);
        }) == 0);
  CHECK(ending_signal([] {
          std::signal(SIGHUP, SIG_DFL);
          {
            const Signals signals;
          }
          std::raise(SIGHUP); // a job without checkpoints, or behind its last one
        }) == SIGHUP);
  CHECK(ending_signal([] {
          std::signal(SIGUSR2, SIG_IGN); // any handler of a library
          ignore_signals();
          {
            const Signals signals;
          }
          std::raise(SIGUSR2);
        }) == SIGUSR2);
}

TEST_CASE("The first checkpoint before the end of the walltime assumes a slow disk",
          "[unit][apps]")
{
  const TemporaryFolder folder;
  CheckpointScheduler scheduler({.folder = folder.path,
                                 .job = "pile",
                                 .case_text = "",
                                 .every = {},
                                 .end = 112.0,
                                 .clock = [] { return 100.0; }});
  const auto save_80_MB = [](dem::State& state) {
    state.add("x", std::vector<double>(10'000'000, 1.0));
  };
  // Of 12 s, twice 4 s at 20 MB/s and the margin of 2 s leave 2 s: no stop yet.
  scheduler.after_step(dem::Communicator(), {10, 1e-6, "driving"}, save_80_MB);
  CHECK(scheduler.n_written() == 0);
  CheckpointScheduler late({.folder = folder.path,
                            .job = "pile",
                            .case_text = "",
                            .every = {},
                            .end = 109.0,
                            .clock = [] { return 100.0; }});
  CHECK_THROWS_WITH(late.after_step(dem::Communicator(), {10, 1e-6, "driving"}, save_80_MB),
                    Contains("stopped before the end of --walltime at step 10"));
}

TEST_CASE("A failure of a library or of memory names the last good checkpoint",
          "[unit][apps]")
{
  const TemporaryFolder folder;
  const CheckpointScheduler scheduler({.folder = folder.path,
                                       .job = "pile",
                                       .case_text = "",
                                       .every = {},
                                       .restarted_from = "earlier.h5"});
  const auto rethrown = [&](const auto& error) {
    try {
      throw error;
    } catch (...) {
      scheduler.rethrow_with_remedy();
    }
  };
  CHECK_THROWS_WITH(rethrown(std::bad_alloc()),
                    Contains("out of memory") && Contains("checkpoint is earlier.h5"));
  CHECK_THROWS_WITH(rethrown(NumericalError("a NaN")),
                    Contains("a NaN; the last good checkpoint is earlier.h5"));
  CHECK_THROWS_WITH(rethrown(Unstable("too far")),
                    Contains("too far; the last checkpoint is earlier.h5") &&
                        Contains("--set \"Motion/time step safety=...\""));
  CHECK_THROWS_AS(rethrown(InputError("bad")), InputError);
  CHECK_THROWS_AS(rethrown(std::out_of_range("at 7")), std::out_of_range);
}

TEST_CASE(
    "Results up to an instability are written, and if that fails both errors are named",
    "[unit][apps]")
{
  const TemporaryFolder folder;
  const CheckpointScheduler scheduler(
      {.folder = folder.path, .job = "pile", .case_text = "", .every = {}});
  const auto fail = [&](const auto& error, const auto& write_results) {
    try {
      throw error;
    } catch (...) {
      scheduler.rethrow_with_remedy(write_results);
    }
  };
  std::string left;
  const auto leave = [&](const std::string& failure) { left = failure; };
  CHECK_THROWS_AS(fail(NumericalError("a NaN"), leave), NumericalError);
  CHECK(left.empty()); // the error is of one rank only
  CHECK_THROWS_AS(fail(Unstable("too far"), leave), Remedied);
  CHECK(left == "too far");
  CHECK_THROWS_WITH(fail(Unstable("too far"),
                         [](const std::string&) { throw CollectiveFailure("disk full"); }),
                    StartsWith("too far; there is no checkpoint yet") &&
                        Contains("disk full"));
}

TEST_CASE("A checkpoint that cannot be written names the last good one", "[unit][apps]")
{
  const TemporaryFolder folder;
  CheckpointScheduler scheduler({.folder = folder.path / "gone",
                                 .job = "pile",
                                 .case_text = "",
                                 .every = to_cadence("5 steps"),
                                 .restarted_from = "earlier.h5"});
  CHECK_THROWS_WITH(
      steps_written(scheduler, folder.path, 5),
      Contains("checkpoint_000000000005.h5: cannot be written: No such file") &&
          Contains("the last good checkpoint is earlier.h5"));
}

TEST_CASE("A history continues at its mark and nowhere else", "[unit][apps]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "history.csv";
  const std::vector<std::string> columns{"a [m]", "b [s]"};
  dem::HistoryMark mark;
  {
    dem::History history(file, columns);
    history.add({1.0, 2.0});
    mark = history.mark();
    history.add({3.0, 4.0});
  }
  const std::string whole = content(file);
  std::ofstream(file, std::ios::app) << "5,";
  {
    dem::History history(file, columns, file, mark);
    CHECK(content(file) == "a [m],b [s]\n1,2\n");
    history.add({3.0, 4.0});
  }
  CHECK(content(file) == whole);
  std::ofstream(file) << "a [m],b [s]\n1,3\n";
  CHECK_THROWS_WITH(dem::check_history(file, mark), Contains("does not begin as it did"));
  fs::remove(file);
  CHECK_FALSE(dem::check_history(file, mark));
  std::string begins_there;
  dem::HistoryMark later;
  for (int k = 0; k < 2; ++k) { // also where it was continued so before
    dem::History history(file, columns, file, mark);
    history.add({3.0, 4.0});
    later = history.mark();
    begins_there = content(file);
    CHECK_THAT(begins_there, StartsWith("# begins behind 16 bytes of checksum ") &&
                                 mergel::match::EndsWith("missing\na [m],b [s]\n3,4\n"));
    CHECK(later.bytes == begins_there.size());
    history.add({5.0, 6.0});
    CHECK(dem::check_history(file, mark));
    CHECK(dem::check_history(file, later));
  }
  dem::History history(file, columns, file, later);
  CHECK(content(file) == begins_there);
  CHECK_THROWS_AS(dem::check_history(file, {7, 7}), InputError);
}

TEST_CASE("The keys in which two resolved cases differ are found", "[unit][apps]")
{
  const auto read = [](const std::string& text, auto&& use) {
    CaseFile file;
    double length = 1e-3;
    std::string name = "x";
    {
      const auto section = file.section("A");
      file.quantity("length", length, "m", positive, "A length.", "mm");
      file.text("name", name, "A name.");
    }
    file.read_text(text, "case");
    use(file);
  };
  std::string earlier;
  read("", [&](CaseFile& file) { earlier = file.resolved_text(); });
  read("subsection A\n set length = 1000 um\nend\n", [&](CaseFile& file) {
    CHECK(file.changes_since(earlier).empty()); // the same bits
  });
  read("subsection A\n set length = 2 mm\n set name =\nend\n", [&](CaseFile& file) {
    const auto changes = file.changes_since(earlier);
    REQUIRE(changes.size() == 2);
    CHECK(changes[0].key == "length");
    CHECK(changes[0].was == "1 mm");
    CHECK(changes[0].is == "2 mm");
    CHECK(changes[1].was == "x");
    CHECK(changes[1].is.empty());
  });
}
