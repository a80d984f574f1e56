/// Forces between particles and a triangulated wall, a batch at a time.
#include "dem/laws/bond_step.h"
#include "dem/math/lane_sum.h"
#include "dem/pairs/batch.h"
#include "dem/pairs/strength.h"
#include "dem/walls/feature_forces.h"
#include "dem/walls/triangle.h"

#include <algorithm>
#include <cmath>

namespace mergel::dem {

namespace {

Row row_of(const Vec3& a)
{
  return Row{a.x(), a.y(), a.z(), 0.0};
}
Vec3 vec3(const Row& r)
{
  return {r[0], r[1], r[2]};
}

/// A vector for each lane, transposed. @param of_lane its row
template <class OfLane>
[[gnu::always_inline]] inline Triple<Lanes> triples(OfLane&& of_lane)
{
  Row r[n_lanes];
  for (int l = 0; l < n_lanes; ++l) r[l] = of_lane(l);
  Triple<Lanes> a;
  Lanes unused;
  columns(r, a.x, a.y, a.z, unused);
  return a;
}

/// One row of a vector for each lane.
struct LaneRows {
  Row of[n_lanes];

  [[gnu::always_inline]] explicit LaneRows(const Triple<Lanes>& a)
  {
    rows(a.x, a.y, a.z, of);
  }
};

/// What the loops over contacts and bonds share.
struct WallStep {
  Wall& wall;
  double dt;
  Particles& p;
  PairLosses& losses;

  const Triangle& triangle(int t) const { return wall.topology.triangles[uz(t)]; }
  /// Of a corner of a triangle.
  Row row_of_corner(const std::vector<Vec3>& nodal, int t, std::size_t k) const
  {
    return row_of(nodal[uz(triangle(t)[k])]);
  }

  /// A force on a particle, whose opposite acts on the wall.
  /// @param weight of the corners of the triangle t; @param x, v where the force acts
  void add(Index particle, const Row& F, const Row& M, int t, const Row& weight,
           const Row& x, const Row& v)
  {
    Load& load = p.load[particle];
    add_row(load.f.data(), F);
    add_row(load.t.data(), M);
    add_to_nodes(t, weight, -F);
    wall.contact_forces.push_back({particle, vec3(F), vec3(x), vec3(v)});
  }

  /// Where a force acts on a particle, its opposite acts on the wall.
  /// @param v of the wall there
  void add_to_wall(Index particle, const Vec3& force, const PatchFeature& where,
                   const Vec3& v)
  {
    add_to_nodes(where.at.triangle, row_of(where.at.weight), row_of(-force));
    wall.contact_forces.push_back({particle, force, where.point, v});
  }

  /// Shares of a force to the corners of a triangle. @param weight of the corners
  void add_to_nodes(int t, const Row& weight, const Row& force)
  {
    for (int k = 0; k < 3; ++k)
      if (weight[k] != 0.0) wall.f.add(uz(triangle(t)[uz(k)]), weight[k] * force);
  }
};

/// Contacts with the only triangle that is near, a batch at a time; all others one by one. A
/// contact in a batch gets the same bits as by itself, and a particle its forces in the order
/// of its contacts.
template <IsContactLaw Law>
class ContactForces {
public:
  ContactForces(WallStep& step, const Law& law)
      : step_(step), law_(law), moved_(travel(step.wall))
  {
  }

  void add_all()
  {
    for (std::size_t c = 0; c < step_.wall.contacts.size(); ++c) {
      const Index particle = step_.wall.contacts[c].particle;
      const int t = only_triangle(c);
      if (t == none) {
        open(c);
      } else if (t == several) {
        if (count_ > 0 && particle_[count_ - 1] == particle) add_batch();
        add_one(c);
      } else {
        contact_[count_] = c;
        particle_[count_] = particle;
        triangle_[count_] = t;
        if (++count_ == n_lanes) add_batch();
      }
    }
    if (count_ > 0) add_batch();
  }

private:
  static constexpr int none = -1, several = -2;

  /// The triangle that a candidate may touch.
  int only_triangle(std::size_t c) const
  {
    const ListedCandidate& candidate = step_.wall.listed[c];
    const ParticleState& b = step_.p.state[step_.wall.contacts[c].particle];
    if (candidate.is_apart(b, moved_)) return none;
    const double motion = candidate.motion(b, moved_);
    int found = none;
    for (const NearTriangle& near : step_.wall.near_triangles(candidate)) {
      if (near.clearance > motion) continue;
      if (found != none) return several;
      found = near.triangle;
    }
    return found;
  }

  void open(std::size_t c)
  {
    WallContact& contact = step_.wall.contacts[c];
    open_contact(law_, step_.p.state[contact.particle].R, contact, step_.losses);
  }

