#include "apps/coupled/time_by_parts.h"

#include <sstream>
#include <vector>

namespace mergel::apps {

namespace {

struct Part {
  const char* name;
  double seconds;
};

} // namespace

std::string time_by_parts(const coupling::CoupledSystem& coupled, const Work& work,
                          const char* structures)
{
  if (work.n_steps == 0) return "";
  const dem::StepTimes& t = coupled.assembly.times;
  const double far = coupled.structure_seconds(), ex = coupled.exchange_seconds();
  const double whole = t.total() + far + ex;
  std::ostringstream out;
  out.precision(3);
  out << "time of a step: " << 1e6 * whole / static_cast<double>(work.n_steps) << " us in "
      << work.n_steps << " steps, "
      << 1e9 * whole / static_cast<double>(work.n_steps * coupled.assembly.particles.size())
      << " ns per particle;";
  std::vector<Part> parts{{"bonds", t.bonds},    {"contacts", t.contacts},
                          {"walls", t.walls},    {"motion", t.motion},
                          {"ranks", t.exchange}, {"lists", t.lists}};
  if (!coupled.structures.empty())
    parts.insert(parts.end(), {{structures, far}, {"coupling", ex}});
  for (const Part& s : parts)
    out << ' ' << s.name << ' ' << 100.0 * s.seconds / whole << " %,";
  out << ' ';
  return out.str();
}

} // namespace mergel::apps
