#pragma once

#include "base/json.h"

#include <string>

namespace faintline {

/// The JSON library's message about a missing value or a wrong type, without the exception's name.
std::string complaint(const Json::exception &error);

/// Calls `read`, which accesses JSON through at(), value() and get(). If a value is missing or has the wrong type,
/// throws an Error that names the place.
template <class Read>
auto readingJson(const std::string &where, const Read &read)
{
    try {
        return read();
    } catch (const Json::exception &error) {
        throw Error(where, "has the wrong type or is missing: " + complaint(error));
    }
}

} // namespace faintline
