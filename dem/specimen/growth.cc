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
    : p_(p), region_(region), comm_(comm), cell_(cell_of(region)), g_a_(g_a),
      list_(g_a, skin), separation_(p.size()), move_(p.size(), Vec3::Zero())
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

void Growth::update_list()
{
  if (list_.may_be_stale(p_) && list_.is_stale(comm_.global_max(list_.travel(p_)))) {
    partition_.gather_motion(p_, comm_);
    list_.rebuild(p_, cell_, {}, pairs_);
    choose_ghosts();
  }
  if (list_.is_narrowing_stale(pairs_)) list_.narrow(p_, cell_, pairs_);
}

void Growth::choose_ghosts()
{
  if (comm_.is_alone()) return;
  std::vector<char> is_needed(p_.size(), 0);
  for (const Pair& q : pairs_.pairs) is_needed[q.i] = is_needed[q.j] = 1;
  ghosts_.choose(p_, is_needed, partition_, comm_);
}

double Growth::separate_pairs(double size)
{
  double worst = 0.0;
  n_overlaps_ = 0;
  for (const Index c : pairs_.close) {
    const Pair& q = pairs_.pairs[c];
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
  update_list();
  std::fill(separation_.begin(), separation_.end(), Vec3::Zero());
  double worst = separate_pairs(size);
  worst = std::max(
      worst,
      std::visit([&](const auto& shape) { return separate_from_boundaries(shape, size); },
                 region_));
  constexpr double round_off = 1.0 + 1e-12;
  list_.add_motion(comm_.global_max(move()) * round_off);
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
