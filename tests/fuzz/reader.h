/// A reader of input files, as the fuzzers call it.
#pragma once

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace mergel::fuzz {

/// The reader accepted input that it must refuse.
struct BrokenPromise : std::logic_error {
  using std::logic_error::logic_error;
};

inline void promise(bool holds, const std::string& what)
{
  if (!holds) throw BrokenPromise(what);
}

struct Reader {
  std::string_view name; ///< and folder of its corpus
  bool is_sealed; ///< the file holds the sum of its bytes: no changed file is accepted
  /// Whether the bytes are accepted; false when InputError refuses them. `file` may be
  /// written. Other exceptions propagate.
  bool (*accepts)(const std::string& bytes, const std::filesystem::path& file);
};

extern const Reader case_reader, table_reader, sample_reader, crafted_sample_reader,
    checkpoint_reader, crafted_checkpoint_reader;

/// Replace the contents of a file.
void write_bytes(const std::filesystem::path& file, const std::string& bytes);

} // namespace mergel::fuzz
