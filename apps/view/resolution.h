/// The size at which a picture is printed.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace mergel::apps {

/// The PNG with a chunk pHYs that states this resolution, before its other ancillary chunks.
/// Source: PNG specification, third edition, 5.3 chunk layout, 11.3.4.3 pHYs, annex D CRC.
/// @param png the bytes of a PNG without pHYs
inline std::string with_resolution(const std::string& png, double dots_per_inch)
{
  constexpr std::size_t end_of_header = 8 + 25; // signature, IHDR
  constexpr double inch = 0.0254;               // [m]
  const auto big_endian = [](std::uint32_t n) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8)
      bytes += static_cast<char>((n >> shift) & 0xffu);
    return bytes;
  };
  const auto per_metre = static_cast<std::uint32_t>(dots_per_inch / inch + 0.5);
  const std::string chunk =
      "pHYs" + big_endian(per_metre) + big_endian(per_metre) + '\1'; // unit: metre
  std::uint32_t crc = 0xffffffffu;
  for (const char c : chunk) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit)
      crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
  }
  std::string result = png;
  result.insert(end_of_header, big_endian(9) + chunk + big_endian(~crc));
  return result;
}

} // namespace mergel::apps
