/// Lines through several tests: strength and critical states. Each says which tests it rests
/// on, which it leaves out, and why there is none.
#pragma once

#include "apps/laboratory/test_reading.h"
#include "dem/element/element_analysis.h"
#include "dem/element/strength_envelope.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace mergel::apps {

/// The tests of a line.
struct Selection {
  std::vector<std::size_t> tests;    ///< their numbers
  std::vector<std::string> left_out; ///< "b: q has no peak", one for each other test
  std::string why_not;               ///< why there is no line; empty: there is one
};

struct StrengthFit {
  Selection of;
  std::vector<dem::MohrCircle> circles; ///< one for each test
  std::optional<dem::CoulombLine> line;
  /// Of the tests of a line in the critical state, the volumetric over axial strain rate that is
  /// furthest from zero [-]; 0 at the peak.
  double volume_rate = 0.0;

  /// R2 of the line [-]. None of two tests: any two points lie on a line.
  std::optional<double> R2() const;
  /// "caution: ..." where the volume of a test in the critical state still changes by more than a
  /// tenth of its axial strain; else empty.
  std::string caution() const;
};

/// At the peak of q of sheared tests. A peak at a smaller q/p than the test has at its end is
/// left out: there the rock collapses under pressure, and its strength falls with it. None for
/// fewer than two confining pressures, and where sigma_1 - sigma_3 falls with sigma_3 by more
/// than two standard errors.
StrengthFit peak_strength(const std::vector<TestReading>& tests);

/// In the critical state.
StrengthFit critical_strength(const std::vector<TestReading>& tests);

struct CriticalFit {
  Selection of;
  std::optional<dem::StraightLine> line; ///< e over (p/p_a)^0.7
  std::optional<dem::StressRatio> ratio; ///< q/p
  std::array<double, 2> volume_rates{};  ///< smallest and largest of the tests [-]
};

/// None for fewer than three confining pressures: through two there is always a line.
CriticalFit critical_states_of(const std::vector<TestReading>& tests);

/// The Coulomb line in words: "c = 0.98 +- 0.03 MPa, phi = 34.2 +- 0.4 degrees".
std::string in_words(const dem::CoulombLine& line);
std::string in_words(const dem::StraightLine& critical_state_line);
std::string in_words(const dem::StressRatio& ratio);
/// "volume still changes by -0.34 to -0.2 of the axial strain".
std::string volume_in_words(const CriticalFit& fit);

} // namespace mergel::apps
