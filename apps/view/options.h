/// What the command line of mergel-view asks for.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mergel::apps {

/// Of a picture [pixels].
struct PictureSize {
  int width = 1600, height = 1200;
};

struct Options {
  std::vector<std::string> folders; ///< of the runs
  std::vector<std::string> labels;  ///< of the folders, in their order; empty: their names
  std::filesystem::path output;     ///< of the pictures; empty: the only folder
  std::vector<std::string> curves;  ///< "X:Y" of each panel of curve.png; empty: none
  std::vector<std::string> points;  ///< files that are laid over the curves
  std::vector<std::string> compare; ///< files of measured curves; empty: none
  std::string stage;                ///< of element runs; empty: all
  bool is_mean = false;             ///< runs that differ only by seed are one curve
  int frame = -1;
  bool has_frame = false, has_size = false;
  PictureSize size;
};

/// None where the command line asked for --help, which is printed, or is wrong, which is
/// said: then `code` is the exit code.
/// @throws InputError when a value cannot be
std::optional<Options> read_options(int argc, char** argv, int& code);

} // namespace mergel::apps
