#include "dem/pairs/neighbours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mergel::dem {

namespace {

using Cells = std::array<long, 3>;

constexpr int finest_level = 30; ///< one class for all below 2^-30 of the largest

/// Particles of one size class, sorted into cells whose edges are at least twice the
/// largest reach among them.
struct Level {
  double reach = 0.0; ///< largest R + range S/2 in this class [m]
  Vec3 edge, origin;  ///< of the cells [m]
  Cells n{1, 1, 1};
  std::vector<Index> start; ///< first entry of the cell in `member`
  struct Member {
    Vec3 x;       ///< inside the cell [m]
    double reach; ///< [m]
    Index i;
  };
  std::vector<Member> member; ///< cell by cell: a search reads them one after the other
  std::vector<Index> all;     ///< particles of the class, ascending

  std::size_t index(const Cells& c) const
  {
    return static_cast<std::size_t>((c[2] * n[1] + c[1]) * n[0] + c[0]);
  }
};

/// Half of the distance up to which a pair counts, as far as it belongs to one particle [m].
struct Reach {
  const Particles& p;
  double range;
  const std::vector<double>& extra;

  double operator()(std::size_t i) const
  {
    const ParticleState& b = p.state[i];
    return b.R + 0.5 * range * b.S + (extra.empty() ? 0.0 : extra[i]);
  }
};

/// Images of all particles inside the cell, with the shifts that map them there.
struct Wrapped {
  std::vector<Vec3> x;
  std::vector<Shift> shift; ///< x = state.x - offset(shift)
};

/// @param at positions instead of those of p; empty: these
Wrapped wrap(const Particles& p, const PeriodicCell& cell, const std::vector<Vec3>& at)
{
  Wrapped w;
  w.x.reserve(p.size());
  w.shift.assign(p.size(), Shift{});
  for (std::size_t i = 0; i < p.size(); ++i) {
    Vec3 x = at.empty() ? p.state[i].x : at[i];
    for (int a = 0; a < 3; ++a)
      if (cell.size[a] > 0.0) {
        const double k = std::floor(x[a] / cell.size[a]);
        w.shift[i][static_cast<std::size_t>(a)] = static_cast<std::int16_t>(k);
        x[a] -= k * cell.size[a];
      }
    w.x.push_back(x);
  }
  return w;
}

Cells cell_of(const Level& l, const Vec3& x)
{
  Cells c;
  for (int a = 0; a < 3; ++a)
    c[static_cast<std::size_t>(a)] =
        static_cast<long>(std::floor((x[a] - l.origin[a]) / l.edge[a]));
  return c;
}

Cells clamped(const Level& l, Cells c)
{
  for (std::size_t a = 0; a < 3; ++a) c[a] = std::clamp(c[a], 0L, l.n[a] - 1);
  return c;
}

/// @param low, high bounding box of all particles
void sort_into_cells(Level& l, const Wrapped& w, const Reach& reach_of,
                     const PeriodicCell& cell, const Vec3& low, const Vec3& high)
{
  // No more cells than particles of the class, so that memory stays linear.
  const auto most = static_cast<double>(std::max<std::size_t>(l.all.size(), 64));
  // An elongated box needs several passes: a direction that is one cell wide stays so.
  double edge = 2.0 * l.reach;
  Vec3 length = high - low;
  for (int a = 0; a < 3; ++a)
    if (cell.size[a] > 0.0) length[a] = cell.size[a];
  const auto n_cells = [&] { return (length / edge).cwiseMax(1.0).prod(); };
  for (double n = n_cells(); n > most; n = n_cells())
    edge *= std::max(1.01, std::cbrt(n / most));

  l.origin = low;
  std::size_t total = 1;
  for (int a = 0; a < 3; ++a) {
    const auto ax = static_cast<std::size_t>(a);
    const bool periodic = cell.size[a] > 0.0;
    if (periodic) l.origin[a] = 0.0;
    l.n[ax] = std::max(1L, static_cast<long>(length[a] / edge));
    l.edge[a] = std::max(edge, length[a] / static_cast<double>(l.n[ax]));
    if (periodic) l.edge[a] = length[a] / static_cast<double>(l.n[ax]);
    total *= static_cast<std::size_t>(l.n[ax]);
  }
  l.start.assign(total + 1, 0);
  std::vector<std::size_t> at(l.all.size());
  for (std::size_t k = 0; k < l.all.size(); ++k) {
    at[k] = l.index(clamped(l, cell_of(l, w.x[l.all[k]])));
    ++l.start[at[k] + 1];
  }
  for (std::size_t c = 0; c < total; ++c) l.start[c + 1] += l.start[c];
  l.member.resize(l.all.size());
  std::vector<Index> next(l.start.begin(), l.start.end() - 1);
  for (std::size_t k = 0; k < l.all.size(); ++k) {
    const Index i = l.all[k];
    l.member[next[at[k]]++] = {w.x[i], reach_of(i), i};
  }
}

/// Visit the members of the level in the 27 cells around x, in runs of cells side by side:
/// visit(first, end, periodic shift of the images).
template <class Visit>
void visit_around(const Level& l, const Vec3& x, const PeriodicCell& cell, Visit&& visit)
{
  const Cells c = clamped(l, cell_of(l, x));
  struct Run {
    long first, last, shift;
  };
  std::array<std::array<Run, 3>, 3> runs{};
  std::array<std::size_t, 3> count{};
  for (std::size_t a = 0; a < 3; ++a)
    for (long o = -1; o <= 1; ++o) {
      long k = c[a] + o, s = 0;
      if (cell.size[static_cast<int>(a)] > 0.0) {
        s = k < 0 ? -1 : (k >= l.n[a] ? 1 : 0);
        k -= s * l.n[a];
      } else if (k < 0 || k >= l.n[a])
        continue;
      Run* const before = a == 0 && count[a] > 0 ? &runs[a][count[a] - 1] : nullptr;
      if (before && before->shift == s && before->last + 1 == k)
        before->last = k;
      else
        runs[a][count[a]++] = {k, k, s};
    }
  for (std::size_t z = 0; z < count[2]; ++z)
    for (std::size_t y = 0; y < count[1]; ++y)
      for (std::size_t q = 0; q < count[0]; ++q) {
        const Run &rx = runs[0][q], &ry = runs[1][y], &rz = runs[2][z];
        visit(l.start[l.index({rx.first, ry.first, rz.first})],
              l.start[l.index({rx.last, ry.first, rz.first}) + 1],
              Shift{static_cast<std::int16_t>(rx.shift),
                    static_cast<std::int16_t>(ry.shift),
                    static_cast<std::int16_t>(rz.shift)});
      }
}

/// Pairs in ascending order: sorted into buckets by i, each bucket sorted by j and shift.
std::vector<Pair> sorted(const std::vector<Pair>& found, std::size_t n_particles)
{
  std::vector<std::size_t> start(n_particles + 1, 0);
  for (const Pair& q : found) ++start[q.i + 1];
  for (std::size_t i = 0; i < n_particles; ++i) start[i + 1] += start[i];
  std::vector<Pair> out(found.size());
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  for (const Pair& q : found) out[next[q.i]++] = q;
  for (std::size_t i = 0; i < n_particles; ++i)
    std::sort(out.begin() + static_cast<std::ptrdiff_t>(start[i]),
              out.begin() + static_cast<std::ptrdiff_t>(start[i + 1]));
  return out;
}

/// Flags the particles that may form a pair with an owned one: those in the bounding box of
/// the owned particles widened by `reach`. All, in a periodic cell or where all are owned.
std::vector<char> near_owned(const Particles& p, const Wrapped& w, const PeriodicCell& cell,
                             double reach)
{
  if (p.n_owned() == p.size() || cell.is_periodic()) return std::vector<char>(p.size(), 1);
  std::vector<char> is_near(p.size(), 0);
  if (p.n_owned() == 0) return is_near;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  p.for_owned([&](Index i) {
    low = low.cwiseMin(w.x[i]);
    high = high.cwiseMax(w.x[i]);
  });
  low.array() -= reach;
  high.array() += reach;
  for (std::size_t i = 0; i < p.size(); ++i)
    is_near[i] =
        (w.x[i].array() >= low.array()).all() && (w.x[i].array() <= high.array()).all();
  return is_near;
}

} // namespace

