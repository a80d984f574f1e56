#include "dem/text.h"

#include <array>
#include <charconv>

namespace mergel::dem {

std::string shortest(double value)
{
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

} // namespace mergel::dem