  void add_one(std::size_t c)
  {
    Wall& wall = step_.wall;
    WallContact& contact = wall.contacts[c];
    const ParticleState& particle = step_.p.state[contact.particle];
    with_particle_id(step_.p.id[contact.particle], [&] {
      features_.find(wall, wall.listed[c], particle, moved_);
      return 0;
    });
    const std::vector<PatchFeature>& found = features_.found();
    if (found.empty()) return open(c);
    if (found.size() > 1 || found.front().sign != 1.0)
      return add_several(contact, particle);
    const PatchFeature& only = found.front(); // the same bits as in a batch
    const Vec3 v = at(wall.v, wall.topology, only.at);
    const Vec3 f = add_wall_contact(
        law_, {only.n, only.distance - particle.R, only.point, v}, step_.dt, particle,
        step_.p.load[contact.particle], contact, step_.losses);
    step_.add_to_wall(contact.particle, f, only, v);
  }

  void add_several(WallContact& contact, const ParticleState& particle)
  {
    acting_.clear();
    for (const PatchFeature& f : features_.found())
      acting_.push_back({&f, at(step_.wall.v, step_.wall.topology, f.at)});
    add_feature_forces(law_, acting_, step_.dt, particle, step_.p.load[contact.particle],
                       contact, step_.losses);
    for (const ActingFeature& acting : acting_)
      step_.add_to_wall(contact.particle, acting.force, *acting.feature, acting.v);
  }

  void add_batch()
  {
    Wall& wall = step_.wall;
    const int count = count_;
    count_ = 0;
    for (int l = count; l < n_lanes; ++l) { // padding
      contact_[l] = contact_[count - 1];
      particle_[l] = particle_[count - 1];
      triangle_[l] = triangle_[count - 1];
    }
    const End<Lanes> b = gather(step_.p.state.data(), [&](int l) { return particle_[l]; });
    const auto corners = [&](const std::vector<Vec3>& nodal, std::size_t k) {
      return triples([&](int l) { return step_.row_of_corner(nodal, triangle_[l], k); });
    };
    const TriangleRegions<Lanes> regions(b.x, corners(wall.x, 0), corners(wall.x, 1),
                                         corners(wall.x, 2));
    const TrianglePoint<Lanes> face = point_of_face(regions);
    const Triple<Lanes> r = face.x - b.x;
    const Lanes distance = sqrt(dot(r, r));
    const Lanes gap = distance - b.R, overlap = activation_gap(law_) * b.S - gap;
    const Mask is_face = regions.well_inside_face(), overlaps = overlap > Lanes{};
    const Mask is_closed = is_face & overlaps & regions.is_in_front();

    const Triple<Lanes>&w = face.weight, v = corners(wall.v, 0) * w.x +
                                             corners(wall.v, 1) * w.y +
                                             corners(wall.v, 2) * w.z;
    const Triple<Lanes> f_s =
        triples([&](int l) { return row_of(wall.contacts[contact_[l]].f_s); });
    const WallContactStep<Lanes> now = wall_contact_step(
        law_, b, WallPoint<Lanes>{r * (1.0 / distance), gap, face.x, v}, f_s, step_.dt);
    const unsigned closed = bits_of(is_closed),
                   open_faces = bits_of(is_face & (overlap <= Lanes{}));
    slip_.add(select(lanes_of(closed & ((1u << count) - 1u)), now.slip_loss, Lanes{}));

    const LaneRows F(now.F), M(now.M), weight(w), x(face.x), v_rows(v), f_s_rows(now.f_s);
    for (int l = 0; l < count; ++l) {
      if (closed >> l & 1u) {
        WallContact& contact = wall.contacts[contact_[l]];
        contact.f_s = vec3(f_s_rows.of[l]);
        contact.overlap = overlap[l];
        step_.add(particle_[l], F.of[l], M.of[l], triangle_[l], weight.of[l], x.of[l],
                  v_rows.of[l]);
      } else if (open_faces >> l & 1u) {
        open(contact_[l]);
      } else { // near an edge, on the wrong side, or not a number
        add_one(contact_[l]);
      }
    }
  }

  WallStep& step_;
  const Law law_;
  const double moved_;
  LaneEnergySum<Lanes> slip_{step_.losses.slip};
  int count_ = 0; ///< of the batch that is being filled
  std::size_t contact_[n_lanes];
  Index particle_[n_lanes];
  int triangle_[n_lanes];
  PatchFeatures features_;            ///< of the contact at hand
  std::vector<ActingFeature> acting_; ///< of a contact with several
};

/// Bonds to a wall, a batch at a time.
template <IsBondLaw Law>
class BondForces {
public:
  BondForces(WallStep& step, const Law& law) : step_(step), law_(law) {}

