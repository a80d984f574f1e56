#include "dem/continuum/particle_stress.h"

#include "dem/assembly/neighbourhood.h"

namespace mergel::dem {

std::vector<Mat3> neighbourhood_stresses(const Particles& p,
                                         const std::vector<LoadedBranch>& branches,
                                         const std::vector<double>& porosity)
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
  std::vector<Mat3> sum = moment;
  std::vector<double> V = volume;
  for (const Pair& q : neighbours(x, R)) {
    sum[q.i] += moment[q.j];
    sum[q.j] += moment[q.i];
    V[q.i] += volume[q.j];
    V[q.j] += volume[q.i];
  }
  for (std::size_t i = 0; i < sum.size(); ++i)
    sum[i] = (0.5 / V[i] * (sum[i] + sum[i].transpose())).eval();
  return sum;
}

} // namespace mergel::dem
