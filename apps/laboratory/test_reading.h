/// What a rock laboratory reads off one test: moduli, yield, peak, the state at the end.
/// Compression positive.
#pragma once

#include "apps/laboratory/findings.h"
#include "apps/laboratory/test_case.h"
#include "dem/element/strength_envelope.h"
#include "dem/io/table.h"

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace mergel::apps {

/// Axial strain before which a test is not in its critical state [-].
inline constexpr double critical_strain = 0.1;

inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// A record of the stage that is read.
struct StressState {
  double strain = no_value;          ///< axial, from the start of the stage [-]
  double p = no_value, q = no_value; ///< [Pa]
  double e = no_value;               ///< void ratio [-]

  dem::MohrCircle circle() const { return {p + 2.0 / 3.0 * q, p - q / 3.0}; }
};

enum class TestKind {
  triaxial,   ///< axial compression at constant lateral stress
  unconfined, ///< the same without lateral stress
  tension,    ///< pulled, without lateral stress
  isotropic,
  oedometer, ///< axial compression without lateral strain
  brazilian, ///< of a disc; it has a strength and the strain of its end alone
  other      ///< any other path: its yield and its end are read
};
std::string name_of(TestKind kind);

/// Values that a test does not have are NaN.
struct TestReading {
  std::filesystem::path folder;
  std::string label;
  TestCase test_case;
  TestKind kind = TestKind::other;
  std::size_t stage = 0; ///< that is read, from 1

  double confinement = no_value; ///< lateral stress of a triaxial test, mean [Pa]
  double E = no_value, nu = no_value, K = no_value; ///< of the summary [Pa], [-], [Pa]
  double M = no_value; ///< constrained modulus of an oedometer, of the summary [Pa]
  double tensile_strength = no_value;   ///< direct [Pa]
  double brazilian_strength = no_value; ///< largest 2P/(pi D t) [Pa]
  std::optional<StressState> yield;
  /// Of one fall of q, or of p in an isotropic test, by a tenth of the peak or more.
  std::optional<StressState> peak, minimum;
  std::optional<StressState> largest; ///< of the largest q, or p
  StressState end;                    ///< mean over the last tenth of the strain
  double end_strain = no_value;       ///< of the last record [-]
  /// Change of volumetric over that of axial strain at the end, negative: it dilates [-].
  double volume_rate = no_value;
  /// Why the end is not taken for a critical state; empty: it is, because q/p is steady
  /// beyond a tenth of axial strain, as in the paper, Fig. 15b. Volume may still change there
  /// (Fig. 15d): see volume_rate.
  std::string not_critical;
  std::vector<StressState> curve; ///< without unloading and reloading
  std::vector<std::size_t> loops; ///< states of the curve before which there was that
  bool is_finished = false;       ///< otherwise moduli and yield are missing

  bool is_sheared() const
  {
    return kind == TestKind::triaxial || kind == TestKind::unconfined;
  }
};

/// Refuse a history whose stages are not numbered as in its case: earlier versions counted an
/// unload-reload as two. One that has not begun changes nothing.
/// @pre the history is not empty
/// @throws InputError naming the history
void require_numbers_of_case(const dem::Table& history, const TestCase& test_case);

/// The first stage of triaxial compression of a test; without one the first under tension,
/// otherwise the first in an oedometer, otherwise the last isotropic stage, otherwise the last
/// stage.
/// A Brazilian test has no stages.
/// @throws InputError naming the history when it is none of an element, triaxial or Brazilian
///   test, or holds none of its stages
TestReading reading_of(const dem::Table& history, const TestCase& test_case,
                       const std::optional<RunFindings>& found);

/// That of a results folder.
TestReading read_test(const std::filesystem::path& folder, const std::string& label);

/// The names of folders; their paths where two have one name.
std::vector<std::string> folder_labels(const std::vector<std::string>& folders);

} // namespace mergel::apps
