/// mergel check: reads and checks a case of any job, and says what would run. No results.
#include "apps/case/job_of_case.h"
#include "apps/case/words.h"
#include "apps/run/command_line.h"
#include "apps/run/jobs.h"
#include "apps/run/plan.h"
#include "apps/run/ranks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <optional>
#include <string>

namespace mergel::apps {

namespace {

struct CheckOptions {
  JobOptions of_case;
  std::optional<double> cost; ///< of a particle and step [ns]; none: that of the plan
  int n_ranks = 0;            ///< 0: those of this program
};

/// Reads the case file, whose text then belongs to the options.
const Job& job_of(JobOptions& options)
{
  options.case_text = read_case_text(options.case_file);
  const CaseScan scan = scan_case(*options.case_text, options.case_file.string());
  const std::string name = name_of(job_of_case(scan, options.set));
  return *std::find_if(jobs.begin(), jobs.end(),
                       [&](const Job& job) { return name == job.name; });
}

/// A whole number with its thousands apart: "6,318".
std::string whole(double x)
{
  if (!(x < 1e15)) return three_digits(x);
  std::string digits = std::to_string(std::llround(x));
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(static_cast<std::size_t>(at), ",");
  return digits;
}

/// "2.5 h", "40 min", "12 s".
std::string duration(double seconds)
{
  if (seconds >= 3600.0) return three_digits(seconds / 3600.0) + " h";
  if (seconds >= 60.0) return three_digits(seconds / 60.0) + " min";
  return three_digits(seconds) + " s";
}

void line(const std::string& name, const std::string& text)
{
  std::string padded = name;
  padded.resize(std::max<std::size_t>(name.size(), 9), ' ');
  std::cout << "  " << padded << ' ' << printable(text) << '\n';
}

void print_steps(const Plan& plan, const CheckOptions& o, int n_ranks)
{
  if (plan.step > 0.0)
    line("step",
         three_digits(plan.step) +
             " s, within some 20 %: that of the smallest particle among `coordination` "
             "neighbours of mean size");
  line("steps", whole(plan.n_steps) + ": " + plan.steps_by);
  const double cost = o.cost.value_or(plan.cost);
  const RunTime time = time_of(plan, cost, n_ranks);
  const std::string membrane =
      plan.step_overhead > 0.0
          ? " and " + three_digits(1e6 * plan.step_overhead) + " us a step for the membrane"
          : "";
  line("time", duration(time.all()) + " on " + std::to_string(n_ranks) +
                   (n_ranks == 1 ? " rank" : " ranks") + ": start " + duration(time.start) +
                   (plan.is_made ? ", specimen " + duration(time.specimen) : "") +
                   ", steps " + duration(time.steps) + " at " + three_digits(cost) +
                   " ns a particle and step" + membrane +
                   " (--cost; mergel bench measures it)");
}

void print(const Job& job, const Plan& plan, const CheckOptions& o)
{
  const int n_ranks = std::max(1, o.n_ranks);
  std::cout << printable(o.of_case.case_file.string()) << ": a case of mergel " << job.name
            << ", which can run\n";
  line("particles", whole(plan.n_particles) + ": " + plan.particles_by);
  line("bonds", three_digits(plan.bonds_per_particle) + " a particle");
  if (plan.n_cells > 0.0) line("far field", whole(plan.n_cells) + " cells");
  if (plan.is_made)
    line("specimen", duration(time_of(plan, plan.cost, n_ranks).specimen) + " to make it");
  if (plan.n_steps > 0.0) print_steps(plan, o, n_ranks);
  line("memory", three_digits(1e-9 * memory_of(plan)) + " GB of the first rank");
  std::cout << lines_of(plan.unusual);
}

int run_check(CheckOptions o)
{
  int n_ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  if (o.n_ranks == 0) o.n_ranks = n_ranks;
  on_first_rank([&] {
    const Job& job = job_of(o.of_case);
    print(job, job.plan(o.of_case), o);
  });
  return 0;
}

} // namespace

void help_check(std::ostream& out)
{
  out << "  CASE.prm                   of any job: its sections tell which\n"
         "  --set \"Section/key=value\"  override a key of the case file; may be repeated\n"
         "  --ranks N                  count the hours on so many ranks; default: those of "
         "this program\n"
         "  --cost NS                  time of a particle and step on one core; default "
      << usual_cost
      << " ns,\n                             of bonded element and triaxial tests "
      << cost_of_test
      << " ns\n\n"
         "A case that a job would refuse is refused with the same message, exit code 1. Of "
         "one that\ncan run: job, particles, step, steps, time and memory, all estimates "
         "with their rule; then a\nline for each number that is seldom meant, with its "
         "usual "
         "bound. Nothing is written.\n";
}

std::function<int()> read_check(const std::vector<std::string>& arguments)
{
  CLI::App app;
  CheckOptions o;
  app.add_option("CASE.prm", o.of_case.case_file);
  app.add_option("--set", o.of_case.set)->expected(1)->take_all();
  app.add_option("--ranks", o.n_ranks);
  app.add_option("--cost", o.cost);
  parse(app, "mergel check", arguments);
  require(!o.of_case.case_file.empty(),
          "mergel check: no case file is given. See mergel check --help.");
  require(!o.cost || (std::isfinite(*o.cost) && *o.cost > 0.0),
          "mergel check: --cost must be a positive number of nanoseconds.");
  require(o.n_ranks >= 0, "mergel check: --ranks must be positive.");
  return [o] { return run_check(o); };
}

} // namespace mergel::apps
