#pragma once

#include "base/Error.h"
#include "base/json.h"

#include <string>

namespace faintline::jsonFields {

// Members of JSON objects that people write, each with a value for when it is left out. They throw Error naming
// `where` and the key.

double number(const Json &object, const std::string &where, const std::string &key, double otherwise);
bool flag(const Json &object, const std::string &where, const std::string &key);

/// Text of at most 80 bytes, on one line.
std::string text(const Json &object, const std::string &where, const std::string &key, const std::string &otherwise);

/// Index of one of some names.
template <class Names>
std::size_t choice(const Json &object, const std::string &where, const std::string &key, const Names &names,
                   std::size_t otherwise)
{
    const auto found = object.find(key);
    if (found == object.end())
        return otherwise;
    std::string known;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (found->is_string() && found->template get<std::string>() == names[i])
            return i;
        known += (i ? ", " : "") + std::string(names[i]);
    }
    throw Error(jsonName(where, key), "must be one of " + known);
}

} // namespace faintline::jsonFields
