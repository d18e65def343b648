#pragma once

#include <string>
#include <string_view>

namespace faintline {

/// A number to be read by people: as formatNumber, but without an exponent where up to 15 digits do: "1420000000" in
/// place of "1.42e+09".
std::string formatPlainly(double value);

/// A number to be read by people, with as many significant digits as tell values a tenth of `step` apart, at least
/// `leastDigits`, and without an exponent from 0.0001 to 1e15.
std::string formatToStep(double value, double step, int leastDigits);

/// Whether a text would be a number with a decimal point in place of its comma: "0,5".
bool hasDecimalComma(std::string_view text);

} // namespace faintline
