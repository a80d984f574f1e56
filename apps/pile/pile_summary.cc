#include "apps/pile/pile_summary.h"

#include "apps/case/words.h"
#include "apps/run/progress.h"
#include "dem/io/atomic_file.h"
#include "dem/text.h"
#include "dem/timer.h"

#include <iostream>
#include <sstream>

namespace mergel::apps {

std::size_t count_debris(const dem::Assembly& assembly, double collar_height)
{
  std::size_t n = 0;
  assembly.particles.for_owned(
      [&](dem::Index i) { n += assembly.particles.state[i].x.z() > collar_height; });
  return assembly.comm.global_sum(n);
}

namespace {

struct Part {
  const char* name;
  double seconds;
};

/// Time of a step, and the parts of it in per cent.
std::string time_by_parts(const coupling::CoupledSystem& coupled, const Work& work)
{
  const dem::StepTimes& t = coupled.assembly.times;
  const double far = coupled.structure_seconds(), ex = coupled.exchange_seconds();
  const double whole = t.total() + far + ex;
  std::ostringstream out;
  out.precision(3);
  out << "time of a step: " << 1e6 * whole / static_cast<double>(work.n_steps) << " us in "
      << work.n_steps << " steps, "
      << 1e9 * whole / static_cast<double>(work.n_steps * coupled.assembly.particles.size())
      << " ns per particle;";
  for (const Part& s : {Part{"bonds", t.bonds},
                        {"contacts", t.contacts},
                        {"walls", t.walls},
                        {"motion", t.motion},
                        {"ranks", t.exchange},
                        {"lists", t.lists},
                        {"far field", far},
                        {"coupling", ex}})
    out << ' ' << s.name << ' ' << 100.0 * s.seconds / whole << " %,";
  out << " whole run " << duration_text(work.seconds);
  return out.str();
}

} // namespace

void write_summary(const std::filesystem::path& file, const Installation& run,
                   const coupling::CoupledSystem& coupled, std::size_t n_debris,
                   double seconds, const std::string& failure)
{
  const PileRecord& r = run.last();
  const BreakageCount& broken = run.breakage();
  std::ostringstream out;
  const auto number = [&](const char* name, double value, const char* end = ",\n") {
    out << "  \"" << name << "\": " << dem::shortest(value) << end;
  };
  const auto count = [](std::size_t n) { return static_cast<double>(n); };
  out << "{\n";
  if (!failure.empty()) out << "  \"failure\": " << in_json(failure) << ",\n";
  number("depth [m]", r.depth);
  number("tip depth [m]", r.tip_depth);
  number("q_c [Pa]", r.q_c);
  number("largest q_c [Pa]", run.peak());
  number("tip force of the full pile [N]", r.F_tip);
  number("shaft force of the full pile [N]", r.F_shaft);
  number("bonds [-]", count(run.n_bonds()));
  number("bonds broken [-]", count(r.broken));
  number("bonds between particles [-]", count(run.n_between()));
  number("broken between particles [-]", count(broken.all));
  number("broken within 2 D_p of the axis [-]", count(broken.near));
  number("broken more than D_p above the shoulder [-]", count(broken.above));
  number("particles above the collar [-]", count(n_debris));
  number("largest energy error [-]", run.worst_energy_error());
  number("largest interface force error [-]", run.worst_interface().force);
  number("largest interface moment error [-]", run.worst_interface().moment);
  number("largest interface power error [-]", run.worst_interface().power);
  number("particles [-]", count(coupled.assembly.particles.size()));
  number("far-field cells [-]", count(far_field_of(coupled).n_cells()));
  number("steps [-]", count(coupled.n_steps));
  number("time step [s]", coupled.dt);
  number("wall-clock time [s]", seconds, "\n");
  out << "}\n";
  dem::replace_file(file, out.str());
}

void print_summary(const std::filesystem::path& folder, const PileCase& c,
                   const Installation& run, const coupling::CoupledSystem& coupled,
                   std::size_t n_debris, const Work& work)
{
  const PileRecord& r = run.last();
  const BreakageCount& broken = run.breakage();
  const auto percent = [](std::size_t part, std::size_t whole) {
    return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
  };
  std::cout.precision(4);
  std::cout << "\npile at " << 1e3 * r.depth << " mm (" << r.depth / c.diameter
            << " D_p): q_c " << 1e-6 * r.q_c << " MPa, largest " << 1e-6 * run.peak()
            << " MPa; tip " << r.F_tip << " N, shaft " << r.F_shaft << " N (full pile)\n"
            << "bonds broken: " << r.broken << " of " << run.n_bonds() << ", " << broken.all
            << " of them between particles: " << percent(broken.near, broken.all)
            << " % within 2 D_p of the axis, " << broken.above
            << " more than D_p above the shoulder when they broke; " << n_debris
            << " particles are above the collar\n"
            << "largest energy error " << 100.0 * run.worst_energy_error()
            << " % of the input; largest interface errors " << run.worst_interface().force
            << " (force), " << run.worst_interface().moment << " (moment), "
            << run.worst_interface().power << " (power)\n"
            << time_by_parts(coupled, work) << "\nresults: " << folder.string()
            << " (history.csv, summary.json, *.pvd for ParaView); pictures: mergel-view "
            << folder.string() << "\n";
}

} // namespace mergel::apps
