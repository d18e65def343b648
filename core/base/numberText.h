#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace faintline {

/// Shortest decimal form of a number that reads back the same, in the C locale.
std::string formatNumber(double value);

/// A number to be read by people: as formatNumber, but without an exponent where up to 15 digits do: "1420000000" in
/// place of "1.42e+09".
std::string formatPlainly(double value);

/// A number to be read by people, with as many significant digits as tell values a tenth of `step` apart, at least
/// `leastDigits`, and without an exponent from 0.0001 to 1e15.
std::string formatToStep(double value, double step, int leastDigits);

/// Converts the whole text to a number, in the C locale; returns nothing if it is not a number.
std::optional<double> parseNumber(std::string_view text);

/// Whether a text would be a number with a decimal point in place of its comma: "0,5".
bool hasDecimalComma(std::string_view text);

} // namespace faintline
