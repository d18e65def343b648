#pragma once

#include "base/Error.h"
#include "base/Field.h"

#include <nlohmann/json.hpp>

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace faintline {

/// JSON that keeps the order of its keys.
using Json = nlohmann::ordered_json;

/// Parses JSON of at most 100 levels and 1000 keys per object; throws Error{where, line, column and cause}.
Json parseJson(std::string_view text, const std::string &where);

/// Reads JSON from a file of at most 64 MiB; throws Error naming the file.
Json readJsonFile(const std::string &path);

/// Checks that a value is an object with known keys only; throws Error naming the key and the known ones.
void checkKeys(const Json &object, const std::string &where, const std::vector<std::string> &known);

/// Converts JSON to a setting's value and checks its kind and range; throws Error.
FieldValue fieldValueFromJson(const Json &value, const FieldInfo &info);

Json jsonFromFieldValue(const FieldValue &value);

/// Joins `where` and a key to one name: "lines[2].snrDb".
inline std::string jsonName(const std::string &where, const std::string &key)
{
    return where.empty() ? key : where + "." + key;
}

/// The elements of a list under a key; empty if the key is missing. Throws Error naming `where.key` for other values.
std::vector<Json> listOf(const Json &object, const std::string &key, const std::string &where = {});

/// Sets the members of a struct for which a JSON object has keys. Throws Error naming `where.key` for keys in neither
/// the table nor `otherKeys`, and for values of the wrong kind or out of range.
template <class S>
void readFields(const Json &object, const std::vector<Field<S>> &fields, S &settings, const std::string &where = {},
                std::initializer_list<const char *> otherKeys = {})
{
    std::vector<std::string> known(otherKeys.begin(), otherKeys.end());
    for (const Field<S> &entry : fields)
        known.push_back(entry.name);
    checkKeys(object, where, known);
    for (const Field<S> &entry : fields) {
        const auto found = object.find(entry.name);
        if (found == object.end())
            continue;
        FieldInfo info = entry;
        info.name = jsonName(where, entry.name);
        entry.set(settings, fieldValueFromJson(*found, info));
    }
}

/// Checks each member of a struct against its range; throws Error naming `where.member`.
template <class S>
void checkFields(const S &settings, const std::vector<Field<S>> &fields, const std::string &where = {})
{
    for (const Field<S> &entry : fields) {
        FieldInfo info = entry;
        info.name = jsonName(where, entry.name);
        if (const std::optional<FieldValue> value = entry.get(settings))
            checkFieldValue(info, *value);
    }
}

template <class S>
Json writeFields(const S &settings, const std::vector<Field<S>> &fields)
{
    Json object = Json::object();
    for (const Field<S> &entry : fields)
        if (const std::optional<FieldValue> value = entry.get(settings))
            object[entry.name] = jsonFromFieldValue(*value);
    return object;
}

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
