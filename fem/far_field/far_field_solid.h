/// The mesh of a far field and what is assembled on it, as far_field.cc sees it: without deal.II.
#pragma once

#include "fem/far_field/far_field.h"
#include "fem/solid/discrete_solid.h"

#include <cstdint>

namespace mergel::fem {

class FarFieldSolid {
public:
  virtual ~FarFieldSolid() = default;
  FarFieldSolid(const FarFieldSolid&) = delete;
  FarFieldSolid& operator=(const FarFieldSolid&) = delete;

  virtual const DiscreteSolid& discrete() const = 0;
  virtual const InterfaceMesh& interface() const = 0;
  /// Node of discrete() at each node of the interface, ascending.
  virtual const std::vector<std::uint32_t>& interface_nodes() const = 0;
  virtual std::size_t n_cells() const = 0;

  /// See fem/dealii/output.h.
  virtual void write_vtu(const NodalField& u, const NodalField& v, const std::string& path,
                         const std::string& made_by) const = 0;

protected:
  FarFieldSolid() = default;
};

} // namespace mergel::fem