std::vector<Pair> find_pairs(const Particles& p, const PeriodicCell& cell, double range,
                             const std::vector<double>& extra, const std::vector<Vec3>& x)
{
  if (p.size() == 0) return {};
  const Reach reach_of{p, range, extra};
  double largest = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) largest = std::max(largest, reach_of(i));
  for (int a = 0; a < 3; ++a)
    require(cell.size[a] == 0.0 || cell.size[a] >= 4.0 * largest,
            "the periodic cell is too small: edge " + std::to_string(cell.size[a]) +
                " m, at least " + std::to_string(4.0 * largest) +
                " m for its largest particles; enlarge the cell or lower the upscaling");

  const Wrapped w = wrap(p, cell, x);
  const std::vector<char> is_near = near_owned(p, w, cell, 2.0 * largest);
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  std::vector<Level> levels;
  std::vector<std::size_t> level_of(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!is_near[i]) continue;
    low = low.cwiseMin(w.x[i]);
    high = high.cwiseMax(w.x[i]);
    const double reach = reach_of(i);
    const auto l =
        static_cast<std::size_t>(std::clamp(std::ilogb(largest / reach), 0, finest_level));
    if (l >= levels.size()) levels.resize(l + 1);
    levels[l].all.push_back(static_cast<Index>(i));
    levels[l].reach = std::max(levels[l].reach, reach);
    level_of[i] = l;
  }
  for (Level& l : levels)
    if (!l.all.empty()) sort_into_cells(l, w, reach_of, cell, low, high);

  std::vector<Pair> found;
  for (Index i = 0; i < p.size(); ++i) {
    if (!is_near[i]) continue;
    const bool is_mine = p.owns(i);
    const double reach_i = reach_of(i);
    for (std::size_t k = 0; k <= level_of[i]; ++k) {
      const Level& l = levels[k];
      if (l.all.empty()) continue;
      const bool same = k == level_of[i];
      visit_around(l, w.x[i], cell, [&](Index first, Index end, const Shift& s) {
        const Vec3 centre = w.x[i] - cell.offset(s);
        for (Index m = first; m < end; ++m) {
          const Level::Member& other = l.member[m];
          const double reach = reach_i + other.reach;
          // The margin is for the round-off of motions that are added up.
          if ((other.x - centre).squaredNorm() >= reach * reach * (1.0 + 1e-12)) continue;
          const Index j = other.i;
          if ((same && j <= i) || !(is_mine || p.owns(j))) continue;
          Pair q{i, j, {}};
          for (std::size_t a = 0; a < 3; ++a)
            q.shift[a] = static_cast<std::int16_t>(s[a] - w.shift[j][a] + w.shift[i][a]);
          if (j < i) {
            std::swap(q.i, q.j);
            for (auto& a : q.shift) a = static_cast<std::int16_t>(-a);
          }
          found.push_back(q);
        }
      });
    }
  }
  return sorted(found, p.size());
}

