#include "tests/fuzz/reader.h"

#include <fstream>

namespace mergel::fuzz {

void write_bytes(const std::filesystem::path& file, const std::string& bytes)
{
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

} // namespace mergel::fuzz
