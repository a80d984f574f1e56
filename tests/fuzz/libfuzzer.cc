// Entry point of libFuzzer; MERGEL_FUZZ_READER names one of the readers of reader.h.
#include "tests/fuzz/reader.h"

#include <cstddef>
#include <cstdint>

#include <unistd.h>

namespace fs = std::filesystem;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const fs::path file = [] {
    const fs::path memory = "/dev/shm";
    return (fs::is_directory(memory) ? memory : fs::temp_directory_path()) /
           ("mergel_fuzz_" + std::to_string(::getpid()));
  }();
  mergel::fuzz::MERGEL_FUZZ_READER.accepts(
      std::string(reinterpret_cast<const char*>(data), size), file);
  return 0;
}
