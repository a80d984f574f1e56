/// Checks that all ranks read the same input. A file that is edited between two reads, or
/// differs between nodes, would give them different cases.
#pragma once

#include "apps/case/case_file.h"

#include <cstdint>
#include <string>

namespace mergel::apps {

/// Compare the resolved case with that of the first rank, key by key. Absolute paths may
/// differ between nodes; the contents of the files are compared separately. Collective.
/// @pre file.read() was called on all ranks
/// @throws InputError naming key, values and remedy
void require_same_case(const CaseFile& file);

/// Compare the checksum of a file with that of the first rank. Collective.
/// @param name of the file, at the start of the message
/// @throws InputError
void require_same_bytes(std::uint64_t sum, const std::string& name);

} // namespace mergel::apps
