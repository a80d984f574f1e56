// Entry point of libFuzzer; MERGEL_FUZZ_READER names one of the readers of reader.h.
#include "tests/fuzz/reader.h"

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <set>

#include <unistd.h>

namespace fs = std::filesystem;

namespace {

/// Contents of the corpus folders at the start: of sealed files, these alone may be
/// accepted.
std::set<std::string>& given()
{
  static std::set<std::string> all;
  return all;
}

} // namespace

extern "C" int LLVMFuzzerInitialize(int* n, char*** arguments)
{
  for (int k = 1; k < *n; ++k) {
    if (!fs::is_directory((*arguments)[k])) continue;
    for (const fs::directory_entry& e : fs::directory_iterator((*arguments)[k])) {
      std::ifstream in(e.path(), std::ios::binary);
      given().emplace(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const fs::path file = [] {
    const fs::path memory = "/dev/shm";
    return (fs::is_directory(memory) ? memory : fs::temp_directory_path()) /
           ("mergel_fuzz_" + std::to_string(::getpid()));
  }();
  const mergel::fuzz::Reader& reader = mergel::fuzz::MERGEL_FUZZ_READER;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  if (reader.accepts(bytes, file) && reader.is_sealed)
    mergel::fuzz::promise(given().contains(bytes), "a changed file is accepted");
  return 0;
}
