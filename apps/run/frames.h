/// Frames of a run for ParaView: at each time one file of each kind, and a series of each
/// kind.
#pragma once

#include "dem/io/assembly_frame.h"
#include "dem/io/state/state_file.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace mergel::apps {

/// Of each kind the files fields/NAME_0000.EXTENSION and so on, and their series NAME.pvd.
class Frames {
public:
  struct Kind {
    const char *name, *extension; ///< "particles", "vtp"
  };

  Frames(const std::filesystem::path& folder, std::vector<Kind> kinds);
  /// Continue the frames that the folder `earlier`, which may be `folder`, held when save()
  /// wrote `state`. The series list those that are still there.
  Frames(const std::filesystem::path& folder, std::vector<Kind> kinds,
         const std::filesystem::path& earlier, const dem::State& state);

  /// File of the next frame. @param kind index in the list of kinds
  std::filesystem::path file(std::size_t kind) const;
  /// Add the frame of this time [s] to the series, after the files of all kinds are
  /// written.
  void add(double time);

  /// @param frames null on all ranks but the first
  static void save(dem::State& state, const Frames* frames);
  /// Number of frames in the state; 0 for a job without frames.
  static std::size_t count(const dem::State& state);
  /// A line on frames in `state` that are missing from `folder`; "" when none is.
  static std::string check(const std::filesystem::path& folder,
                           const std::vector<Kind>& kinds, const dem::State& state);

private:
  std::filesystem::path fields_;
  std::vector<Kind> kinds_;
  std::vector<double> times_;       ///< [s]
  std::vector<dem::Series> series_; ///< as kinds_
};

/// Copy the specimen of the folder `earlier`, if it is there, to the folder where the run
/// continues, if that is another.
void copy_specimen(const std::filesystem::path& earlier,
                   const std::filesystem::path& folder);

/// Write the assembly's files of a frame, each rank those that it has, while the first rank also
/// runs `others`. Collective.
/// @param files names on the first rank; the others get them from there
/// @throws CollectiveFailure on all ranks when one of them cannot write
void write_together(const dem::FrameFiles& frame, dem::AssemblyFiles files,
                    const std::function<void()>& others);

} // namespace mergel::apps
