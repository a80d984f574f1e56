/// All ranks read the same: a file that is edited between two reads, or is another one on
/// another node, would give them different cases without a word.
#pragma once

#include "apps/case/case_file.h"

#include <cstdint>
#include <string>

namespace mergel::apps {

/// Compare the resolved case with that of the first rank, key by key. A path may have
/// another name on another node: what is read there is compared by itself. Collective.
/// @pre file.read() was called on all ranks
/// @throws InputError naming key, values and remedy
void require_same_case(const CaseFile& file);

/// Compare the sum over a file's bytes with that of the first rank. Collective.
/// @param name of the file, to begin the message
/// @throws InputError
void require_same_bytes(std::uint64_t sum, const std::string& name);

} // namespace mergel::apps
