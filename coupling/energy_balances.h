/// Energy balance of a coupled system: the sum of those of assembly and structures
/// (coupling/README.md, Energy balance).
#pragma once

#include "coupling/structure.h"
#include "dem/assembly/energy_balance.h"

namespace mergel::coupling {

struct EnergyBalances {
  dem::EnergyBalance assembly;
  StructureEnergies structures; ///< sum over all structures
};

/// Sum of the errors of both energy balances since `start` [J].
inline double unexplained(const EnergyBalances& now, const EnergyBalances& start)
{
  return dem::unexplained(now.assembly, start.assembly) + now.structures.net() -
         start.structures.net();
}

} // namespace mergel::coupling
