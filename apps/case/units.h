/// Numbers with units, as a user writes them: "1.4 mm" to 0.0014 [m] and back.
///
/// Bits are kept: where the unit differs from SI by a power of ten, the decimal point of
/// the text is shifted, so that "1.4 mm" is the literal 1.4e-3 exactly; only other units
/// (degree, rpm) go through a floating-point product.
#pragma once

#include <string>

namespace mergel::apps {

/// The value of `text` in `si_unit`.
///
/// @param text    a decimal number, then its unit: "1.4 mm", "0.63 GPa", "60 degree"
/// @param si_unit coherent SI unit of the result ("Pa", "m/s", "rad"); "1": a plain number
/// @returns a finite number
///
/// A plain number carries no unit at all, and an angle must carry one (udunits takes
/// radians, percent and 1 for the same thing; we do not).
/// @throws InputError saying what is wrong and what is expected, with an example; it does
///         not repeat the text
double to_si(const std::string& text, const std::string& si_unit);

/// `value` [si_unit] as text in `shown_unit` (the same dimension, "" for si_unit itself),
/// with the fewest digits that to_si() turns back into the same bits. Falls back to
/// `si_unit` where `shown_unit` cannot give them back.
/// @pre value is finite
/// @throws std::logic_error if the two units do not measure the same thing
std::string with_unit(double value, const std::string& si_unit,
                      const std::string& shown_unit = "");

/// A likely value in this unit, for messages: "0.63 GPa" for "Pa".
std::string example_of(const std::string& si_unit);

} // namespace mergel::apps
