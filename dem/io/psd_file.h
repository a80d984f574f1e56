/// Sieve curves in a text file: a table with the columns `diameter [mm]` and `passing [%]`,
/// the share by mass below that diameter.
#pragma once

#include "dem/io/table.h"
#include "dem/specimen/psd.h"

#include <filesystem>

namespace mergel::dem {

/// Diameters must ascend; passing must go from 0 to 100 and never decrease.
/// @throws InputError naming file and line
/// @param size of the units in its headings, other than mm and %
SieveSizes read_sieve_curve(const std::filesystem::path& file, const UnitSize& size);

} // namespace mergel::dem
