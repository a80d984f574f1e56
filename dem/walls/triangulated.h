/// Triangulated walls: the caller sets nodal positions and velocities, and gets nodal
/// forces (dem/README.md, Walls).
#pragma once

#include "dem/laws/bond_law.h"
#include "dem/math/nodal_sums.h"
#include "dem/walls/wall_contact.h"

#include <array>
#include <concepts>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

namespace mergel::dem {

using Triangle = std::array<int, 3>; ///< numbers of its nodes

/// Number of a node, triangle, edge or patch as an index. @pre i >= 0
inline std::size_t uz(int i)
{
  return static_cast<std::size_t>(i);
}

/// Which of three numbers n is: of the corners of a triangle, or of its neighbours. @pre it is one
inline std::size_t place_of(int n, const std::array<int, 3>& among)
{
  return among[0] == n ? 0 : among[1] == n ? 1 : 2;
}

/// Edges and corners of a triangulation, and its smooth patches.
///
/// Normals follow the right-hand rule and point to the particles. A fold of more than 30
/// degrees separates two patches: a particle in such a corner gets a force from each, at
/// a smaller fold that of one energy. At a convex ridge of more than 30 degrees
/// both patches act with their full force at the edge: use a rigid wall there
/// (rigid_wall.h).
struct WallTopology {
  std::vector<Triangle> triangles;
  std::vector<int> patch; ///< by triangle
  int n_patches = 0;
  /// By triangle: the neighbour across edge (k, k+1) in the same patch, or -1.
  std::vector<std::array<int, 3>> across;
  /// By triangle: the separate fans of its patch around each of its corners; 1 where they lie in
  /// a ring.
  std::vector<std::array<std::uint8_t, 3>> n_fans;
  std::vector<std::vector<int>> around; ///< by node: its triangles
};

/// Cosine of the largest fold inside a smooth patch: 30 degrees, or any.
inline const double smooth_fold = std::cos(pi / 6.0);
inline constexpr double any_fold = -2.0;

/// @param x reference node positions [m]
/// @throws InputError for a triangle without area, a node that does not exist, an edge of
///   more than two triangles, or normals that disagree
WallTopology make_topology(const std::vector<Vec3>& x, std::vector<Triangle> triangles,
                           double cos_fold = smooth_fold);

/// A point that moves with a triangle.
struct Anchor {
  int triangle = -1;
  Vec3 weight = Vec3::Zero(); ///< barycentric coordinates, sum 1
};

/// A triangle as it was when the candidates were found. It can be in contact only after
/// particle and wall together have moved by its clearance.
struct NearTriangle {
  int triangle;
  Triangle corners{}; ///< its nodes, as in WallTopology
  double clearance;   ///< gap to the particle less g_a S [m]
  /// Numbers of its corners and edges (k, k+1) among those of its candidate.
  std::array<std::uint16_t, 3> node{}, edge{};
  /// Bit k: it is the first of the candidate's triangles with this corner, with this edge.
  std::uint8_t owns_node = 0, owns_edge = 0;
  /// Bit k: counter-clockwise around corner k it is the first of a fan.
  std::uint8_t begins_fan = 0;
  std::array<std::uint8_t, 3> n_fans{}; ///< as in WallTopology
};

/// A candidate as it was found.
struct ListedCandidate {
  Vec3 x = Vec3::Zero();                ///< of the particle then [m]
  std::size_t first = 0, end = 0;       ///< its triangles among Wall::near
  std::size_t n_nodes = 0, n_edges = 0; ///< that these have
  double clearance = std::numeric_limits<double>::infinity(); ///< the smallest one [m]

