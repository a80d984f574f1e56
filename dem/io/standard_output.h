/// The standard output, which may be closed or full, or a pipe that nobody reads.
#pragma once

namespace mergel::dem {

/// Call it at the start of a program: where a standard stream is closed, its descriptor is
/// kept from the next file that is opened, which would get all that is printed.
void hold_standard_descriptors();

/// For what is a program's product: flush std::cout, and check that all has arrived. A pipe whose
/// reader has gone is no failure: `mergel info DIR | head -1` has what it wanted.
/// @throws NumericalError on a full disk, or a standard output that is closed
void require_printed();

} // namespace mergel::dem
