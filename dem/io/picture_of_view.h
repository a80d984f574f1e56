/// The mark by which a picture of mergel-view is known.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace mergel::dem {

inline constexpr char software_of_pictures[] =
    "mergel-view"; ///< text `Software` of the PNG

/// Whether a file is a PNG that mergel-view has made: other files of such a name are the user's.
/// False where it cannot be read.
inline bool is_picture_of_view(const std::filesystem::path& png)
{
  using namespace std::string_view_literals;
  std::ifstream in(png, std::ios::binary);
  std::string head(4096, '\0'); // the mark stands before the image
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  return head.starts_with("\x89PNG\r\n\x1a\n") &&
         head.find(std::string("Software\0"sv) + software_of_pictures) != std::string::npos;
}

} // namespace mergel::dem