double VerletList::travel(const Particles& p) const
{
  if (x_built_.size() != p.size()) return std::numeric_limits<double>::infinity();
  double largest = 0.0; // of the motion over S, beyond what the steps so far had to spare
  const double share =
      static_cast<double>(std::min(n_steps_since_built_, steps_of_flight)) /
      static_cast<double>(steps_of_flight);
  p.for_owned([&](Index i) {
    const ParticleState& b = p.state[i];
    const double extra = extra_.empty() ? 0.0 : share * extra_[i];
    const double most = largest * b.S + extra;
    const double moved2 =
        (b.x - x_built_[i].cwiseProduct(since_built_.stretch)).squaredNorm();
    if (moved2 > most * most) largest = (std::sqrt(moved2) - extra) / b.S;
  });
  return largest;
}

void VerletList::allow_for_flight(const Particles& p, double dt)
{
  constexpr double largest_share = 0.02; // of the particles: more are no debris
  constexpr double farthest = 1.0;       // over the diameter
  extra_.assign(p.size(), 0.0);
  spare_.clear();
  std::size_t n = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const ParticleState& b = p.state[i];
    const double way = b.v.norm() * dt * static_cast<double>(steps_of_flight);
    if (way <= 0.5 * skin_ * b.S) continue;
    extra_[i] = std::min(way, farthest * 2.0 * b.R);
    ++n;
  }
  if (n == 0 || static_cast<double>(n) > largest_share * static_cast<double>(p.size())) {
    extra_.clear();
    return;
  }
  for (const double extra : extra_)
    spare_.push_back(extra / static_cast<double>(steps_of_flight));
}