  /// Bound of the motion of the particle against the wall since then [m].
  /// @param wall_travel bound of the motion of a node [m]
  double motion(const ParticleState& particle, double wall_travel) const
  {
    return (particle.x - x).norm() + margin(particle, wall_travel);
  }
  /// Whether no triangle can be in contact.
  bool is_apart(const ParticleState& particle, double wall_travel) const
  {
    const double left = clearance - margin(particle, wall_travel);
    return left > 0.0 && (particle.x - x).squaredNorm() < left * left;
  }

private:
  /// Round-off of the distances is far below a millionth of a radius.
  static double margin(const ParticleState& particle, double wall_travel)
  {
    return wall_travel + 1e-6 * particle.R;
  }
};

/// A bond between a particle and a point of a wall: N and V, no moment; bond length l = R.
struct WallBond {
  Index particle = 0;
  Anchor anchor;
  double gap_0 = 0.0; ///< gap at which the bond was made [m]
  BondState state;
  Vec3 V = Vec3::Zero(); ///< effective shear force on the particle [N]
};

/// Force of one contact or bond between a particle and the wall in the last step.
struct WallContactForce {
  Index particle;
  Vec3 f;        ///< on the particle [N]
  Vec3 point, v; ///< position and velocity of the wall where it acts [m], [m/s]
};

struct Wall {
  WallTopology topology;
  std::vector<Vec3> x, v; ///< of the nodes [m], [m/s]; set by the caller
  /// On the nodes in the last step, of all ranks [N]. Where it is shared each rank has those of
  /// its nodes only.
  NodalSums f;
  std::vector<Vec3> x_listed;          ///< nodes when the candidates were found [m]
  std::vector<WallContact> contacts;   ///< candidates, ascending in (particle, patch)
  std::vector<ListedCandidate> listed; ///< by contact
  std::vector<NearTriangle> near; ///< by candidate, the triangles of its patch ascending
  std::vector<WallBond> bonds;    ///< ascending in particle
  ContactLaw material;
  bool bonds_yield = false; ///< bonds follow the bond law; otherwise they stay elastic
  bool is_smooth = false;   ///< bonds and contacts get no shear force
  std::vector<WallContactForce>
      contact_forces; ///< of this rank's contacts and bonds in the last step
  /// On the particles by the motion of the nodes, of all ranks; where f is shared that of its
  /// nodes only [J].
  EnergySum work;

  std::span<const NearTriangle> near_triangles(const ListedCandidate& c) const
  {
    return std::span(near).subspan(c.first, c.end - c.first);
  }
};

Wall make_wall(const std::vector<Vec3>& x, std::vector<Triangle> triangles,
               const ContactLaw& material);

/// Unit normal of a triangle, to the side of the particles.
Vec3 normal(const Wall& wall, int t);

/// Find the candidates: particles whose gap to a triangle is below (g_a + skin) S plus their
/// extra reach (VerletList). They hold until a particle or a node has moved by half of
/// skin S.
void rebuild_wall(Wall& wall, const PairMaterials& material, const Particles& p,
                  double skin, const std::vector<double>& extra = {});

/// Largest motion of a node since the candidates were found [m]; infinite before that.
double travel(const Wall& wall);

/// Bond each particle whose gap to a patch is below limit S [m] to its closest point there:
/// a particle in a corner is bonded to both sides. Once for a wall, else std::logic_error.
void bond_to_wall(Wall& wall, Particles& p, double limit);

/// Anchors follow their particles along a smooth wall at rest: every bond keeps the direction
/// that it had before the particles moved by dt v. @param dt last step [s]
void slide_anchors(Wall& wall, const Particles& p, double dt);

/// Sums over the contacts and bonds of a wall in the last step.
struct WallSums {
  VectorSum force; ///< on the particles [N]
  ExactVector<MomentSum>
      moment;      ///< on the particles, about the origin, at the points of action [N m]
  MomentSum power; ///< on the wall at the points of action [W]
};
WallSums sum_contact_forces(const Wall& wall); ///< of this rank

/// Add contacts and bonds to p.load and wall.f over the step dt [s] that ends now.
/// @throws NumericalError naming the particle, as PatchFeatures::find()
void add_wall_forces(Wall& wall, const PairMaterials& material, double dt, Particles& p,
                     PairLosses& losses);

/// Stored by contacts and bonds of owned particles [J].
EnergySum stored_energy(const Wall& wall, const PairMaterials& material,
                        const Particles& p);

/// Work of the forces of the last step on the particles while the nodes move at their present
/// velocities for dt [s]: at all nodes, or where f is shared at those of this rank [J].
EnergySum work_over(const Wall& wall, double dt);

/// The records that belong to a particle and migrate with it.
inline auto histories(Wall& wall)
{
  return std::tie(wall.contacts, wall.bonds);
}

/// Show each exact sum, with its name, to `visit(name, kind, sum)`.
template <class AnyWall, class Visit>
requires std::same_as<std::remove_const_t<AnyWall>, Wall>
void visit_sums(AnyWall& wall, Visit&& visit)
{
  const bool is_shared = wall.f.is_shared();
  visit("force", is_shared ? SumKind::by_node : SumKind::forces, wall.f);
  visit("work", is_shared ? SumKind::by_rank : SumKind::total, wall.work);
}

/// Position or velocity of an anchor, from those of the nodes.
inline Vec3 at(const std::vector<Vec3>& nodal, const WallTopology& topo, const Anchor& a)
{
  const Triangle& t = topo.triangles[uz(a.triangle)];
  return a.weight[0] * nodal[uz(t[0])] + a.weight[1] * nodal[uz(t[1])] +
         a.weight[2] * nodal[uz(t[2])];
}

} // namespace mergel::dem
