#include "dem/io/seal.h"

#include "dem/io/readable.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <fstream>

namespace mergel::dem {

namespace {

constexpr std::size_t digits = 16;
constexpr std::string_view hdf5 = "\x89HDF\r\n\x1a\n"; ///< its first bytes

std::string mark_of(const Seal& seal)
{
  return "mergel " + seal.kind + ", " + seal.sum + " ";
}

/// The user block of these data.
std::string block_of(const Seal& seal, std::string_view data, std::uint64_t sum)
{
  std::string block = mark_of(seal) + hexadecimal(sum) + ", " +
                      std::to_string(data.size()) + " bytes behind these " +
                      std::to_string(seal_room) + "\n";
  block.resize(seal_room, '\0');
  return block;
}

/// Whether a block that begins with this mark counts more bytes than there are.
bool counts_more(std::string_view block, std::size_t mark, std::size_t n_found)
{
  block.remove_prefix(mark + digits + std::string_view(", ").size());
  std::uint64_t n = 0;
  const auto parsed = std::from_chars(block.data(), block.data() + block.size(), n);
  return parsed.ec == std::errc{} && n > n_found;
}

} // namespace

std::string bytes_of(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = in ? std::streamoff(in.tellg()) : -1;
  if (size < 0) {
    const std::error_code error = reading_error(file);
    throw InputError(error ? "cannot be read: " + with_remedy(error) : "cannot be read");
  }
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
  const std::string block = seal_block(bytes, seal);
  bytes.replace(0, seal_room, block);
  return bytes;
}

std::string seal_block(std::string_view bytes, const Seal& seal)
{
  const std::string_view data = bytes.substr(seal_room);
  return block_of(seal, data, seal.of(data));
}

bool begins_as_sealed(const std::filesystem::path& file, std::string_view kind)
{
  const std::string mark = "mergel " + std::string(kind) + ", ";
  return begins_with(file, mark) || begins_with(file, hdf5);
}

std::string unsealed(const std::filesystem::path& file, const Seal& seal,
                     std::uint64_t* sum)
{
  if (const std::error_code error = reading_error(file)) {
    if (error == std::errc::no_such_file_or_directory)
      throw InputError("there is no such file");
    if (error == std::errc::is_a_directory || error == std::errc::invalid_seek)
      throw InputError("is not a file");
    throw InputError("cannot be read: " + with_remedy(error));
  }
  std::string bytes = bytes_of(file);
  const std::string mark = mark_of(seal);
  const std::string_view all = bytes;
  const auto refuse = [&](const std::string& why) {
    throw DamagedFile(why + "; " + seal.remedy);
  };
  std::uint64_t found = 0;
  if (all.starts_with(mark) && all.size() >= seal_room) {
    const std::string_view data = all.substr(seal_room);
    if (counts_more(all.substr(0, seal_room), mark.size(), data.size()))
      refuse("is no " + seal.kind + ", or is truncated");
    found = seal.of(data);
    if (all.substr(0, seal_room) != block_of(seal, data, found))
      refuse("is damaged (its checksum does not match)");
  } else if (all.starts_with(hdf5)) { // of an earlier version, or of another program
    const std::size_t end = mark.size() + digits;
    const std::string_view last = all.substr(all.size() - std::min(end, all.size()));
    if (!last.starts_with(mark)) refuse("is no " + seal.kind + ", or is truncated");
    found = seal.of(all.substr(0, all.size() - end));
    if (last.substr(mark.size()) != hexadecimal(found))
      refuse("is damaged (its checksum does not match)");
    bytes.resize(bytes.size() - end);
  } else {
    const bool has_block =
        all.starts_with("mergel ") ||
        (all.size() > seal_room && all.substr(seal_room).starts_with(hdf5));
    refuse("is no " + seal.kind +
           (has_block ? ", or is truncated" : ": it is not an HDF5 file"));
  }
  if (sum) *sum = found;
  return bytes;
}

} // namespace mergel::dem
