#include "coupling/rigid_platen.h"

#include "dem/io/state/named_numbers.h"
#include "dem/io/state/state_rows.h"
#include "dem/text.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace mergel::coupling {

namespace {

using dem::uz;
using dem::Vec3;

void require(bool holds, const char* what, double value, const char* allowed_and_remedy)
{
  mergel::require(holds, std::string("platen: ") + what + " = " + dem::shortest(value) +
                             ": " + allowed_and_remedy);
}

/// Local damping of one component: alpha |f| against the velocity.
double drag(double alpha, double f, double v)
{
  const double size = alpha * std::abs(f);
  return v > 0.0 ? size : (v < 0.0 ? -size : 0.0);
}

} // namespace

void PlatenSpec::check() const
{
  mergel::require(!mesh.triangles.empty(), "platen: its mesh has no triangle");
  for (const dem::Triangle& t : mesh.triangles)
    for (const int k : t)
      mergel::require(k >= 0 && uz(k) < mesh.x.size(),
                      "platen: a triangle has node " + std::to_string(k) +
                          ", but the mesh has " + std::to_string(mesh.x.size()) +
                          " nodes (numbered from 0)");
  require(std::abs(mesh.axis.norm() - 1.0) < 1e-9, "length of the axis", mesh.axis.norm(),
          "must be 1; divide the axis by its length");
  const SurfaceMoments s = moments_of(mesh);
  require(s.area > 0.0 && std::isfinite(s.area), "area", s.area, "must be > 0, in m^2");
  require(s.area_vector.dot(mesh.axis) > 0.0, "area seen along the axis [m^2]",
          s.area_vector.dot(mesh.axis),
          "must be > 0: the triangles must face the particles; reverse them or the axis");
  require(mass >= 0.0 && std::isfinite(mass), "mass", mass, "must be >= 0, in kg");
  require(mass > 0.0 || !(is_free_to_tilt || std::holds_alternative<ForceDrive>(drive)),
          "mass", mass,
          "must be > 0, in kg, for a platen that is driven by a force or free to tilt");
  require(damping >= 0.0 && damping < 1.0, "damping", damping,
          "must satisfy 0 <= damping < 1");
  if (is_free_to_tilt) {
    const auto e = normal_axes(mesh.axis);
    const double off = (e.transpose() * s.second * mesh.axis).norm() / s.second.trace();
    require(off < 1e-9, "product of inertia over the sum of the moments", off,
            "must be 0: a platen that tilts needs a principal axis of inertia along its "
            "axis; use a flat or a symmetric mesh");
  }
}

RigidPlaten::RigidPlaten(PlatenSpec spec) : spec_(std::move(spec))
{
  spec_.check();
  const SurfaceMoments s = moments_of(spec_.mesh);
  centre_0_ = s.centre;
  for (const Vec3& x : spec_.mesh.x) r_0_.push_back(x - centre_0_);
  in_plane_ = normal_axes(spec_.mesh.axis);
  const Eigen::Matrix3d all =
      spec_.mass / s.area * (s.second.trace() * Eigen::Matrix3d::Identity() - s.second);
  inertia_ = in_plane_.transpose() * all * in_plane_;
  now_.x_nodes = rigid_positions();
  now_.v_nodes.assign(r_0_.size(), Vec3::Zero());
}

void RigidPlaten::set_drive(const PlatenDrive& drive)
{
  if (drive.index() != spec_.drive.index())
    throw std::logic_error("a platen keeps its kind of drive, velocity or force");
  spec_.drive = drive;
}

Interface RigidPlaten::interface(const dem::ContactLaw& contact) const
{
  std::vector<int> itself(r_0_.size());
  std::iota(itself.begin(), itself.end(), 0);
  return {dem::make_wall(now_.x_nodes, spec_.mesh.triangles, contact),
          follow(itself, itself.size())};
}

Vec3 RigidPlaten::velocity_at(const Vec3& x) const
{
  const Vec3 omega = now_.rotation * Vec3(in_plane_ * now_.omega);
  return now_.v * spec_.mesh.axis + omega.cross(x - centre());
}

PlatenLoad RigidPlaten::sum(const Nodal& f) const
{
  PlatenLoad load;
  for (std::size_t k = 0; k < f.size(); ++k) {
    const Vec3 r = now_.x_nodes[k] - centre();
    load.f += f[k].dot(spec_.mesh.axis);
    load.moment += r.cross(f[k]);
    load.sum_f += f[k].norm();
    load.sum_moment += r.norm() * f[k].norm();
  }
  return load;
}

void RigidPlaten::step(double dt, const Nodal& f)
{
  now_.load = sum(f);
  const double dt_kick = now_.dt > 0.0 ? 0.5 * (now_.dt + dt) : dt;
  kick_axis(dt_kick);
  if (spec_.is_free_to_tilt) kick_tilt(dt_kick);
  now_.travel += dt * now_.v;
  if (spec_.is_free_to_tilt) turn(dt);
  move_nodes(dt);
  now_.dt = dt;
}

