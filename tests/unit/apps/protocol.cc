// The protocol of a job with checkpoints, driven by a job that counts.
#include "apps/run/protocol.h"
#include "dem/error.h"
#include "dem/io/history.h"
#include "tests/support/catch.h"
#include "tests/support/small_case.h"

#include <csignal>
#include <iostream>

using namespace mergel;
using namespace mergel::apps;
using mergel::apps::test::content;
using mergel::apps::test::WorkingFolder;
using mergel::match::Contains;
using mergel::match::StartsWith;
namespace fs = std::filesystem;

namespace {

/// Counts to a number; every count is a step and a line of history.csv.
class Counter : public CheckpointedJob {
public:
  const char* name() const override { return "count"; }
  void declare(CaseFile& file) override
  {
    {
      const auto section = file.section("Count");
      file.integer("to", last_, at_least(1.0), "Where it ends.");
      file.integer("by", by_, at_least(1.0), "A step.");
    }
    const auto section = file.section("Output");
    apps::declare(file, checkpoints_);
  }
  void complete(CaseFile& file) override { apps::complete(file, checkpoints_); }
  const CheckpointKey& checkpoints() const override { return checkpoints_; }
  Remarks unusual() const override { return {}; }
  std::vector<fs::path> inputs() const override { return {}; }
  std::vector<std::string> free_keys() const override { return {"Count/to"}; }
  void check_restart(const CaseFile& file, const Restart& restart) const override
  {
    if (n_in(restart) > static_cast<std::uint64_t>(last_))
      file.refuse("Count", "to", "the checkpoint is beyond it");
  }
  std::string what_is_done(const Restart& restart) const override
  {
    return n_in(restart) == static_cast<std::uint64_t>(last_) ? "it has counted." : "";
  }
  void begin(const CaseFile&, RunFolder& folder, MPI_Comm) override
  {
    folder.prepare();
    history_.emplace(folder.path() / "history.csv", columns_);
  }
  void resume(Restart& restart, RunFolder& folder, MPI_Comm) override
  {
    const auto& mark =
        restart.checkpoint.state.get_rows<std::uint64_t>("output_history", 2);
    n_ = n_in(restart);
    folder.prepare();
    history_.emplace(folder.path() / "history.csv", columns_,
                     restart.folder / "history.csv", dem::HistoryMark{mark[0], mark[1]});
  }
  void run(const std::function<void()>& after_step) override
  {
    while (n_ < static_cast<std::uint64_t>(last_)) {
      if (n_ + 1 == unlucky) throw Unstable("an unlucky number");
      n_ += static_cast<std::uint64_t>(by_);
      history_->add({static_cast<double>(n_)});
      if (n_ == at_signal) std::raise(SIGTERM);
      if (n_ < static_cast<std::uint64_t>(last_)) after_step();
    }
  }
  CheckpointScheduler::Position position() const override { return {n_, 0.0, "counting"}; }
  void save(dem::State& state) const override
  {
    const dem::HistoryMark mark = history_->mark();
    state.add_common<std::uint64_t>("n", {n_});
    state.add_common<std::uint64_t>("output_history", {mark.bytes, mark.sum});
  }
  void require_files() const override { history_->require_in_place(); }
  void summarise(Summary& summary, const Work& work) const override
  {
    summary.count("n [-]", n_);
    summary.count("steps [-]", work.n_steps);
    summary.closing << "counted to " << n_;
  }

  std::uint64_t unlucky = 0, at_signal = 0;

private:
  static std::uint64_t n_in(const Restart& restart)
  {
    return restart.checkpoint.state.get_rows<std::uint64_t>("n", 1).front();
  }

  const std::vector<std::string> columns_{"n [-]"};
  int last_ = 30, by_ = 1;
  CheckpointKey checkpoints_;
  std::optional<dem::History> history_;
  std::uint64_t n_ = 0;
};

/// Run it in the folder `out`, and return what it printed.
std::string count(const JobOptions& options, Counter job = {})
{
  std::ostringstream printed;
  auto* const before = std::cout.rdbuf(printed.rdbuf());
  int code = -1;
  try { // CHECK() would keep what is thrown
    code = run_job(job, options);
  } catch (...) {
    std::cout.rdbuf(before);
    throw;
  }
  std::cout.rdbuf(before);
  CHECK(code == 0);
  return printed.str();
}

JobOptions begins(const std::vector<std::string>& set = {})
{
  JobOptions options;
  options.case_file = "count.prm";
  options.set = set;
  options.output = "out";
  return options;
}
JobOptions restarts(const std::vector<std::string>& set = {})
{
  JobOptions options;
  options.set = set;
  options.output = options.restart = "out";
  return options;
}

std::vector<fs::path> checkpoints()
{
  return dem::checkpoints_in("out");
}

} // namespace

