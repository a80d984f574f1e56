#include "dem/continuum/particle_stress.h"

#include "dem/assembly/neighbourhood.h"
#include "dem/continuum/section_sums.h"

#include <algorithm>
#include <numeric>

namespace mergel::dem {

std::vector<Mat3> neighbourhood_stresses(const Particles& p,
                                         const std::vector<LoadedBranch>& branches,
                                         const std::vector<double>& porosity,
                                         const PeriodicCell& cell)
{
  std::vector<Mat3> moment(p.size(), Mat3::Zero()); // [J]
  for (const LoadedBranch& b : branches) {
    if (b.end != BranchEnd::particle) {
      moment[b.i] += b.F * b.r.transpose();
      continue;
    }
    const double length = b.r.norm(), R_i = p.state[b.i].R, R_j = p.state[b.j].R;
    const double arm_i = R_i + 0.5 * (length - R_i - R_j);
    const Mat3 whole = b.F * b.r.transpose();
    moment[b.i] += arm_i / length * whole; // length > 0: centres do not meet
    moment[b.j] += (length - arm_i) / length * whole;
  }
  std::vector<Vec3> x;
  std::vector<double> R, volume;
  for (std::size_t i = 0; i < p.size(); ++i) {
    x.push_back(p.state[i].x);
    R.push_back(p.state[i].R);
    volume.push_back(sphere_mass(R.back(), 1.0) / (1.0 - porosity[i]));
  }
  const auto symmetric = [](const Mat3& a, double over) -> Mat3 {
    return 0.5 / over * (a + a.transpose());
  };
  if (!holds_neighbourhoods(cell, R)) {
    const Mat3 all = std::accumulate(moment.begin(), moment.end(), Mat3(Mat3::Zero()));
    const double whole = std::accumulate(volume.begin(), volume.end(), 0.0);
    return std::vector<Mat3>(p.size(), symmetric(all, whole)); // particles: whole > 0
  }
  std::vector<Mat3> sum = moment;
  std::vector<double> V = volume;
  for (const Pair& q : neighbours(x, R, cell)) {
    sum[q.i] += moment[q.j];
    sum[q.j] += moment[q.i];
    V[q.i] += volume[q.j];
    V[q.j] += volume[q.i];
  }
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = symmetric(sum[i], V[i]);
  return sum;
}

std::vector<double> even_porosity(const Particles& p, double volume)
{
  double solid = 0.0; // [m^3]
  for (const ParticleState& b : p.state) solid += sphere_mass(b.R, 1.0);
  return std::vector<double>(p.size(), 1.0 - solid / volume);
}

std::vector<double> strained_porosity(double n_0, const std::vector<DeformationFit>& fits)
{
  std::vector<double> n;
  for (const DeformationFit& fit : fits) {
    const double J = fit.F.determinant(); // of debris it may be anything
    n.push_back(J > 0.0 ? std::clamp(1.0 - (1.0 - n_0) / J, 0.0, 1.0 - smallest_solid)
                        : n_0);
  }
  return n;
}

} // namespace mergel::dem