/// m (v^{n+1/2} - v^{n-1/2})/dt = f - alpha |f| sign v with f = load + drive, or the
/// prescribed v^{n+1/2}, to which the drive adds the force that is missing.
void RigidPlaten::kick_axis(double dt)
{
  const double v = now_.v;
  double lost = 0.0; // power [W]
  if (const auto* by_force = std::get_if<ForceDrive>(&spec_.drive)) {
    now_.drive_force = by_force->f;
    const double f = now_.load.f + now_.drive_force, f_damping = drag(spec_.damping, f, v);
    now_.v = v + dt * (f - f_damping) / spec_.mass; // mass > 0: check()
    lost = f_damping * 0.5 * (v + now_.v);
  } else {
    now_.v = std::get<VelocityDrive>(spec_.drive).v;
    now_.drive_force = spec_.mass * (now_.v - v) / dt - now_.load.f;
  }
  const double v_mean = 0.5 * (v + now_.v);
  now_.energy.wall_work += dt * now_.load.f * v_mean;
  now_.energy.applied_work += dt * now_.drive_force * v_mean;
  now_.energy.damping += dt * lost;
}

/// I (omega^{n+1/2} - omega^{n-1/2})/dt = M - alpha |M| sign omega in the axes that turn
/// with the platen. Euler's equations have no other term: the spin about the axis is zero,
/// and the axis is a principal one.
void RigidPlaten::kick_tilt(double dt)
{
  const Eigen::Vector2d M =
      in_plane_.transpose() * (now_.rotation.conjugate() * now_.load.moment);
  const Eigen::Vector2d omega = now_.omega;
  const Eigen::Vector2d M_damping(drag(spec_.damping, M[0], omega[0]),
                                  drag(spec_.damping, M[1], omega[1]));
  now_.omega = omega + dt * (inertia_.inverse() * (M - M_damping)); // mass > 0: check()
  const Eigen::Vector2d omega_mean = 0.5 * (omega + now_.omega);
  now_.energy.wall_work += dt * M.dot(omega_mean);
  now_.energy.damping += dt * M_damping.dot(omega_mean);
}

/// The rotation over the step is exact for a constant omega.
void RigidPlaten::turn(double dt)
{
  const Vec3 angle = dt * (in_plane_ * now_.omega);
  const double size = angle.norm();
  if (size == 0.0) return;
  const Eigen::Quaterniond over_step(Eigen::AngleAxisd(size, angle / size));
  now_.rotation = (now_.rotation * over_step).normalized();
}

/// The velocity of a node is its motion over the step, so that nodes that move with it stay
/// those of a rigid platen; their round-off is made up for in the next step.
void RigidPlaten::move_nodes(double dt)
{
  const Nodal x = rigid_positions();
  for (std::size_t k = 0; k < x.size(); ++k) {
    now_.v_nodes[k] = (x[k] - now_.x_nodes[k]) / dt;
    now_.x_nodes[k] += dt * now_.v_nodes[k]; // as Exchange::move_wall()
  }
}

Nodal RigidPlaten::rigid_positions() const
{
  const Eigen::Matrix3d Q = now_.rotation.toRotationMatrix();
  Nodal x;
  x.reserve(r_0_.size());
  for (const Vec3& r : r_0_) x.push_back(centre() + Q * r);
  return x;
}

void RigidPlaten::restore_masses()
{
  if (is_driven_by_force()) now_.v = 0.0;
  now_.omega.setZero();
  now_.v_nodes.assign(now_.x_nodes.size(), now_.v * spec_.mesh.axis);
}

std::optional<Nodal> RigidPlaten::solve_static(const Nodal&)
{
  return std::nullopt;
}

std::size_t RigidPlaten::n_amplitudes() const
{
  return (is_driven_by_force() ? 1 : 0) + (spec_.is_free_to_tilt ? 2 : 0);
}

RigidPlaten::FreeMotions RigidPlaten::free_motions() const
{
  const Eigen::Index first = is_driven_by_force() ? 0 : 1;
  const auto n = static_cast<Eigen::Index>(n_amplitudes());
  const Eigen::Matrix<double, 3, 2> e = now_.rotation.toRotationMatrix() * in_plane_;
  FreeMotions all;
  for (const Vec3& x : now_.x_nodes) {
    const Vec3 r = x - centre();
    Eigen::Matrix3d J;
    J << spec_.mesh.axis, Vec3(e.col(0)).cross(r), Vec3(e.col(1)).cross(r);
    all.of_node.push_back(J.middleCols(first, n));
  }
  Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
  M(0, 0) = spec_.mass;
  M.bottomRightCorner<2, 2>() = inertia_;
  if (n == 0) return all;
  const Eigen::MatrixXd free = M.block(first, first, n, n); // mass > 0: check()
  all.inverse_root = Eigen::MatrixXd(free.llt().matrixL()).inverse();
  return all;
}

