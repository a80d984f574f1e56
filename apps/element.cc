/// mergel element: lead a periodic cell of rock along any path of stress and strain.
#include "apps/element_output.h"
#include "apps/jobs.h"
#include "apps/output_folder.h"
#include "apps/progress.h"
#include "apps/ranks.h"
#include "apps/restart.h"

#include <cmath>
#include <iostream>
#include <optional>

namespace mergel::apps {

namespace {

std::string words(const ElementRecord& r)
{
  std::ostringstream out;
  out.precision(3);
  out << "p " << 1e-6 * r.whole.p() << "  q " << 1e-6 * r.whole.q() << " MPa  axial strain "
      << 100.0 * r.whole.axial_strain() << " %  broken " << r.broken;
  return out.str();
}

/// Follow one leg to its end and append its records, the state at its start first.
Outcome follow(ElementRun& run, std::size_t leg, const std::string& name,
               std::vector<ElementRecord>& records, ElementHistory* history)
{
  run.set_out(leg);
  const auto add = [&](const ElementRecord& r) {
    records.push_back(r);
    if (history) history->add(r);
  };
  add(run.record());
  Progress progress("leg " + std::to_string(leg + 1) + ", " + name);
  for (;;) {
    const bool approached = run.is_approaching();
    run.step();
    const Outcome outcome = run.outcome();
    const bool begins = approached && !run.is_approaching();
    if (outcome != Outcome::goes_on || run.record_is_due() || begins) add(run.record());
    if (outcome != Outcome::goes_on) {
      progress.done(words(records.back()));
      return outcome;
    }
    progress.update(run.progress(), [&] { return words(records.back()); });
  }
}

/// What was found in the legs that were begun, and what it took.
ElementSummary summary_of(const ElementCase& c, const ElementRun& run,
                          const std::vector<Outcome>& outcomes,
                          const std::vector<ElementRecord>& records, double seconds)
{
  ElementSummary s;
  s.legs = analyse(c, outcomes, records);
  for (const ElementRecord& r : records) {
    s.worst_energy_error = std::max(s.worst_energy_error, std::abs(r.energy_error));
    s.greatest_inertial_number = std::max(s.greatest_inertial_number, r.inertial_number);
  }
  s.last = records.back();
  s.critical = critical_states(c, s.last);
  const ElementState& state = run.state();
  s.n_particles = state.rock.particles.size();
  s.greatest_rate = state.greatest_rate;
  s.n_steps = state.n_steps;
  s.n_limited = state.servo.n_limited;
  s.dt = state.dt;
  s.seconds = seconds;
  return s;
}

} // namespace

void help_element(std::ostream& out)
{
  CaseFile file;
  ElementCase c;
  declare(file, c);
  file.help(out);
}

int run_element(const JobOptions& options)
{
  const double start = dem::wall_clock();
  CaseFile file;
  ElementCase c;
  declare(file, c);
  on_every_rank([&] {
    read_case(file, options, std::nullopt);
    complete(file, c);
  });
  OutputFolder folder(options.output, Earlier::keep);
  on_first_rank([&] { folder = folder_to_begin_in(options); });
  std::vector<std::filesystem::path> inputs;
  if (options.restart.empty()) inputs.push_back(options.case_file);
  for (const auto& input : {c.specimen.sample, c.specimen.table})
    if (!input.empty()) inputs.push_back(input);
  on_first_rank([&] { folder.check(inputs); });

  ElementRock rock = obtain_rock(file, c);
  const dem::PairMaterials materials = resolved_materials(c, rock);
  std::cout << report(c, rock, materials) << '\n';

  std::optional<ElementHistory> history;
  on_first_rank([&] {
    folder.commit(inputs);
    file.write_resolved(folder.path() / "resolved.prm");
    history.emplace(folder.path() / "history.csv");
  });

  ElementRun run(c, std::move(rock), materials);
  std::vector<ElementRecord> records;
  std::vector<Outcome> outcomes;
  const auto close = [&] {
    if (!is_first_rank() || records.empty()) return;
    const ElementSummary s =
        summary_of(c, run, outcomes, records, dem::wall_clock() - start);
    write_summary(folder.path() / "summary.json", c, s);
    print_summary(folder.path(), s);
  };
  try {
    for (std::size_t leg = 0; leg < c.legs.size(); ++leg) {
      outcomes.push_back(Outcome::broke_off);
      outcomes.back() =
          follow(run, leg, name_of(c.legs[leg]), records, history ? &*history : nullptr);
      if (outcomes.back() != Outcome::done) break;
    }
  } catch (const NumericalError&) { // perhaps on one rank alone
    close();
    throw;
  }
  close();
  return 0;
}

} // namespace mergel::apps
