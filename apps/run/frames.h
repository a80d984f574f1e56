/// Pictures of a run for ParaView: a file of each kind at each time, and their series.
#pragma once

#include "dem/io/state/state_file.h"
#include "dem/io/vtk.h"

#include <filesystem>
#include <vector>

namespace mergel::apps {

/// fields/NAME_0000.EXTENSION and so on of each kind, and NAME.pvd.
class Frames {
public:
  struct Kind {
    const char *name, *extension; ///< "particles", "vtp"
  };

  Frames(const std::filesystem::path& folder, std::vector<Kind> kinds);
  /// Go on with the frames that `earlier`, which may be the same folder, held when put()
  /// wrote `state`.
  Frames(const std::filesystem::path& folder, std::vector<Kind> kinds,
         const std::filesystem::path& earlier, const dem::State& state);

  /// Where the next frame of this kind, by its place in the list, is to be written.
  std::filesystem::path file(std::size_t kind) const;
  /// All kinds are written: they count as the frame of this time [s].
  void add(double time);

  /// @param frames null on all ranks but the first
  static void put(dem::State& state, const Frames* frames);
  /// Frames that there were.
  static std::size_t count(const dem::State& state);
  /// @throws InputError when a file is missing from `folder` that `state` tells of
  static void check(const std::filesystem::path& folder, const std::vector<Kind>& kinds,
                    const dem::State& state);

private:
  Frames(const std::filesystem::path& folder, std::vector<Kind> kinds,
         std::vector<double> times);

  std::filesystem::path fields_;
  std::vector<Kind> kinds_;
  std::vector<double> times_;       ///< [s]
  std::vector<dem::Series> series_; ///< as kinds_
};

/// Copy a file under a temporary name and rename it.
void copy_whole(const std::filesystem::path& from, const std::filesystem::path& to);

} // namespace mergel::apps
