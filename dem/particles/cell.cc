#include "dem/particles/cell.h"

#include "dem/collective_failure.h"
#include "dem/particles/particles.h"

#include <string>

namespace mergel::dem {

Vec3 strain(PeriodicCell& cell, double dt, Particles& p)
{
  const Vec3 step = dt * cell.rate;
  if (!(step.cwiseAbs().maxCoeff() <= 1e-3))
    throw Unstable("the periodic cell is strained by " +
                   std::to_string(step.cwiseAbs().maxCoeff()) +
                   " in one step (at most 0.001): lower the strain rate");
  const Vec3 growth = (Vec3::Ones() - step).cwiseInverse(); // 1 - step >= 0.999
  cell.size = cell.size.cwiseProduct(growth);
  if (growth != Vec3::Ones())
    p.for_owned([&](Index i) { p.state[i].x = p.state[i].x.cwiseProduct(growth); });
  return growth;
}

} // namespace mergel::dem