void VerletList::rebuild(const Particles& p, const PeriodicCell& cell, const Bonds& bonds,
                         Contacts& contacts, double dt)
{
  extra_.clear();
  spare_.clear();
  // An extra reach would need a wider cell (smallest_edge()).
  if (dt > 0.0 && std::isfinite(dt) && !cell.is_periodic()) allow_for_flight(p, dt);
  Contacts fresh;
  auto bonded = bonds.pairs.begin();
  std::size_t old = 0;
  for (const Pair& q : find_pairs(p, cell, g_a_ + skin_, extra_)) {
    while (bonded != bonds.pairs.end() && *bonded < q) ++bonded;
    if (bonded != bonds.pairs.end() && *bonded == q) continue;
    while (old < contacts.pairs.size() && contacts.pairs[old] < q) ++old;
    const bool known = old < contacts.pairs.size() && contacts.pairs[old] == q;
    fresh.pairs.push_back(q);
    fresh.shear.push_back(known ? contacts.shear[old] : ContactShear{});
  }
  contacts = std::move(fresh);
  x_built_.resize(p.size());
  smallest_skin_ = std::numeric_limits<double>::infinity();
  double largest = 0.0; // (R_i + R_j)/((S_i + S_j)/2) is at most twice the largest R/S
  for (std::size_t i = 0; i < p.size(); ++i) {
    x_built_[i] = p.state[i].x;
    smallest_skin_ = std::min(smallest_skin_, skin_ * p.state[i].S);
    largest = std::max(largest, p.state[i].R / p.state[i].S);
  }
  longest_reach_ = 2.0 * largest + g_a_ + skin_;
  since_built_ = {};
  n_steps_since_built_ = 0;
  ++n_builds_;
}

void VerletList::narrow(const Particles& p, const PeriodicCell& cell, Contacts& contacts)
{
  // With n steps in between a step costs (candidates)/n for the choice, and n times those that
  // come near in a step. The list lasts for some hundreds of steps, so n is about their root.
  constexpr double steps_between_narrowings = 16.0;
  margin_ =
      std::clamp(2.0 * last_motion_ * steps_between_narrowings, skin_ / 32.0, skin_ / 4.0);
  std::vector<double> flight;
  for (const double spare : spare_)
    flight.push_back(spare * static_cast<double>(steps_of_narrowed_flight));
  std::vector<Index> close;
  contacts.is_narrowed = false;
  choose_contacts(g_a_ + margin_, cell, p, contacts, close, flight);
  contacts.close = std::move(close);
  contacts.is_narrowed = true;
  since_narrowed_ = {};
  n_steps_since_narrowed_ = 0;
}

} // namespace mergel::dem
