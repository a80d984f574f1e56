#include "dem/walls/rigid_wall.h"

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

SurfacePoint closest_point(const RigidWall& wall, const ParticleState& b)
{
  return std::visit([&](const auto& shape) { return shape.closest_point(b, wall.x); },
                    wall.shape);
}

void rebuild_wall(RigidWall& wall, const PairMaterials&, const Particles& p, double skin,
                  const std::vector<double>& extra)
{
  std::vector<WallContact> near;
  const double reach = activation_gap(wall.material) + skin;
  std::visit(
      [&](const auto& shape) {
        p.for_owned([&](Index i) {
          const ParticleState& b = p.state[i];
          const double most = reach * b.S + (extra.empty() ? 0.0 : extra[i]);
          if (shape.is_beyond(b, wall.x, most)) return; // most particles
          const double gap =
              with_particle_id(p.id[i], [&] { return shape.closest_point(b, wall.x).gap; });
          if (gap < most) near.push_back({.particle = i});
        });
      },
      wall.shape);
  wall.contacts = carry_history(std::move(near), wall.contacts);
  wall.x_listed = wall.x;
}

double travel(const RigidWall& wall)
{
  return (wall.x - wall.x_listed).norm();
}

void add_wall_forces(RigidWall& wall, const PairMaterials&, double dt, Particles& p,
                     PairLosses& losses)
{
  for (VectorSum& f : wall.force) f.clear();
  std::visit(
      [&](const auto& shape, const auto& law) {
        for (WallContact& c : wall.contacts) {
          const ParticleState& particle = p.state[c.particle];
          const bool is_open = c.overlap == 0.0 && c.f_s == Vec3::Zero();
          if (is_open &&
              shape.is_beyond(particle, wall.x, activation_gap(law) * particle.S))
            continue; // most candidates
          const SurfacePoint closest = with_particle_id(
              p.id[c.particle], [&] { return shape.closest_point(particle, wall.x); });
          wall.force[closest.part].add(
              -add_wall_contact(law, {closest.n, closest.gap, closest.point, wall.v}, dt,
                                particle, p.load[c.particle], c, losses));
        }
      },
      wall.shape, wall.material);
}

EnergySum stored_energy(const RigidWall& wall, const Particles& p)
{
  return stored_energy(wall.contacts, wall.material, p);
}

double power(const RigidWall& wall)
{
  return -wall.resultant().dot(wall.v);
}

} // namespace mergel::dem
