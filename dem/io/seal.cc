#include "dem/io/seal.h"

#include <cstring>
#include <fstream>

namespace mergel::dem {

namespace {

constexpr std::size_t digits = 16;

std::string mark_of(const Seal& seal)
{
  return "mergel " + seal.kind + ", " + seal.sum + " ";
}

} // namespace

std::string bytes_of(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = in ? std::streamoff(in.tellg()) : -1;
  if (size < 0) throw InputError("cannot be read. Check its permissions");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  in.seekg(0);
  in.read(bytes.data(), size);
  if (!in) throw InputError("cannot be read completely");
  return bytes;
}

std::uint64_t fnv_1a(std::string_view bytes, std::uint64_t start)
{
  std::uint64_t sum = start;
  for (const char c : bytes) sum = (sum ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return sum;
}

std::uint64_t sum_of_words(std::string_view bytes)
{
  std::uint64_t sum = 0xcbf29ce484222325u;
  const auto add = [&sum](std::uint64_t word) {
    sum = (sum ^ word) * 0x9e3779b97f4a7c15u; // odd: no two words give the same sum
    sum ^= sum >> 32;
  };
  const std::uint64_t length = bytes.size();
  std::uint64_t word = 0;
  for (; bytes.size() >= sizeof word; bytes.remove_prefix(sizeof word)) {
    std::memcpy(&word, bytes.data(), sizeof word);
    add(word);
  }
  word = 0;
  if (!bytes.empty()) std::memcpy(&word, bytes.data(), bytes.size());
  add(word);
  add(length);
  return sum;
}

std::string hexadecimal(std::uint64_t number)
{
  std::string hex(digits, '0');
  for (std::size_t k = digits; k-- > 0; number >>= 4)
    hex[k] = "0123456789abcdef"[number & 15u];
  return hex;
}

std::string sealed(std::string bytes, const Seal& seal)
{
  const std::string sum = hexadecimal(seal.of(bytes));
  return std::move(bytes) + mark_of(seal) + sum;
}

void seal(const std::filesystem::path& file, std::string_view bytes, const Seal& seal)
{
  const std::string sum = hexadecimal(seal.of(bytes));
  std::ofstream out(file, std::ios::binary | std::ios::app);
  out << mark_of(seal) << sum;
  out.flush();
  if (!out) throw NumericalError(file.string() + ": cannot be written; is the disk full?");
}

std::string unsealed(const std::filesystem::path& file, const Seal& seal,
                     std::uint64_t* sum)
{
  std::error_code error; // for a name that is too long, or a folder without permission
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw InputError("there is no such file");
  if (!std::filesystem::is_regular_file(status)) throw InputError("is not a file");
  std::string bytes = bytes_of(file);
  const std::string hdf5 = "\x89HDF\r\n\x1a\n", mark = mark_of(seal);
  if (bytes.compare(0, hdf5.size(), hdf5) != 0)
    throw DamagedFile("is no " + seal.kind + ": it is not an HDF5 file; " + seal.remedy);
  const std::size_t tail = mark.size() + digits;
  if (bytes.size() < tail || bytes.compare(bytes.size() - tail, mark.size(), mark) != 0)
    throw DamagedFile("is no " + seal.kind + ", or is truncated; " + seal.remedy);
  const std::string stored = bytes.substr(bytes.size() - digits);
  bytes.resize(bytes.size() - tail);
  const std::uint64_t found = seal.of(bytes);
  if (stored != hexadecimal(found))
    throw DamagedFile("is damaged (its checksum does not match); " + seal.remedy);
  if (sum) *sum = found;
  return bytes;
}

} // namespace mergel::dem
