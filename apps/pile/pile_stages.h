/// The loading stages of a pile as written in a case file, one per key:
///
///     set stage 1 = penetrate to depth = 8.4 mm
///     set stage 2 = hold
///     set stage 3 = unload to head force = 0 N
///     set stage 4 = penetrate to depth = 9 mm
///     set stage 5 = hold for 0.2 ms
///     set stage 6 = load to head force = 50 N
///     set stage 7 = push to displacement = 0.1 mm at height = 2 mm
///     set stage 8 = pull to displacement = 0.1 mm
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace mergel::apps {

/// The forms that a stage may have, for help and messages.
extern const char* const forms_of_pile_stage;

struct PileStage {
  enum class Kind { penetrate, hold, unload, load, pull, push } kind = Kind::penetrate;
  /// Depth of the shoulder [m], head force of the full pile [N] or displacement [m]; of a hold
  /// its time [s], 0 to end in equilibrium.
  double target = 0.0;
  double height = 0.0; ///< of the pushed point above the surface [m]

  bool operator==(const PileStage&) const = default;
  bool is_by_force() const { return kind == Kind::unload || kind == Kind::load; }
  bool ends_in_equilibrium() const
  {
    return is_by_force() || (kind == Kind::hold && target == 0.0);
  }
};

/// @throws InputError with the error and the expected form; it does not repeat the text
PileStage read_pile_stage(const std::string& text);

/// "penetrate to depth = 8.4 mm"; for logs.
std::string name_of(const PileStage& stage);

/// Limits that the stages must keep.
struct PileLimits {
  double tip_height = 0.0; ///< of the pile [m]
  double diameter = 0.0;   ///< of the pile [m]
  double height = 0.0;     ///< of the DEM region [m]
};

/// A stage that cannot follow those before it.
struct StageFault {
  std::size_t stage = 0; ///< its index
  std::string message;
};
/// The first one, as far as it is known before the run: a head force or a depth under a head
/// force is not.
std::optional<StageFault> find_fault(const std::vector<PileStage>& stages,
                                     const PileLimits& limits);

} // namespace mergel::apps
