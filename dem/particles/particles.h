/// Particles: their state, the loads on them, and which rank owns them.
#pragma once

#include "dem/notation.h"

#include <cstddef>
#include <vector>

namespace mergel::dem {

/// What the pair loop reads of a particle, in 96 bytes: three rows of four numbers, loaded
/// for a batch of pairs at a time. Separate arrays take 1.5 times as long, for each of them
/// costs a cache miss.
struct alignas(32) ParticleState {
  Vec3 x = Vec3::Zero();     ///< position [m]; never wrapped into a periodic cell
  double R = 0.0;            ///< radius [m]
  Vec3 v = Vec3::Zero();     ///< velocity [m/s], half a step behind x
  double S = 1.0;            ///< upscaling ratio [-]
  Vec3 omega = Vec3::Zero(); ///< spin [rad/s], half a step behind x
  double m = 0.0;            ///< mass [kg]

  double inertia() const { return 0.4 * m * R * R; } ///< solid sphere [kg m^2]
};
static_assert(sizeof(ParticleState) == 96);

/// Resultants on a particle, which the pair loop adds to: two rows of four numbers.
struct alignas(32) Load {
  Vec3 f = Vec3::Zero(); ///< resultant force [N]
  double pad_f = 0.0;
  Vec3 t = Vec3::Zero(); ///< resultant torque about the centre [N m]
  double pad_t = 0.0;
};
static_assert(sizeof(Load) == 64);

/// Indices from begin up to, not including, end.
struct IndexRange {
  Index begin, end;
};

/// Structure of arrays: index p names the same particle in every array and on every rank.
///
/// A rank moves the particles that it owns. It keeps its ghosts up to date, the particles
/// of other ranks that act on its own. All other entries are as old as the last neighbour
/// list (dem/parallel/partition.h).
struct Particles {
  std::vector<ParticleState> state;
  std::vector<Load> load;        ///< complete for owned particles, partial for ghosts
  std::vector<std::uint64_t> id; ///< global, never reused, ascending
  std::vector<int> n_bonds;      ///< intact bonds, with those to walls and mirror image
  std::vector<double> strength;  ///< factor of bond strengths [-]; empty: 1 (strength.h)
  /// Mass over the true mass, which has the weight [-]; empty: 1 (assembly/mass_scaling.h).
  std::vector<double> mass_factor;
  /// Constant force on each particle, such as its share of a surcharge [N]; empty: none.
  std::vector<Vec3> applied_force;

  std::size_t size() const { return state.size(); }
  std::size_t n_owned() const { return n_owned_; }
  bool owns(Index p) const { return is_owned_[p] != 0; }
  /// Owned particles, ascending, in the smallest possible number of ranges.
  const std::vector<IndexRange>& owned() const { return owned_; }
  /// Owned particles and ghosts.
  const std::vector<IndexRange>& present() const { return present_; }

  template <class Visit>
  void for_owned(Visit&& visit) const
  {
    for (const IndexRange& r : owned_)
      for (Index p = r.begin; p < r.end; ++p) visit(p);
  }

  /// Append an owned particle; its id is its index. @pre all particles are owned
  Index add(const ParticleState& b)
  {
    const auto p = static_cast<Index>(size());
    state.push_back(b);
    load.emplace_back();
    id.push_back(p);
    n_bonds.push_back(0);
    is_owned_.push_back(1);
    n_owned_ = size();
    owned_ = present_ = {{0, p + 1}};
    return p;
  }

  /// @param is_owned, is_ghost one entry per particle, never both set
  void set_ownership(std::vector<char> is_owned, const std::vector<char>& is_ghost)
  {
    n_owned_ = 0;
    owned_.clear();
    present_.clear();
    const auto append = [](std::vector<IndexRange>& ranges, Index p) {
      if (!ranges.empty() && ranges.back().end == p)
        ++ranges.back().end;
      else
        ranges.push_back({p, p + 1});
    };
    for (Index p = 0; p < size(); ++p) {
      if (is_owned[p]) append(owned_, p);
      if (is_owned[p] || is_ghost[p]) append(present_, p);
      n_owned_ += is_owned[p] != 0;
    }
    is_owned_ = std::move(is_owned);
  }

private:
  std::vector<char> is_owned_;
  std::vector<IndexRange> owned_, present_;
  std::size_t n_owned_ = 0;
};

/// Mass that has weight [kg].
inline double true_mass(const Particles& p, Index i)
{
  return p.mass_factor.empty() ? p.state[i].m : p.state[i].m / p.mass_factor[i];
}

/// Mass of a solid sphere [kg].
inline double sphere_mass(double R, double rho)
{
  return 4.0 / 3.0 * pi * R * R * R * rho;
}

} // namespace mergel::dem
