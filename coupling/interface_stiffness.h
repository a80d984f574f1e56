/// Stiffness of an assembly at the nodes of a structure (coupling/README.md, Time step).
#pragma once

#include "coupling/transfer.h"
#include "dem/assembly/step.h"

namespace mergel::coupling {

/// Stiffness that bonds and contacts at a wall of the assembly add to the nodes of its
/// structure [N/m], an upper bound: intact bonds with their weights, and every contact that
/// may close in full at all corners of the triangles that it can reach. Depends on the
/// present positions alone. Collective.
std::vector<double> interface_stiffness(const dem::Assembly& assembly,
                                        const dem::Wall& wall, const Transfer& transfer);

} // namespace mergel::coupling
