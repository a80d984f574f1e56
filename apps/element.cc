/// mergel element: lead a periodic cell of rock along any path of stress and strain.
#include "apps/element_output.h"
#include "apps/jobs.h"
#include "apps/output_folder.h"
#include "apps/progress.h"
#include "apps/ranks.h"
#include "apps/restart.h"

#include <iostream>
#include <optional>

namespace mergel::apps {

namespace {

std::string words(const ElementRecord& r)
{
  std::ostringstream out;
  out.precision(3);
  out << "p " << 1e-6 * r.whole.p() << "  q " << 1e-6 * r.whole.q() << " MPa  axial strain "
      << 100.0 * r.whole.axial_strain << " %  broken " << r.broken;
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
    run.step();
    const Outcome outcome = run.outcome();
    if (outcome != Outcome::goes_on || run.record_is_due()) add(run.record());
    if (outcome != Outcome::goes_on) {
      progress.done(words(records.back()));
      return outcome;
    }
    progress.update(run.progress(), [&] { return words(records.back()); });
  }
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
  const double width =
      c.size_effect.width > 0.0 ? c.size_effect.width : rock.cell.size.mean();
  const dem::PairMaterials materials = resolved_materials(c, width);
  std::cout << report(c, rock, materials) << '\n';

  std::optional<ElementHistory> history;
  on_first_rank([&] {
    folder.commit(inputs);
    file.write_resolved(folder.path() / "resolved.prm");
    history.emplace(folder.path() / "history.csv");
  });

  ElementRun run(c, std::move(rock), materials);
  ElementSummary s;
  s.n_particles = run.state().rock.particles.size();
  Outcome outcome = Outcome::done;
  for (std::size_t leg = 0; leg < c.legs.size() && outcome == Outcome::done; ++leg) {
    std::vector<ElementRecord> records;
    outcome =
        follow(run, leg, name_of(c.legs[leg]), records, history ? &*history : nullptr);
    s.legs.push_back(analyse(c, c.legs[leg], outcome, records));
    for (const ElementRecord& r : records) {
      s.worst_energy_error = std::max(s.worst_energy_error, std::abs(r.energy_error));
      s.greatest_inertial_number = std::max(s.greatest_inertial_number, r.inertial_number);
    }
    s.last = records.back();
  }

  s.critical = critical_states(c, s.last);
  s.greatest_rate = run.state().greatest_rate;
  s.n_steps = run.state().n_steps;
  s.n_limited = run.state().servo.n_limited;
  s.dt = run.state().dt;
  s.seconds = dem::wall_clock() - start;
  on_first_rank([&] { write_summary(folder.path() / "summary.json", s); });
  print_summary(folder.path(), s);
  return 0;
}

} // namespace mergel::apps
