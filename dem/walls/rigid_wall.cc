#include "dem/walls/rigid_wall.h"

#include "dem/walls/feature_forces.h"

namespace mergel::dem {

RigidWall make_rigid_wall(RigidShape shape, const Vec3& x, const ContactLaw& material)
{
  std::visit(
      [](const auto& s) {
        if constexpr (requires { s.check(); }) s.check();
      },
      shape);
  RigidWall wall;
  wall.force.resize(std::visit([](const auto& s) { return s.parts.size(); }, shape));
  wall.shape = std::move(shape);
  wall.x = wall.x_listed = x;
  wall.material = material;
  return wall;
}

Vec3 RigidWall::resultant() const
{
  Vec3 sum = Vec3::Zero();
  for (const VectorSum& f : force) sum += f.value();
  return sum;
}

namespace {

/// A shape where its wall stands. Shapes stand upright: where the wall is rotated they see
/// the particle from their own axes.
template <class Shape>
class Placed {
public:
  Placed(const Shape& shape, const RigidWall& wall)
      : shape_(shape), x_(wall.x), is_rotated_(wall.is_rotated()),
        Q_(wall.rotation.toRotationMatrix())
  {
  }
  bool is_beyond(const ParticleState& b, double gap) const
  {
    if (!is_rotated_) return shape_.is_beyond(b, x_, gap);
    return shape_.is_beyond(seen(b), Vec3::Zero(), gap);
  }
  SurfacePoint closest_point(const ParticleState& b) const
  {
    if (!is_rotated_) return shape_.closest_point(b, x_);
    SurfacePoint at = shape_.closest_point(seen(b), Vec3::Zero());
    at.n = Q_ * at.n;
    at.point = x_ + Q_ * at.point;
    return at;
  }

private:
  ParticleState seen(ParticleState b) const
  {
    b.x = Q_.transpose() * Vec3(b.x - x_);
    return b;
  }

  const Shape& shape_;
  Vec3 x_;
  bool is_rotated_;
  Mat3 Q_;
};

} // namespace

SurfacePoint closest_point(const RigidWall& wall, const ParticleState& b)
{
  return std::visit([&](const auto& shape) { return Placed(shape, wall).closest_point(b); },
                    wall.shape);
}

void rebuild_wall(RigidWall& wall, const PairMaterials&, const Particles& p, double skin,
                  const std::vector<double>& extra)
{
  std::vector<WallContact> near;
  const double reach = activation_gap(wall.material) + skin;
  std::visit(
      [&](const auto& upright) {
        const Placed shape(upright, wall);
        p.for_owned([&](Index i) {
          const ParticleState& b = p.state[i];
          const double most = reach * b.S + (extra.empty() ? 0.0 : extra[i]);
          if (shape.is_beyond(b, most)) return; // most particles
          const double gap =
              with_particle_id(p.id[i], [&] { return shape.closest_point(b).gap; });
          if (gap < most) near.push_back({.particle = i});
        });
      },
      wall.shape);
  wall.contacts = carry_history(std::move(near), wall.contacts);
  wall.x_listed = wall.x;
  wall.rotation_listed = wall.rotation;
}

double travel(const RigidWall& wall)
{
  return (wall.x - wall.x_listed).norm() +
         wall.reach * wall.rotation.angularDistance(wall.rotation_listed);
}

const std::vector<PatchFeature>& FeaturesOfWall::find(const Vec3& x, double reach)
{
  found_ = features_.find(wall_.seen(x), reach);
  for (PatchFeature& f : found_) {
    f.point = wall_.placed(f.point);
    f.n = wall_.rotation * f.n;
  }
  return found_;
}

namespace {

void add_to_wall(RigidWall& wall, std::size_t part, const Vec3& point, const Vec3& force)
{
  wall.force[part].add(force);
  wall.moment.add((point - wall.x).cross(force));
}

/// A shape whose closest point is the only contact of a particle.
template <class Shape, IsContactLaw Law>
void add_forces(RigidWall& wall, const Shape& upright, const Law& law, double dt,
                Particles& p, PairLosses& losses)
{
  const Placed shape(upright, wall);
  for (WallContact& c : wall.contacts) {
    const ParticleState& particle = p.state[c.particle];
    const bool is_open = c.overlap == 0.0 && c.f_s == Vec3::Zero();
    if (is_open && shape.is_beyond(particle, activation_gap(law) * particle.S))
      continue; // most candidates
    const SurfacePoint closest =
        with_particle_id(p.id[c.particle], [&] { return shape.closest_point(particle); });
    const Vec3 f = -add_wall_contact(
        law, {closest.n, closest.gap, closest.point, wall.velocity_at(closest.point)}, dt,
        particle, p.load[c.particle], c, losses);
    wall.force[closest.part].add(f);
    if (c.overlap > 0.0) wall.moment.add((closest.point - wall.x).cross(f));
  }
}

template <IsContactLaw Law>
void add_forces(RigidWall& wall, const Polyhedron& polyhedron, const Law& law, double dt,
                Particles& p, PairLosses& losses)
{
  const Placed shape(polyhedron, wall);
  FeaturesOfWall features(wall);
  std::vector<ActingFeature> acting;
  for (WallContact& c : wall.contacts) {
    const ParticleState& particle = p.state[c.particle];
    const double g_a = activation_gap(law) * particle.S;
    const bool is_open = c.overlap == 0.0 && c.f_s == Vec3::Zero();
    if (is_open && shape.is_beyond(particle, g_a)) continue;
    const std::vector<PatchFeature>& found =
        with_particle_id(p.id[c.particle], [&]() -> const std::vector<PatchFeature>& {
          return features.find(particle.x, particle.R + g_a);
        });
    Load& load = p.load[c.particle];
    if (found.empty()) {
      open_contact(law, particle.R, c, losses);
    } else if (found.size() == 1 && found.front().sign == 1.0) {
      const PatchFeature& only = found.front();
      const Vec3 f = -add_wall_contact(
          law,
          {only.n, only.distance - particle.R, only.point, wall.velocity_at(only.point)},
          dt, particle, load, c, losses);
      add_to_wall(wall, polyhedron.part_at(wall.seen(only.point)), only.point, f);
    } else {
      acting.clear();
      for (const PatchFeature& f : found) acting.push_back({&f, wall.velocity_at(f.point)});
      add_feature_forces(law, acting, dt, particle, load, c, losses);
      for (const ActingFeature& a : acting)
        add_to_wall(wall, polyhedron.part_at(wall.seen(a.feature->point)), a.feature->point,
                    -a.force);
    }
  }
}

} // namespace

void add_wall_forces(RigidWall& wall, const PairMaterials&, double dt, Particles& p,
                     PairLosses& losses)
{
  for (VectorSum& f : wall.force) f.clear();
  wall.moment.clear();
  std::visit([&](const auto& shape,
                 const auto& law) { add_forces(wall, shape, law, dt, p, losses); },
             wall.shape, wall.material);
}

EnergySum stored_energy(const RigidWall& wall, const Particles& p)
{
  return stored_energy(wall.contacts, wall.material, p);
}

double power(const RigidWall& wall)
{
  const double translation = -wall.resultant().dot(wall.v);
  if (wall.omega == Vec3::Zero()) return translation;
  return translation - wall.moment.value().dot(wall.omega);
}

} // namespace mergel::dem
