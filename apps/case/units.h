/// Numbers with units, as a user writes them: "1.4 mm" to 0.0014 [m] and back.
///
/// Where the unit differs from SI by a power of ten, the decimal point of the text is
/// shifted, so that "1.4 mm" is the literal 1.4e-3 exactly; only other units (degree, rpm)
/// need a floating-point product.
#pragma once

#include <string>

namespace mergel::apps {

/// The value of `text` in `si_unit`.
///
/// @param text    a decimal number, then its unit: "1.4 mm", "0.63 GPa", "60 degree"
/// @param si_unit coherent SI unit of the result ("Pa", "m/s", "rad"); "1": a plain number
/// @returns a finite number
///
/// A plain number has no unit, and an angle must have one (udunits treats radians, percent
/// and 1 as the same; this function does not).
/// @throws InputError with the error, the expected form and an example; the message does
///         not repeat the text
double to_si(const std::string& text, const std::string& si_unit);

/// `value` [si_unit] as text in `shown_unit` (the same dimension, "" for si_unit itself),
/// with the fewest digits that to_si() turns back into the same bits. Falls back to
/// `si_unit` where `shown_unit` cannot give the same bits.
/// @pre value is finite
/// @throws std::logic_error if the two units have different dimensions
std::string with_unit(double value, const std::string& si_unit,
                      const std::string& shown_unit = "");

/// Size of a unit in another of the same dimension: 0.001 for "um" in "mm". Pure numbers have
/// "-" and "%".
/// @throws InputError when there is no such
double unit_size(const std::string& unit, const std::string& base);

/// A likely value in this unit, for messages: "0.63 GPa" for "Pa".
std::string example_of(const std::string& si_unit);

} // namespace mergel::apps
