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
  std::vector<Index> member;
  std::vector<Index> all; ///< particles of the class, ascending

  std::size_t index(const Cells& c) const
  {
    return static_cast<std::size_t>((c[2] * n[1] + c[1]) * n[0] + c[0]);
  }
};

double reach_of(const ParticleState& b, double range)
{
  return b.R + 0.5 * range * b.S;
}

/// Images of all particles inside the cell, with the shifts that map them there.
struct Wrapped {
  std::vector<Vec3> x;
  std::vector<Shift> shift; ///< x = state.x - offset(shift)
};

Wrapped wrap(const Particles& p, const PeriodicCell& cell)
{
  Wrapped w;
  w.x.reserve(p.size());
  w.shift.assign(p.size(), Shift{});
  for (std::size_t i = 0; i < p.size(); ++i) {
    Vec3 x = p.state[i].x;
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
void sort_into_cells(Level& l, const Wrapped& w, const PeriodicCell& cell, const Vec3& low,
                     const Vec3& high)
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
  for (std::size_t k = 0; k < l.all.size(); ++k) l.member[next[at[k]]++] = l.all[k];
}

/// Visit every particle of the level in the 27 cells around x, with the periodic shift of
/// its image.
template <class Visit>
void visit_around(const Level& l, const Vec3& x, const PeriodicCell& cell, Visit&& visit)
{
  const Cells c = clamped(l, cell_of(l, x));
  std::array<std::array<long, 3>, 3> at{}, wraps{};
  std::array<std::size_t, 3> count{};
  for (std::size_t a = 0; a < 3; ++a)
    for (long o = -1; o <= 1; ++o) {
      long k = c[a] + o, s = 0;
      if (cell.size[static_cast<int>(a)] > 0.0) {
        s = k < 0 ? -1 : (k >= l.n[a] ? 1 : 0);
        k -= s * l.n[a];
      } else if (k < 0 || k >= l.n[a])
        continue;
      at[a][count[a]] = k;
      wraps[a][count[a]++] = s;
    }
  for (std::size_t z = 0; z < count[2]; ++z)
    for (std::size_t y = 0; y < count[1]; ++y)
      for (std::size_t q = 0; q < count[0]; ++q) {
        const std::size_t k = l.index({at[0][q], at[1][y], at[2][z]});
        const Shift s{static_cast<std::int16_t>(wraps[0][q]),
                      static_cast<std::int16_t>(wraps[1][y]),
                      static_cast<std::int16_t>(wraps[2][z])};
        for (Index m = l.start[k]; m < l.start[k + 1]; ++m) visit(l.member[m], s);
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

std::vector<Pair> find_pairs(const Particles& p, const PeriodicCell& cell, double range)
{
  if (p.size() == 0) return {};
  double largest = 0.0;
  for (const ParticleState& b : p.state) largest = std::max(largest, reach_of(b, range));
  for (int a = 0; a < 3; ++a)
    require(cell.size[a] == 0.0 || cell.size[a] >= 4.0 * largest,
            "the periodic cell is too small: edge " + std::to_string(cell.size[a]) +
                " m, at least " + std::to_string(4.0 * largest) +
                " m for its largest particles; enlarge the cell or lower the upscaling");

  const Wrapped w = wrap(p, cell);
  const std::vector<char> is_near = near_owned(p, w, cell, 2.0 * largest);
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  std::vector<Level> levels;
  std::vector<std::size_t> level_of(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!is_near[i]) continue;
    low = low.cwiseMin(w.x[i]);
    high = high.cwiseMax(w.x[i]);
    const double reach = reach_of(p.state[i], range);
    const auto l =
        static_cast<std::size_t>(std::clamp(std::ilogb(largest / reach), 0, finest_level));
    if (l >= levels.size()) levels.resize(l + 1);
    levels[l].all.push_back(static_cast<Index>(i));
    levels[l].reach = std::max(levels[l].reach, reach);
    level_of[i] = l;
  }
  for (Level& l : levels)
    if (!l.all.empty()) sort_into_cells(l, w, cell, low, high);

  std::vector<Pair> found;
  for (Index i = 0; i < p.size(); ++i) {
    if (!is_near[i]) continue;
    const bool is_mine = p.owns(i);
    const double reach_i = reach_of(p.state[i], range);
    for (std::size_t k = 0; k <= level_of[i]; ++k) {
      const Level& l = levels[k];
      if (l.all.empty()) continue;
      const bool same = k == level_of[i];
      visit_around(l, w.x[i], cell, [&](Index j, const Shift& s) {
        if ((same && j <= i) || !(is_mine || p.owns(j))) return;
        const double reach = reach_i + reach_of(p.state[j], range);
        if ((w.x[j] + cell.offset(s) - w.x[i]).squaredNorm() >= reach * reach) return;
        Pair q{i, j, {}};
        for (std::size_t a = 0; a < 3; ++a)
          q.shift[a] = static_cast<std::int16_t>(s[a] - w.shift[j][a] + w.shift[i][a]);
        if (j < i) {
          std::swap(q.i, q.j);
          for (auto& a : q.shift) a = static_cast<std::int16_t>(-a);
        }
        found.push_back(q);
      });
    }
  }
  return sorted(found, p.size());
}

double VerletList::travel(const Particles& p) const
{
  if (x_built_.size() != p.size()) return std::numeric_limits<double>::infinity();
  double max2 = 0.0; // of the motion over S
  p.for_owned([&](Index i) {
    const double S = p.state[i].S;
    max2 = std::max(
        max2,
        (p.state[i].x - x_built_[i].cwiseProduct(since_built_.stretch)).squaredNorm() /
            (S * S));
  });
  return std::sqrt(max2);
}

void VerletList::rebuild(const Particles& p, const PeriodicCell& cell, const Bonds& bonds,
                         Contacts& contacts)
{
  Contacts fresh;
  auto bonded = bonds.pairs.begin();
  std::size_t old = 0;
  for (const Pair& q : find_pairs(p, cell, g_a_ + skin_)) {
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
  is_narrowed_ = false;
  ++n_builds_;
}

void VerletList::narrow(const Particles& p, const PeriodicCell& cell, Contacts& contacts)
{
  // Each step costs 1/n of a pass over all candidates and n steps' worth of close ones: with
  // some hundreds of steps between two rebuilds their root is best.
  constexpr double steps_between_narrowings = 16.0;
  margin_ =
      std::clamp(2.0 * last_motion_ * steps_between_narrowings, skin_ / 32.0, skin_ / 4.0);
  std::vector<Index> close;
  contacts.is_narrowed = false;
  choose_contacts(g_a_ + margin_, cell, p, contacts, close);
  contacts.close = std::move(close);
  contacts.is_narrowed = true;
  since_narrowed_ = {};
  is_narrowed_ = true;
}

} // namespace mergel::dem
