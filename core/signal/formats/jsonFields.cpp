#include "signal/formats/jsonFields.h"

#include "base/oneLine.h"

namespace faintline::jsonFields {

double number(const Json &object, const std::string &where, const std::string &key, double otherwise)
{
    const auto found = object.find(key);
    if (found == object.end())
        return otherwise;
    if (!found->is_number())
        throw Error(jsonName(where, key), "must be a number");
    return found->get<double>();
}

bool flag(const Json &object, const std::string &where, const std::string &key)
{
    const auto found = object.find(key);
    if (found == object.end())
        return false;
    if (!found->is_boolean())
        throw Error(jsonName(where, key), "must be true or false");
    return found->get<bool>();
}

std::string text(const Json &object, const std::string &where, const std::string &key, const std::string &otherwise)
{
    const auto found = object.find(key);
    if (found == object.end())
        return otherwise;
    if (!found->is_string())
        throw Error(jsonName(where, key), "must be a string");
    constexpr std::size_t mostBytes = 80; // names and units appear on labels and in terminals
    return oneLine(found->get<std::string>(), mostBytes);
}

} // namespace faintline::jsonFields
