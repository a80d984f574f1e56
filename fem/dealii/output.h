/// Far-field results as VTK files for ParaView.
#pragma once

#include "fem/dealii/elastic_solid.h"

#include <string>

namespace mergel::fem {

/// Write displacement u [m], velocity v [m/s] at the nodes and the cells' mean stress [Pa]
/// (tensor, tension positive, initial stress included) as one .vtu file. Give a temporary
/// name and rename it, so that the file appears whole. Throws std::runtime_error when it
/// cannot be written.
/// @param made_by plain text, the field data "made by"; none where it is empty
void write_vtu(const ElasticSolid& solid, const NodalField& u, const NodalField& v,
               const std::string& path, const std::string& made_by = "");

} // namespace mergel::fem