  void add_all()
  {
    for (WallBond& bond : step_.wall.bonds) {
      if (bond.state.intact == 0.0) continue;
      bond_[count_] = &bond;
      if (++count_ == n_lanes) add_batch();
    }
    if (count_ > 0) add_batch();
  }

private:
  /// The wall at the anchor of a bond.
  Row at_anchor(const std::vector<Vec3>& nodal, const WallBond& bond) const
  {
    const auto corner = [&](std::size_t k) {
      return step_.row_of_corner(nodal, bond.anchor.triangle, k);
    };
    const Vec3& w = bond.anchor.weight;
    return w[0] * corner(0) + w[1] * corner(1) + w[2] * corner(2);
  }

  /// Return a bond that yields. @param old, load as of bond_step()
  void yield(WallBond& bond, const BondShape<double>& shape,
             const EffectiveLoads<double>& old, EffectiveLoads<double>& load)
  {
    Particles& p = step_.p;
    const Law law = with_strengths_times(strength_of(p, bond.particle), law_);
    if (is_elastic(law, shape, load)) return;
    if (!bond_step(law, shape, p.state[bond.particle].S, old, load, bond.state,
                   &step_.losses)
             .breaks)
      return;
    --p.n_bonds[bond.particle];
    load = {}; // carries nothing any more
  }

  void add_batch()
  {
    const Wall& wall = step_.wall;
    const int count = count_;
    count_ = 0;
    for (int l = count; l < n_lanes; ++l) bond_[l] = bond_[count - 1]; // padding
    const End<Lanes> b =
        gather(step_.p.state.data(), [&](int l) { return bond_[l]->particle; });
    Row x[n_lanes], v[n_lanes];
    for (int l = 0; l < n_lanes; ++l) {
      x[l] = at_anchor(wall.x, *bond_[l]);
      v[l] = at_anchor(wall.v, *bond_[l]);
    }
    const End<Lanes> anchor{triples([&](int l) { return x[l]; }), Lanes{},
                            triples([&](int l) { return v[l]; }), b.S, Triple<Lanes>{}};
    const PairMotion<Lanes> k = pair_motion(b, anchor, step_.dt, 1.0);
    const BondShape<Lanes> shape = bond_shape(law_, b.R, 1.0 / b.R);
    // The return of a bond that yields divides by its stiffness: that of a smooth wall stays,
    // and the shear does not grow.
    const Lanes k_s = wall.is_smooth ? Lanes{} : shape.k_s;
    const Triple<Lanes> history = triples([&](int l) {
      const WallBond& bond = *bond_[l];
      return Row{bond.gap_0, bond.state.u_p, bond.state.intact, 0.0};
    });
    const Triple<Lanes> V =
        rotated_with_contact(triples([&](int l) { return row_of(bond_[l]->V); }), k);
    EffectiveLoads<Lanes> load{shape.k_n * (k.gap - history.x - history.y),
                               V + k.du_s * k_s, Triple<Lanes>{}};
    Lanes intact = history.z;
    if (wall.bonds_yield)
      for (int l = 0; l < count; ++l) {
        const BondShape<double> s{shape.R_b[l], shape.A[l],   shape.k_n[l],
                                  shape.k_s[l], shape.k_b[l], shape.k_t[l]};
        EffectiveLoads<double> now{load.N[l], lane(load.V, l), Triple<double>{}};
        yield(*bond_[l], s,
              {load.N[l] - shape.k_n[l] * k.du_n[l], lane(V, l), Triple<double>{}}, now);
        load.N[l] = now.N;
        set_lane(load.V, l, now.V);
        intact[l] = bond_[l]->state.intact;
      }
    const Triple<Lanes> f = (k.n * load.N + load.V) * intact;
    const LaneRows F(f), M(cross(anchor.x - b.x, f)), V_rows(load.V);
    for (int l = 0; l < count; ++l) {
      WallBond& bond = *bond_[l];
      bond.V = vec3(V_rows.of[l]);
      if (bond.state.intact == 0.0) continue; // it has just broken
      step_.add(bond.particle, F.of[l], M.of[l], bond.anchor.triangle,
                row_of(bond.anchor.weight), x[l], v[l]);
    }
  }

  WallStep& step_;
  const Law law_;
  int count_ = 0;
  WallBond* bond_[n_lanes];
};

} // namespace

void add_wall_forces(Wall& wall, const PairMaterials& material, double dt, Particles& p,
                     PairLosses& losses)
{
  wall.contact_forces.clear();
  wall.f.clear();
  WallStep step{wall, dt, p, losses};
  std::visit([&](const auto& law) { ContactForces(step, law).add_all(); },
             wall.is_smooth ? with_friction(wall.material, 0.0) : wall.material);
  std::visit([&](const auto& law) { BondForces(step, law).add_all(); }, material.bond);
}

} // namespace mergel::dem
