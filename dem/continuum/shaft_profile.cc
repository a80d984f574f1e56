#include "dem/continuum/shaft_profile.h"

#include "dem/walls/wall_readings.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mergel::dem {

double finest_d_50(const Particles& p)
{
  double finest = p.state.front().S;
  for (const ParticleState& b : p.state) finest = std::min(finest, b.S);
  std::vector<double> R;
  for (const ParticleState& b : p.state)
    if (b.S <= 1.01 * finest) R.push_back(b.R);
  std::sort(R.begin(), R.end());
  double all = 0.0, sum = 0.0;
  for (const double r : R) all += r * r * r;
  for (const double r : R) {
    sum += r * r * r;
    if (sum >= 0.5 * all) return 2.0 * r;
  }
  return 2.0 * R.back();
}

std::vector<RingForce> ring_forces(const Assembly& assembly, const RigidWall& pile,
                                   double height, std::size_t n_rings)
{
  const double shoulder = tip_height(pile.shape);
  const Eigen::Quaterniond to_pile = pile.rotation.conjugate();
  std::vector<VectorSum> sums(n_rings);
  for (const WallContact& c : pile.contacts) {
    if (c.overlap <= 0.0) continue;
    for (const RigidContact& at : read_contacts(pile, c, assembly.particles)) {
      const Vec3 point = to_pile * (at.point - pile.x), f = to_pile * at.f; // in its axes
      const double h = point.z() - shoulder;
      if (at.part != Revolution::shaft || h < 0.0) continue;
      const auto ring = static_cast<std::size_t>(h / height);
      if (ring >= n_rings) continue;
      const Vec3 e_r = point.cwiseProduct(Vec3(1.0, 1.0, 0.0)).normalized();
      sums[ring].add({f.dot(e_r), -f.dot(Vec3::UnitZ().cross(e_r)), -f.z()});
    }
  }
  ExactReduction reduction;
  reduction.add(sums);
  reduction.run(assembly.comm);
  std::vector<RingForce> forces;
  for (const VectorSum& sum : sums)
    forces.push_back({sum.x.value(), sum.y.value(), sum.z.value()});
  return forces;
}

PowerFit fit_power(const std::vector<double>& x, const std::vector<double>& y)
{
  std::vector<std::pair<double, double>> points;
  for (std::size_t k = 0; k < std::min(x.size(), y.size()); ++k)
    if (x[k] > 0.0 && y[k] > 0.0) points.emplace_back(std::log(x[k]), std::log(y[k]));
  PowerFit fit;
  const auto n = static_cast<double>(points.size());
  double X = 0.0, Y = 0.0, XX = 0.0, XY = 0.0;
  for (const auto& point : points) {
    X += point.first / n;
    Y += point.second / n;
  }
  for (const auto& point : points) {
    XX += (point.first - X) * (point.first - X);
    XY += (point.first - X) * (point.second - Y);
  }
  if (points.size() < 3 || !(XX > 0.0)) return fit;
  fit.n = points.size();
  fit.b = XY / XX;
  fit.a = std::exp(Y - fit.b * X);
  double remainder = 0.0;
  for (const auto& point : points) {
    const double error = point.second - Y - fit.b * (point.first - X);
    remainder += error * error;
  }
  fit.standard_error = std::sqrt(remainder / (n - 2.0) / XX);
  return fit;
}

double icp18_exponent(double q_c)
{
  return q_c > 0.0 ? -0.481 * std::pow(q_c / 100e3, 0.145) : 0.0;
}

double icp18_end_of_driving(double q_c, double h_over_R)
{
  if (!(q_c > 0.0)) return 0.0;
  return 0.031 * q_c * std::pow(std::max(6.0, h_over_R), icp18_exponent(q_c));
}

} // namespace mergel::dem
