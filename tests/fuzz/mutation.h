/// Damages to files: flipped bits, cuts, doubled and moved pieces, numbers out of range.
#pragma once

#include <cstdint>
#include <string>

namespace mergel::fuzz {

/// Which mutation: file and number count from 0, and give the same damage on any machine.
struct MutationId {
  std::uint64_t file, number;
};

/// `bytes` with one to four damages, some with pieces of `other`.
std::string mutated(std::string bytes, const std::string& other, MutationId id);

} // namespace mergel::fuzz
