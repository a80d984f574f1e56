/// Triangulated walls moved from outside: nodal positions and velocities in, nodal forces
/// out.
#pragma once

#include "dem/laws/bond_law.h"
#include "dem/walls/wall_contact.h"

#include <array>
#include <optional>
#include <vector>

namespace mergel::dem {

using Triangle = std::array<int, 3>; ///< numbers of its nodes

/// Number of a node, triangle, edge or patch that there is, as an index.
inline std::size_t uz(int i)
{
  return static_cast<std::size_t>(i);
}

/// Edges and corners of a triangulation, and its smooth patches.
///
/// Normals follow the right-hand rule and point to the rock. A fold beyond 30 degrees
/// separates patches: a sphere in such a corner feels each side on its own, a sphere on a
/// smaller fold feels one force. On a ridge sharper than that, seen from outside, both sides
/// claim the edge and push in full: give such a body as an exact surface (surfaces.h).
struct WallTopology {
  std::vector<Triangle> triangles;
  std::vector<int> patch; ///< by triangle
  int n_patches = 0;
  /// By triangle: the triangle beyond edge (k, k+1) in the same patch, or -1.
  std::vector<std::array<int, 3>> across;
  std::vector<std::vector<int>> around; ///< triangles at each node
};

/// @param x reference node positions [m]
/// @throws InputError for a degenerate triangle, an edge shared by more than two, or
///   normals that disagree
WallTopology make_topology(const std::vector<Vec3>& x, std::vector<Triangle> triangles);

/// A point carried by a triangle.
struct Anchor {
  int triangle = -1;
  Vec3 weight = Vec3::Zero(); ///< barycentric coordinates, sum 1
};

/// A candidate when it was found. A triangle matters only once particle and wall have moved by
/// its clearance together.
struct ListedCandidate {
  struct Near {
    int triangle;
    double clearance; ///< of the particle's surface, beyond g_a S [m]
  };
  Vec3 x = Vec3::Zero();  ///< of the particle [m]
  std::vector<Near> near; ///< triangles of the patch within reach, ascending
};

/// A bond between a particle and a point of a wall: N and V only, bond length l = R.
struct WallBond {
  Index particle = 0;
  Anchor anchor;
  double gap_0 = 0.0;
  BondState state;
  Vec3 V = Vec3::Zero(); ///< effective shear force on the particle [N]
  double energy = 0.0;   ///< stored now [J]
};

/// What one contact or bond did to the wall in the last step.
struct WallPush {
  Vec3 f;        ///< on the particle [N]
  Vec3 point, v; ///< of the wall where it acts [m], [m/s]
};

struct Wall {
  WallTopology topology;
  std::vector<Vec3> x, v;     ///< nodes [m], [m/s]; whoever moves the wall writes them
  std::vector<VectorSum> f;   ///< on the nodes [N], of the last step, of all ranks
  std::vector<Vec3> x_listed; ///< nodes when the candidates were found [m]
  std::vector<WallContact> contacts;   ///< candidates, ascending in (particle, patch)
  std::vector<ListedCandidate> listed; ///< by contact
  std::vector<WallBond> bonds;         ///< ascending in particle
  LinearMaterial material;
  std::vector<WallPush> pushes; ///< of this rank's contacts and bonds in the last step
  std::vector<Vec3> normals;    ///< unit, by triangle; see update_normals()

  EnergySum energy() const; ///< stored by contacts and bonds of owned grains [J]
};

Wall make_wall(const std::vector<Vec3>& x, std::vector<Triangle> triangles,
               const LinearMaterial& material);

/// Where one sphere touches a patch: one touch shared by the touched features.
struct PatchTouch {
  Touch touch;
  struct Share {
    Anchor at;
    double weight;
  };
  static constexpr std::size_t most = 8;
  /// The first n count: weights sum to 1, touch.point is the sum of weight times point.
  std::array<Share, most> shares;
  std::size_t n = 0;
};

/// Features with a gap below g_a S count: the faces, edges and corners whose Voronoi region
/// holds the centre share the contact by their overlap; in a valley a second face enters with
/// the lead it has over the fold, so that the force is continuous.
/// @param wall_travel how far a node may have moved since the candidate was listed [m]
/// @throws NumericalError when the centre is on the wrong side of the wall
std::optional<PatchTouch> touch_patch(const Wall& wall, const ListedCandidate& candidate,
                                      const Body& body, double wall_travel);

/// Call after x changed and before touch_patch() or add_wall_forces().
void update_normals(Wall& wall);

/// Find the candidates: spheres whose gap to a triangle is below (g_a + skin) S. Good while
/// neither a sphere nor a node has moved by half of skin S.
void rebuild_wall(Wall& wall, const Particles& p, double skin);

/// Largest motion of a node since the candidates were found [m]; infinite before that.
double travel(const Wall& wall);

/// Bond every particle whose gap to a patch is below limit S [m] to its closest point there:
/// a particle in a corner is held by both sides. Once for a wall, else std::logic_error.
void bond_to_wall(Wall& wall, Particles& p, double limit);

/// What the wall's contacts and bonds of the last step sum to.
struct WallSums {
  VectorSum force; ///< on the grains [N]
  ExactVector<MomentSum>
      moment;      ///< on the grains, about the origin, at the points of action [N m]
  MomentSum power; ///< on the wall at the points of action [W]
};
WallSums sum_pushes(const Wall& wall); ///< of this rank

/// Add contacts and bonds to p.load and wall.f over the step dt [s] that ends now.
/// @param yields bonds follow the bond law; otherwise they stay elastic
/// @throws NumericalError naming the particle that is on the wrong side
void add_wall_forces(const BondLaw& law, bool yields, double dt, Particles& p, Wall& wall,
                     PairLosses& losses);

/// Point and velocity of an anchor.
Vec3 at(const std::vector<Vec3>& nodal, const WallTopology& t, const Anchor& a);

} // namespace mergel::dem
