#pragma once

#include "base/json.h"

#include <string>

namespace faintline {

/// What the JSON library says where a value is missing or of another kind, without the name of its exception.
std::string complaint(const Json::exception &error);

/// Calls `read`, which takes a JSON value apart with at(), value() and get(). What it does not find there, or finds to
/// be of another kind, becomes an Error that says where.
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