void RigidPlaten::move(std::span<const double> y, Nodal& u) const
{
  u.assign(r_0_.size(), Vec3::Zero());
  if (y.empty()) return;
  const FreeMotions all = free_motions();
  const Eigen::VectorXd a =
      all.inverse_root.transpose() *
      Eigen::Map<const Eigen::VectorXd>(y.data(), static_cast<Eigen::Index>(y.size()));
  for (std::size_t k = 0; k < u.size(); ++k) u[k] = all.of_node[k] * a;
}

void RigidPlaten::multiply(std::span<const double> y, const Nodal& f,
                           std::span<double> to) const
{
  if (y.empty()) return;
  const FreeMotions all = free_motions();
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(y.size()));
  for (std::size_t k = 0; k < f.size(); ++k) sum += all.of_node[k].transpose() * f[k];
  Eigen::Map<Eigen::VectorXd>(to.data(), sum.size()) = all.inverse_root * sum;
}

double RigidPlaten::unbalanced_ratio() const
{
  const auto share = [](double part, double whole) {
    return whole > 0.0 ? part / whole : 0.0;
  };
  const PlatenLoad& load = now_.load;
  double ratio = 0.0;
  if (is_driven_by_force())
    ratio =
        share(std::abs(load.f + now_.drive_force), load.sum_f + std::abs(now_.drive_force));
  if (spec_.is_free_to_tilt) {
    const Eigen::Vector2d M =
        in_plane_.transpose() * (now_.rotation.conjugate() * load.moment);
    ratio = std::max(ratio, share(M.norm(), load.sum_moment));
  }
  return ratio;
}

StructureEnergies RigidPlaten::energies() const
{
  StructureEnergies e = now_.energy;
  e.kinetic =
      0.5 * spec_.mass * now_.v * now_.v + 0.5 * now_.omega.dot(inertia_ * now_.omega);
  return e;
}

namespace {

template <class Motion>
dem::NumbersOf<Motion> numbers_of(Motion& m)
{
  auto& q = m.rotation.coeffs();
  return {{"time step [s]", &m.dt},
          {"travel [m]", &m.travel},
          {"velocity [m/s]", &m.v},
          {"rotation x [-]", &q[0]},
          {"rotation y [-]", &q[1]},
          {"rotation z [-]", &q[2]},
          {"rotation w [-]", &q[3]},
          {"spin about the first axis [rad/s]", &m.omega[0]},
          {"spin about the second axis [rad/s]", &m.omega[1]},
          {"force of the particles [N]", &m.load.f},
          {"moment of the particles x [N m]", &m.load.moment[0]},
          {"moment of the particles y [N m]", &m.load.moment[1]},
          {"moment of the particles z [N m]", &m.load.moment[2]},
          {"sum of the forces [N]", &m.load.sum_f},
          {"sum of the moments [N m]", &m.load.sum_moment},
          {"force of the drive [N]", &m.drive_force},
          {"work of the particles [J]", &m.energy.wall_work},
          {"work of the drive [J]", &m.energy.applied_work},
          {"loss by damping [J]", &m.energy.damping}};
}

/// A drive of the other kind is refused by the name of its number.
template <class Drive>
auto number_of_drive(Drive& drive)
{
  using Number = std::conditional_t<std::is_const_v<Drive>, const double, double>;
  if (auto* by_force = std::get_if<ForceDrive>(&drive))
    return dem::NamedNumber<Number>{"prescribed force [N]", &by_force->f};
  return dem::NamedNumber<Number>{"prescribed velocity [m/s]",
                                  &std::get_if<VelocityDrive>(&drive)->v};
}

std::vector<double> rows_of(const Nodal& nodal)
{
  std::vector<double> rows;
  for (const Vec3& a : nodal) dem::append(rows, a);
  return rows;
}

void set_rows(const std::vector<double>& rows, Nodal& nodal)
{
  for (std::size_t k = 0; k < nodal.size(); ++k) nodal[k] = dem::vec_at(rows, 3 * k);
}

} // namespace

void RigidPlaten::save(dem::State& state, const std::string& name) const
{
  auto numbers = numbers_of(now_);
  numbers.push_back(number_of_drive(spec_.drive));
  dem::save_numbers(state, name + "_numbers", numbers);
  state.add_common(name + "_x", rows_of(now_.x_nodes), 3);
  state.add_common(name + "_v", rows_of(now_.v_nodes), 3);
}

void RigidPlaten::load(const dem::State& state, const std::string& name)
{
  const auto& x = state.get_rows<double>(name + "_x", r_0_.size(), 3);
  const auto& v = state.get_rows<double>(name + "_v", r_0_.size(), 3);
  auto numbers = numbers_of(now_);
  numbers.push_back(number_of_drive(spec_.drive));
  dem::load_numbers(state, name + "_numbers", numbers);
  set_rows(x, now_.x_nodes);
  set_rows(v, now_.v_nodes);
}

} // namespace mergel::coupling
