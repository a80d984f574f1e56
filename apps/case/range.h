/// Allowed values of a number in a case file, and their text.
#pragma once

#include <limits>
#include <string>

namespace mergel::apps {

/// The values a number may take, bounds in SI, with their text: "0 <= nu < 0.5".
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool is_lower_open = false, is_upper_open = false; ///< bound itself excluded
  std::string symbol = "value";                      ///< name of the number in the text
  std::string remedy = "";                           ///< printed after a violation

  bool holds(double value) const; ///< false for NaN
  /// "0 < value <= 3 MPa", bounds shown as by with_unit(). "any number" without bounds.
  std::string text(const std::string& si_unit, const std::string& shown_unit = "") const;
  Range named(std::string new_symbol) const;  ///< the same under another symbol
  Range advise(std::string new_remedy) const; ///< the same with this remedy
};

inline const Range any{};
inline const Range positive{.lower = 0.0, .is_lower_open = true};
inline const Range non_negative{.lower = 0.0};
/// a <= value <= b
Range between(double a, double b);
/// a <= value < b
Range from_to(double a, double b);
/// a < value <= b
Range above_to(double a, double b);
/// a < value < b
Range inside(double a, double b);
/// a <= value
Range at_least(double a);

} // namespace mergel::apps
