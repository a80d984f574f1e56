#include "dem/element/strength_envelope.h"

#include "dem/element/element_analysis.h"

#include <cmath>
#include <limits>

namespace mergel::dem {

std::optional<CoulombLine> coulomb_line(const std::vector<MohrCircle>& circles)
{
  std::vector<double> sigma_3, sigma_1;
  for (const MohrCircle& m : circles) {
    sigma_3.push_back(m.sigma_3);
    sigma_1.push_back(m.sigma_1);
  }
  const auto line = fit_line(sigma_3, sigma_1);
  if (!line || !(line->slope > 0.0)) return {};
  const double N = line->slope, b = line->intercept, root = std::sqrt(N);

  const double c_b = 0.5 / root, c_N = -0.25 * b / (N * root); // derivatives of c
  const double phi_N = 1.0 / ((N + 1.0) * root);
  const double c_variance = c_b * c_b * line->intercept_variance +
                            c_N * c_N * line->slope_variance +
                            2.0 * c_b * c_N * line->covariance;
  return CoulombLine{b * c_b, std::asin((N - 1.0) / (N + 1.0)),
                     c_variance < 0.0 ? 0.0
                                      : std::sqrt(c_variance), // round-off of exact circles
                     phi_N * std::sqrt(line->slope_variance), line->R2};
}

std::optional<StressRatio> stress_ratio(const std::vector<double>& p,
                                        const std::vector<double>& q)
{
  double pp = 0.0, pq = 0.0;
  for (std::size_t k = 0; k < p.size(); ++k) {
    pp += p[k] * p[k];
    pq += p[k] * q[k];
  }
  if (!(pp > 0.0)) return {};
  const double M = pq / pp;
  double residual = 0.0;
  for (std::size_t k = 0; k < p.size(); ++k)
    residual += (q[k] - M * p[k]) * (q[k] - M * p[k]);
  const double NaN = std::numeric_limits<double>::quiet_NaN();
  const auto free = static_cast<double>(p.size()) - 1.0;
  return StressRatio{M, free > 0.0 ? std::sqrt(residual / free / pp) : NaN};
}

double friction_angle_of_ratio(double M)
{
  return std::asin(3.0 * M / (6.0 + M));
}

} // namespace mergel::dem
