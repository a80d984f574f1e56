#include "dem/specimen/growth.h"

#include <algorithm>
#include <cmath>

namespace mergel::dem {

namespace {

// Share of each overlap that a sweep removes; with 12 neighbours 1/3 is the limit.
constexpr double relaxation = 0.3;
constexpr double memory = 0.8;       // share of the last move (heavy-ball method)
constexpr double longest_move = 0.2; // over the radius
constexpr int n_growing = 150;       // sweeps over which the sizes grow

} // namespace

Growth::Growth(Particles& p, const Region& region, double g_a, double skin,
               const Communicator& comm)
    : p_(p), region_(region), comm_(comm), cell_(cell_of(region)), g_a_(g_a), skin_(skin),
      separation_(p.size()), move_(p.size(), Vec3::Zero())
{
  partition_.assign_by_index(p_, comm_);
}

void Growth::gather()
{
  if (comm_.is_alone()) return;
  partition_.gather_motion(p_, comm_);
  p_.set_ownership(std::vector<char>(p_.size(), 1), std::vector<char>(p_.size(), 0));
  ghosts_.clear();
}

bool Growth::is_stale()
{
  if (x_listed_.empty()) return true;
  if (travel_ <= 0.5 * skin_) return false;
  double largest = 0.0;
  p_.for_owned([&](Index i) {
    largest = std::max(largest, (p_.state[i].x - x_listed_[i]).norm() / p_.state[i].S);
  });
  travel_ = comm_.global_max(largest);
  return travel_ > 0.5 * skin_;
}

void Growth::rebuild()
{
  partition_.gather_motion(p_, comm_);
  pairs_ = find_pairs(p_, cell_, g_a_ + skin_);
  x_listed_.resize(p_.size());
  for (std::size_t i = 0; i < p_.size(); ++i) x_listed_[i] = p_.state[i].x;
  choose_ghosts();
  travel_ = 0.0;
  narrow();
}

void Growth::choose_ghosts()
{
  if (comm_.is_alone()) return;
  std::vector<char> is_needed(p_.size(), 0);
  for (const Pair& q : pairs_) is_needed[q.i] = is_needed[q.j] = 1;
  ghosts_.choose(p_, is_needed, partition_, comm_);
}

/// Choose the pairs that may overlap at full size in the next sweeps. Most do not, and are
/// left out.
void Growth::narrow()
{
  constexpr double sweeps_between_choices = 16.0;
  margin_ = std::clamp(2.0 * last_move_ * sweeps_between_choices, skin_ / 64.0, skin_);
  close_.clear();
  for (const Pair& q : pairs_) {
    const ParticleState &i = p_.state[q.i], &j = p_.state[q.j];
    const double reach = i.R + j.R + 0.5 * (g_a_ + margin_) * (i.S + j.S);
    if ((j.x + cell_.offset(q.shift) - i.x).squaredNorm() < reach * reach)
      close_.push_back(q);
  }
  narrowed_travel_ = 0.0;
}

double Growth::separate_pairs(double size)
{
  double worst = 0.0;
  n_overlaps_ = 0;
  for (const Pair& q : close_) {
    const ParticleState &i = p_.state[q.i], &j = p_.state[q.j];
    const double reach = size * (i.R + j.R + 0.5 * g_a_ * (i.S + j.S));
    const Vec3 r = j.x + cell_.offset(q.shift) - i.x;
    const double d2 = r.squaredNorm();
    if (d2 >= reach * reach) continue;
    n_overlaps_ += p_.owns(q.i);
    const double d = std::sqrt(d2), overlap = reach - d;
    worst = std::max(worst, overlap / reach);
    const Vec3 n = d > 0.0 ? Vec3(r / d) : Vec3::UnitX();
    separation_[q.i] -= 0.5 * overlap * n;
    separation_[q.j] += 0.5 * overlap * n;
  }
  return worst;
}

template <class Shape>
double Growth::separate_from_boundaries(const Shape& shape, double size)
{
  double worst = 0.0;
  p_.for_owned([&](Index i) {
    const ParticleState& b = p_.state[i];
    const double R = size * b.R, shell = R + 0.5 * size * g_a_ * b.S;
    visit_boundaries(shape, b.x, R,
                     [&](double clearance, const Vec3& inwards, Boundary boundary) {
                       const double needed = boundary == Boundary::cut ? shell : R;
                       if (clearance >= needed) return;
                       separation_[i] += (needed - clearance) * inwards;
                       worst = std::max(worst, (needed - clearance) / needed);
                     });
  });
  return worst;
}

/// Returns the largest motion over S [m].
double Growth::move()
{
  double largest = 0.0;
  p_.for_owned([&](Index i) {
    ParticleState& b = p_.state[i];
    move_[i] = memory * move_[i] + relaxation * separation_[i];
    const double limit = longest_move * b.R, length = move_[i].norm();
    if (length > limit) move_[i] *= limit / length;
    b.x += move_[i];
    largest = std::max(largest, std::min(length, limit) / b.S);
  });
  return largest;
}

double Growth::sweep(double size)
{
  if (is_stale())
    rebuild();
  else if (2.0 * narrowed_travel_ > margin_)
    narrow();
  std::fill(separation_.begin(), separation_.end(), Vec3::Zero());
  double worst = separate_pairs(size);
  worst = std::max(
      worst,
      std::visit([&](const auto& shape) { return separate_from_boundaries(shape, size); },
                 region_));
  constexpr double round_off = 1.0 + 1e-12;
  last_move_ = comm_.global_max(move()) * round_off;
  travel_ += last_move_;
  narrowed_travel_ += last_move_;
  ghosts_.update(p_, comm_);
  return comm_.global_max(worst);
}

double grow(Growth& growth, const Sweeps& sweeps,
            const std::function<void(double)>& progress)
{
  const int n_growth_sweeps = sweeps.from < 1.0 ? n_growing : 0;
  double worst = 0.0;
  for (int k = 0; k < sweeps.most; ++k) {
    const double size =
        k < n_growth_sweeps ? sweeps.from + (1.0 - sweeps.from) * k / n_growth_sweeps : 1.0;
    worst = growth.sweep(size);
    if (k % 20 == 0) progress(static_cast<double>(k) / sweeps.most);
    if (k >= n_growth_sweeps && worst < sweeps.tolerance) break;
  }
  return worst;
}

} // namespace mergel::dem
