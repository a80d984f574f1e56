/// Sieve curves in a text file: a table with the columns `diameter [mm]` and `passing [%]`,
/// the share by mass below that diameter.
#pragma once

#include "dem/specimen/psd.h"

#include <filesystem>

namespace mergel::dem {

/// Diameters must ascend; passing must go from 0 to 100 and never decrease.
/// @throws InputError naming file and line
SieveSizes read_sieve_curve(const std::filesystem::path& file);

} // namespace mergel::dem
