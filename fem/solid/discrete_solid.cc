#include "fem/solid/discrete_solid.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace mergel::fem {

double largest_frequency(const DiscreteSolid& solid)
{
  return largest_frequency(solid, solid.m, Eigen::ArrayXd::Zero(solid.m.size()));
}

double largest_frequency(const DiscreteSolid& solid, const Eigen::ArrayXd& m,
                         const Eigen::ArrayXd& to_ground)
{
  const auto n = static_cast<Eigen::Index>(solid.n_nodes());
  const Eigen::ArrayXd root = m.sqrt().inverse(); // m > 0
  NodalField scale(4, n);
  for (Eigen::Index a = 0; a < n; ++a) scale.col(a).setConstant(root(a));

  // Start vector: irregular in all components, the same on every machine, in the range of
  // P.
  NodalField q = NodalField::Zero(4, n);
  for (Eigen::Index a = 0; a < n; ++a) {
    const double t = static_cast<double>(a + 1);
    q.col(a).head<3>() = (solid.P[a] * Vec3(std::sin(2.1 * t * t), std::sin(3.7 * t * t),
                                            std::cos(1.3 * t * t)))
                             .array();
  }
  if (dot(q, q) == 0.0) return 0.0; // every node is fixed
  q /= std::sqrt(dot(q, q));

  constexpr int largest_basis = 500;
  std::vector<double> diagonal, off;
  NodalField previous = NodalField::Zero(4, n), Kq;
  double lambda = 0.0;
  for (int k = 0; k < largest_basis; ++k) {
    const NodalField s = scale * q;
    solid.K.multiply(s, Kq);
    Kq += s.rowwise() * to_ground.transpose();
    NodalField w = scale * Kq;
    const double alpha = dot(q, w);
    w -= alpha * q;
    if (k > 0) w -= off.back() * previous;
    const double beta = std::sqrt(dot(w, w));
    diagonal.push_back(alpha);

    if (k % 10 == 9 || beta <= 1e-12 * std::abs(alpha)) {
      const auto size = static_cast<Eigen::Index>(diagonal.size());
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
      ritz.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal.data(), size),
                                  Eigen::Map<const Eigen::VectorXd>(off.data(), size - 1),
                                  Eigen::EigenvaluesOnly);
      const double latest = ritz.eigenvalues().maxCoeff();
      if (std::abs(latest - lambda) <= 1e-6 * latest || beta <= 1e-12 * std::abs(alpha))
        return std::sqrt(std::max(latest, 0.0));
      lambda = latest;
    }
    off.push_back(beta);
    previous = q;
    q = w / beta; // beta > 0: tested above
  }
  throw std::runtime_error("largest frequency of the far field: no convergence in " +
                           std::to_string(largest_basis) +
                           " Lanczos steps; check the mesh");
}

} // namespace mergel::fem