TEST_CASE("A run ends with its summary and a checkpoint from which it goes further",
          "[unit][apps]")
{
  const WorkingFolder here;
  test::write("count.prm", "");
  CHECK_THAT(count(begins({"Count/to=40"})), Contains("counted to 40"));
  const std::string whole = content("out/history.csv");
  fs::remove_all("out");

  count(begins({"Count/to=30"}));
  REQUIRE(checkpoints().size() == 1);
  CHECK(dem::read_checkpoint(checkpoints().front()).label.phase == "finished");
  CHECK(dem::read_checkpoint(checkpoints().front()).label.step == 30);
  CHECK_THAT(content("out/summary.json"), Contains("\"n [-]\": 30,\n"));

  CHECK_THAT(count(restarts({"Count/to=40"})),
             Contains("restart from out/checkpoint_000000000030.h5: finished, step 30") &&
                 Contains("Count/to was 30, is now 40"));
  CHECK(content("out/history.csv") == whole);
  CHECK_THAT(content("out/summary.json"), Contains("\"steps [-]\": 10,\n"));
  CHECK(checkpoints().size() == 2);
}

TEST_CASE("Restarting a finished run says what is done and changes nothing", "[unit][apps]")
{
  const WorkingFolder here;
  test::write("count.prm", "");
  count(begins());
  const auto written = [] {
    std::map<fs::path, fs::file_time_type> times;
    for (const auto& entry : fs::directory_iterator("out"))
      times[entry.path()] = entry.last_write_time();
    return times;
  };
  const auto before = written();
  CHECK(count(restarts()) == "out holds the finished run: it has counted.\n");
  CHECK(written() == before);

  // Killed before its summary, it is written again; another folder gets its own results.
  fs::remove("out/summary.json");
  CHECK_THAT(count(restarts()), Contains("counted to 30"));
  CHECK(fs::exists("out/summary.json"));
  JobOptions elsewhere = restarts();
  elsewhere.output = "other";
  CHECK_THAT(count(elsewhere), Contains("results: other"));
  CHECK(content("other/history.csv") == content("out/history.csv"));
}

TEST_CASE("`checkpoint at end = false` leaves a finished run without a checkpoint",
          "[unit][apps]")
{
  const WorkingFolder here;
  test::write("count.prm", "subsection Output\n  set checkpoint at end = false\nend\n");
  count(begins());
  CHECK(checkpoints().empty());
  CHECK_THROWS_WITH(count(restarts()), Contains("holds a finished run"));
}

TEST_CASE("SIGTERM stops a job behind a checkpoint, and the restart ends alike",
          "[unit][apps]")
{
  const WorkingFolder here;
  test::write("count.prm", "");
  count(begins());
  const std::string whole = content("out/history.csv");
  fs::remove_all("out");

  Counter stopped;
  stopped.at_signal = 15;
  CHECK_THROWS_WITH(count(begins(), std::move(stopped)),
                    Contains("stopped by SIGTERM at step 20") &&
                        Contains("Continue with: mergel count --restart out"));
  CHECK(!fs::exists("out/summary.json"));
  CHECK_THROWS_WITH(count(restarts({"Count/to=15"})), Contains("beyond it"));
  CHECK_THROWS_WITH(count(restarts({"Count/by=2"})),
                    Contains("Count/by was 1, the case asks for 2"));
  count(restarts());
  CHECK(content("out/history.csv") == whole);
}

TEST_CASE("A job that goes unstable leaves failed.json with what it found", "[unit][apps]")
{
  const WorkingFolder here;
  test::write("count.prm", "");
  Counter failing;
  failing.unlucky = 13;
  CHECK_THROWS_WITH(count(begins(), std::move(failing)), Contains("an unlucky number"));
  CHECK_THAT(content("out/failed.json"),
             StartsWith("{\n  \"failure\": \"an unlucky number\",\n  \"n [-]\": 12,\n  "
                        "\"steps [-]\": 12,\n  \"made by\": {\"program\": \"mergel "));
  CHECK(!fs::exists("out/summary.json"));
  CHECK(checkpoints().empty());
}
