/// Largest frequency of an assembly, with all that its springs connect (dem/README.md, Time
/// step).
#pragma once

#include "dem/assembly/springs.h"

#include <span>

namespace mergel::dem {

/// What moves the nodes of triangulated walls, as a linear system M a + K u = f: the
/// structures of a coupled run. Its amplitudes y are M^1/2 u. Every rank holds all of it.
/// Member functions are collective.
class WallSystem {
public:
  /// Number of amplitudes; 0 if nothing moves.
  virtual std::size_t size() const = 0;

  /// Motion of the nodes of each triangulated wall under these amplitudes; walls that do not
  /// move keep theirs, which is zero.
  /// @param u by wall and node [kg^-1/2]
  virtual void move(std::span<const double> y, std::vector<std::vector<Vec3>>& u) const = 0;

  /// M^-1/2 (K M^-1/2 y + N^T f) into `to`: f are the forces that resist the motion of the
  /// nodes, by wall and node.
  virtual void multiply(std::span<const double> y, const std::vector<std::vector<Vec3>>& f,
                        std::span<double> to) const = 0;

protected:
  ~WallSystem() = default;
};

/// Squared largest frequency [1/s^2] of M u'' + K u = 0 with the springs for K, by Lanczos
/// iteration from a start vector that follows from the ids. It converges from below; the
/// iteration ends when two products raise it by less than 1e-4 of itself, or after 60. Sums
/// are exact: the same bits on any number of ranks. Collective.
/// @param omega2_scale about its size but for the system of the walls, > 0 [1/s^2]: the
///   numbers of the iteration are of order 1
/// @param system of the triangulated walls; null: they are held
double largest_frequency2(const Assembly& assembly, const Springs& springs,
                          double omega2_scale, const WallSystem* system = nullptr);

} // namespace mergel::dem
