#include "coupling/driven_pile.h"

#include "dem/parallel/reduction.h"

#include <algorithm>
#include <cmath>

namespace mergel::coupling {

namespace {

using dem::Vec3;

/// Local damping of one component: alpha |f| against the velocity.
double drag(double alpha, double f, double v)
{
  const double size = alpha * std::abs(f);
  return v > 0.0 ? size : (v < 0.0 ? -size : 0.0);
}

} // namespace

double DrivenPile::moment_of_inertia() const
{
  const double L = inertia_.length, below = arm_ - 0.5 * L; // of its centre
  return inertia_.mass * (L * L / 12.0 + below * below);
}

Vec3 DrivenPile::along_axis() const
{
  return arm_ * Vec3(std::sin(angle_), 0.0, std::cos(angle_));
}

double DrivenPile::moment(const dem::RigidWall& wall) const
{
  return (wall.moment.value() - along_axis().cross(wall.resultant())).y();
}

void DrivenPile::count_kinetic()
{
  energy_.kinetic = 0.0;
  if (control_ == HeadControl::velocity) return;
  energy_.kinetic = 0.5 * inertia_.mass * v_z_ * v_z_;
  if (control_ == HeadControl::lateral)
    energy_.kinetic += 0.5 * moment_of_inertia() * omega_ * omega_;
}

/// The head gives the kinetic energy that a motion has when it becomes free, and takes it
/// where it ends.
void DrivenPile::take_over(HeadControl control, const dem::RigidWall& wall)
{
  const double before = energy_.kinetic;
  if (control_ == HeadControl::velocity) v_z_ = wall.v.z();
  control_ = control;
  count_kinetic();
  energy_.applied_work += energy_.kinetic - before;
}

void DrivenPile::prescribe_velocity(const dem::RigidWall& wall)
{
  v_x_ = omega_ = 0.0;
  take_over(HeadControl::velocity, wall);
}

void DrivenPile::prescribe_force(const dem::RigidWall& wall)
{
  take_over(HeadControl::force, wall);
}

void DrivenPile::push_at(double height, const dem::RigidWall& wall)
{
  if (arm_ == 0.0) arm_ = height - wall.x.z();
  take_over(HeadControl::lateral, wall);
}

double DrivenPile::head_force(const dem::RigidWall& wall) const
{
  return control_ == HeadControl::velocity ? wall.resultant().z() : head_force_;
}

double DrivenPile::displacement(const dem::RigidWall& wall) const
{
  return wall.x.x() + along_axis().x();
}

double DrivenPile::unbalanced(const dem::RigidWall& wall, double scale) const
{
  if (control_ == HeadControl::velocity) return 0.0;
  double ratio = std::abs(wall.resultant().z() - head_force_) / scale;
  if (control_ == HeadControl::lateral)
    ratio = std::max(ratio, std::abs(moment(wall)) / (scale * arm_));
  return ratio;
}

double DrivenPile::omega2(const dem::RigidWall& wall, const dem::Particles& particles,
                          const dem::Communicator& comm) const
{
  if (control_ == HeadControl::velocity) return 0.0;
  const Vec3 pushed = wall.x + along_axis();
  dem::ForceSum stiffness;
  dem::MomentSum rotational; // [N m]
  for (const dem::WallContact& c : wall.contacts) {
    if (!(c.overlap > 0.0)) continue;
    const dem::ParticleState& b = particles.state[c.particle];
    const auto k =
        dem::contact_stiffness(wall.material, dem::sides_at_wall(b.R), c.overlap);
    const double stiffer = std::max(k.k_n, k.k_s);
    stiffness.add(stiffer);
    rotational.add(stiffer * (b.x - pushed).squaredNorm());
  }
  dem::ExactReduction all;
  all.add(stiffness);
  all.add(rotational);
  all.run(comm);
  const double of_z = stiffness.value() / inertia_.mass; // mass > 0
  return control_ == HeadControl::force ? of_z
                                        : of_z + rotational.value() / moment_of_inertia();
}

void DrivenPile::step(dem::RigidWall& wall, const HeadTarget& target, double dt_kick,
                      double dt)
{
  const Vec3 f = wall.resultant();
  if (control_ == HeadControl::velocity) {
    const double work = dt_kick * f.z() * 0.5 * (wall.v.z() + target.v_z);
    energy_.wall_work += work;
    energy_.applied_work -= work;
    wall.v = Vec3(0.0, 0.0, target.v_z);
    wall.omega.setZero(); // after a push it leans, and turns no more
    wall.x.z() += dt * wall.v.z();
    return;
  }
  kick_z(f.z(), target.force, dt_kick);
  if (control_ == HeadControl::force) {
    wall.v = Vec3(0.0, 0.0, v_z_);
    wall.omega.setZero();
    wall.x.z() += dt * wall.v.z();
    return;
  }
  kick_across(wall, target.v_x, dt_kick);
  const Vec3 pushed = wall.x + along_axis() + dt * Vec3(v_x_, 0.0, v_z_);
  angle_ += dt * omega_;
  const Vec3 x = pushed - along_axis();
  wall.v = (x - wall.x) / dt;
  wall.x = x;
  wall.rotation = Eigen::AngleAxisd(angle_, Vec3::UnitY());
  wall.omega = Vec3(0.0, omega_, 0.0);
}

void DrivenPile::kick_z(double f_z, double force, double dt)
{
  const double f = f_z - force, f_damping = drag(inertia_.damping, f, v_z_), v = v_z_;
  v_z_ += dt * (f - f_damping) / inertia_.mass; // mass > 0
  head_force_ = force;
  const double mean = 0.5 * (v + v_z_);
  energy_.wall_work += dt * f_z * mean;
  energy_.applied_work -= dt * force * mean;
  energy_.damping += dt * f_damping * mean;
  count_kinetic();
}

void DrivenPile::kick_across(const dem::RigidWall& wall, double v_x, double dt)
{
  const double M = moment(wall), M_damping = drag(inertia_.damping, M, omega_);
  const double omega = omega_;
  omega_ += dt * (M - M_damping) / moment_of_inertia(); // mass > 0
  const double turned = dt * 0.5 * (omega + omega_);
  const double pushed = dt * 0.5 * (v_x_ + v_x) * wall.resultant().x();
  v_x_ = v_x;
  energy_.wall_work += pushed + turned * M;
  energy_.applied_work -= pushed;
  energy_.damping += turned * M_damping;
  count_kinetic();
}

} // namespace mergel::coupling
