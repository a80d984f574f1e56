/// The springs of an assembly in its present state: the linear system from which its stable
/// step is computed (dem/README.md, Time step).
#pragma once

#include "dem/assembly/assembly.h"

namespace mergel::dem {

/// Bond and contact of a pair: springs between the two particles at their contact point.
struct PairSpring {
  Index i, j;
  double a_i, a_j; ///< arms [m]
  Vec3 n;          ///< unit normal from i to j
  double k_n, k_s; ///< [N/m]
  double k_b, k_t; ///< bending and twisting stiffness [N m]
};

/// Contact or bond of a particle with a wall.
struct WallSpring {
  static constexpr std::size_t held = SIZE_MAX;

  Index particle;
  double arm; ///< from the centre to the wall [m]
  Vec3 n;     ///< unit normal from the particle to the wall
  double k_n, k_s;
  std::size_t wall = held; ///< the triangulated wall, whose nodes may move; or held
  Anchor at = {};          ///< there
};

/// Bonds have their present stiffness 1 - D; contacts are those that are closed, or will be
/// soon. The image of a particle counts as a wall of twice the stiffness of the pair: it
/// moves against the particle. What a load adds to a stiffness by its own (geometric
/// stiffness) is left out.
struct Springs {
  std::vector<PairSpring> pairs; ///< with an owned particle, in the order of the forces
  std::vector<WallSpring> walls; ///< of owned particles
};

/// What lies ahead until the springs are looked at again.
struct Ahead {
  /// Contacts go on to close for this time at twice their present speed [s]. Infinite: all
  /// that are open by less than open_gap_counted() S close.
  double horizon = 0.0;
  bool walls_move = false; ///< triangulated walls; otherwise they are held
};

/// The overlap of a contact is the one that lies ahead, but at most open_gap_counted() S
/// larger than it is. Lists must be complete to that gap: complete_lists().
Springs linear_springs(const Assembly& assembly, const Ahead& ahead);

/// Largest gap beyond g_a of an open contact that counts, at S = 1 [m].
double open_gap_counted(const Assembly& assembly);

/// What resists the acceleration of a particle: 1/sqrt(m), and by axis 1/sqrt(I_p), which is
/// 0 about an axis about which the particle does not spin.
struct Mobility {
  double translation; ///< [kg^-1/2]
  Vec3 rotation;      ///< [kg^-1/2 m^-1]
};

/// By particle; zero for those that are not owned.
std::vector<Mobility> mobilities(const Assembly& assembly);

} // namespace mergel::dem
