#include "apps/specimen/start_stress.h"

#include "dem/element/stress_path.h"

#include <sstream>

namespace mergel::apps {

namespace {

constexpr const char* name_in_state = "stress_at_start";

dem::SoilState soil(const dem::Vec3& stress)
{
  return {stress, dem::Vec3::Zero()};
}

} // namespace

std::string report_on_start(const dem::Vec3& stress, const std::string& where,
                            const std::string& borne_by)
{
  const dem::Vec3 MPa = 1e-6 * stress;
  std::ostringstream out;
  out.precision(3);
  out << "stress at the start, " << where << ": p " << soil(MPa).p() << ", q "
      << soil(MPa).q() << " MPa (x " << MPa.x() << ", y " << MPa.y() << ", z " << MPa.z()
      << " MPa), borne " << borne_by << '\n';
  return out.str();
}

void add_start(Summary& summary, const dem::Vec3& stress)
{
  summary.number("p at the start [Pa]", soil(stress).p());
  summary.number("q at the start [Pa]", soil(stress).q());
  summary.number("stress x at the start [Pa]", stress.x());
  summary.number("stress y at the start [Pa]", stress.y());
  summary.number("stress z at the start [Pa]", stress.z());
}

void save_start(dem::State& state, const dem::Vec3& stress)
{
  state.add_common<double>(name_in_state, {stress.x(), stress.y(), stress.z()}, 3);
}

dem::Vec3 load_start(const dem::State& state)
{
  const auto& s = state.get_rows<double>(name_in_state, 1, 3);
  return {s[0], s[1], s[2]};
}

} // namespace mergel::apps
