#pragma once

#include "base/json.h"

#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

namespace faintline {

/// Reads an integer and checks that it is whole and fits the type, which the JSON library does not do; throws Error
/// naming `where`.
template <std::integral T>
T wholeNumber(const Json &value, const std::string &where)
{
    constexpr double exact = 9007199254740992.0; // 2⁵³
    const double number = value.is_number() ? value.get<double>() : std::nan("");
    if (value.is_number_unsigned() && std::in_range<T>(value.get<std::uint64_t>()))
        return static_cast<T>(value.get<std::uint64_t>());
    if (!value.is_number_unsigned() && std::floor(number) == number && std::abs(number) <= exact
        && std::in_range<T>(std::int64_t(number)))
        return static_cast<T>(number);
    throw Error(where, "must be a whole number in " + std::to_string(std::numeric_limits<T>::min()) + " … "
                           + std::to_string(std::numeric_limits<T>::max()));
}

/// Reads the integer under `key` of an object, or returns `otherwise` if the key is missing.
template <std::integral T>
T wholeNumber(const Json &object, const std::string &where, const char *key, T otherwise)
{
    return object.contains(key) ? wholeNumber<T>(object[key], jsonName(where, key)) : otherwise;
}

} // namespace faintline
