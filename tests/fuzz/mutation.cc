#include "tests/fuzz/mutation.h"

#include "dem/math/random.h"

#include <algorithm>
#include <array>

namespace mergel::fuzz {

namespace {

/// Draws of one mutation.
class Draw {
public:
  explicit Draw(MutationId id) : id_(id) {}
  /// 0 ... n-1; 0 for n = 0
  std::size_t below(std::size_t n)
  {
    return static_cast<std::size_t>(dem::uniform(id_.file, id_.number, n_++) *
                                    static_cast<double>(n));
  }

private:
  MutationId id_;
  std::uint64_t n_ = 0;
};

/// Start and length of a piece, most often short.
struct Piece {
  std::size_t at, length;
};

Piece piece(const std::string& bytes, Draw& draw)
{
  const std::size_t at = draw.below(bytes.size() + 1);
  const std::size_t rest = bytes.size() - at;
  return {at,
          draw.below(1 + (draw.below(4) == 0 ? rest : std::min<std::size_t>(rest, 16)))};
}

void replace_number(std::string& bytes, Draw& draw)
{
  static const std::array<const char*, 16> numbers{
      "0",     "-1",  "1e999", "1e-999", "nan", "inf",           "18446744073709551616",
      "-",     "1e+", "0x1",   "1,5",    "",    "1e99999999999", "9223372036854775807",
      "1e308", "-0.0"};
  const std::size_t at = bytes.find_first_of("0123456789", draw.below(bytes.size() + 1));
  if (at == std::string::npos) return;
  const std::size_t end = bytes.find_first_not_of("0123456789.eE+-", at);
  bytes.replace(at, (end == std::string::npos ? bytes.size() : end) - at,
                numbers[draw.below(numbers.size())]);
}

void damage(std::string& bytes, const std::string& other, Draw& draw)
{
  constexpr std::string_view signs = "\0\n\r\t\\#=/,[] %\xff\x7f\x80";
  switch (draw.below(9)) {
  case 0: // a bit
    if (!bytes.empty())
      bytes[draw.below(bytes.size())] ^= static_cast<char>(1u << draw.below(8));
    break;
  case 1: // a byte
    if (!bytes.empty())
      bytes[draw.below(bytes.size())] = static_cast<char>(draw.below(256));
    break;
  case 2: // a character with a meaning in some format
    bytes.insert(draw.below(bytes.size() + 1), 1, signs[draw.below(signs.size())]);
    break;
  case 3:
    bytes.resize(draw.below(bytes.size() + 1));
    break;  // cut off
  case 4: { // cut out
    const Piece p = piece(bytes, draw);
    bytes.erase(p.at, p.length);
    break;
  }
  case 5: { // doubled
    const Piece p = piece(bytes, draw);
    bytes.insert(p.at, bytes.substr(p.at, p.length));
    break;
  }
  case 6: { // a piece of another file
    const Piece p = piece(other, draw);
    bytes.insert(draw.below(bytes.size() + 1), other, p.at, p.length);
    break;
  }
  case 7: // the rest of another file
    bytes = bytes.substr(0, draw.below(bytes.size() + 1)) +
            other.substr(draw.below(other.size() + 1));
    break;
  default:
    replace_number(bytes, draw);
    break;
  }
}

} // namespace

std::string mutated(std::string bytes, const std::string& other, MutationId id)
{
  Draw draw(id);
  for (std::size_t n = 1 + draw.below(2) * draw.below(4); n > 0; --n)
    damage(bytes, other, draw);
  return bytes;
}

} // namespace mergel::fuzz
