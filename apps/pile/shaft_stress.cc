#include "apps/pile/shaft_stress.h"

#include <algorithm>
#include <cmath>

namespace mergel::apps {

namespace {

constexpr const char* name_in_state = "output_shaft_rings";
constexpr double travel_of_mean = 0.5; // diameters
constexpr double lowest_ring_of_d50 = 4.0;

} // namespace

ShaftRings::ShaftRings(const PileCase& c, double d_50)
    : height(std::max(0.5 * c.diameter, lowest_ring_of_d50 * d_50)),
      n(static_cast<std::size_t>(std::max(0.0, std::floor(c.deepest() / height))))
{
}

ShaftStress::ShaftStress(const PileCase& c)
    : R_(0.5 * c.diameter), share_(c.modelled_share()), tip_height_(c.tip_height()),
      travel_(travel_of_mean * c.diameter)
{
}

ShaftStress::ShaftStress(const PileCase& c, const dem::State& state) : ShaftStress(c)
{
  if (!state.has(name_in_state)) return; // older checkpoints
  // Height of the rings, the stage; then of each record depth, q_c, number of rings, and three
  // forces of each.
  const auto& all = state.get<double>(name_in_state);
  std::size_t at = 0;
  const auto next = [&] {
    if (at >= all.size()) dem::State::refuse(name_in_state, "ends too early");
    return all[at++];
  };
  if (all.empty()) return;
  rings_.height = next();
  stage_ = static_cast<std::uint64_t>(std::clamp(next(), 0.0, 1e9));
  while (at < all.size()) {
    Record r;
    r.tip_depth = next();
    r.q_c = next();
    const double n = next();
    if (!(n >= 0.0 && n <= 1e6))
      dem::State::refuse(name_in_state, "has no number of rings");
    for (double k = 0.0; k < n; k += 1.0) {
      dem::RingForce f;
      f.radial = next();
      f.around = next();
      f.vertical = next();
      r.forces.push_back(f);
    }
    rings_.n = r.forces.size();
    records_.push_back(std::move(r));
  }
}

void ShaftStress::save(dem::State& state, const ShaftStress* stress)
{
  std::vector<double> all;
  if (stress && !stress->records_.empty()) {
    all = {stress->rings_.height, static_cast<double>(stress->stage_)};
    for (const Record& r : stress->records_) {
      all.insert(all.end(), {r.tip_depth, r.q_c, static_cast<double>(r.forces.size())});
      for (const dem::RingForce& f : r.forces)
        all.insert(all.end(), {f.radial, f.around, f.vertical});
    }
  }
  state.add_common(name_in_state, std::move(all));
}

void ShaftStress::add(std::uint64_t stage, double tip_depth, double q_c,
                      const ShaftRings& rings, const std::vector<dem::RingForce>& forces)
{
  if (stage != stage_) records_.clear();
  stage_ = stage;
  rings_ = rings;
  records_.push_back({tip_depth, q_c, forces});
  while (std::abs(records_.front().tip_depth - tip_depth) >= travel_) records_.pop_front();
}

std::vector<RingStress> ShaftStress::mean() const
{
  std::vector<RingStress> stresses;
  if (records_.empty()) return stresses;
  const double area = 2.0 * dem::pi * R_ * rings_.height * share_; // of what is modelled
  for (std::size_t k = 0; k < rings_.n; ++k) {
    const double top = static_cast<double>(k + 1) * rings_.height;
    RingStress ring;
    double n = 0.0;
    for (const Record& r : records_) {
      if (r.tip_depth - tip_height_ < top || k >= r.forces.size()) continue;
      ring.radial += r.forces[k].radial / area;
      ring.shear += r.forces[k].vertical / area;
      n += 1.0;
    }
    if (n == 0.0) break;
    ring.h = top - 0.5 * rings_.height;
    ring.radial /= n;
    ring.shear /= n;
    stresses.push_back(ring);
  }
  return stresses;
}

double ShaftStress::mean_q_c() const
{
  double sum = 0.0;
  for (const Record& r : records_) sum += r.q_c / static_cast<double>(records_.size());
  return sum;
}

} // namespace mergel::apps
