#include "coupling/structure_system.h"

#include <algorithm>

namespace mergel::coupling {

std::size_t StructureSystem::size() const
{
  std::size_t n = 0;
  for (const Part& p : parts_) n += p.structure->n_amplitudes();
  return n;
}

void StructureSystem::move(std::span<const double> y,
                           std::vector<std::vector<dem::Vec3>>& u) const
{
  Nodal of_structure;
  std::size_t first = 0;
  for (const Part& p : parts_) {
    const std::size_t n = p.structure->n_amplitudes();
    p.structure->move(y.subspan(first, n), of_structure);
    p.transfer->to_wall(of_structure, u[p.wall]);
    first += n;
  }
}

void StructureSystem::multiply(std::span<const double> y,
                               const std::vector<std::vector<dem::Vec3>>& f,
                               std::span<double> to) const
{
  Nodal on_structure;
  std::size_t first = 0;
  for (const Part& p : parts_) {
    const std::size_t n = p.structure->n_amplitudes();
    p.transfer->to_structure(f[p.wall], on_structure);
    p.structure->multiply(y.subspan(first, n), on_structure, to.subspan(first, n));
    first += n;
  }
}

double StructureSystem::damping() const
{
  double largest = 0.0;
  for (const Part& p : parts_) largest = std::max(largest, p.structure->damping());
  return largest;
}

} // namespace mergel::coupling
