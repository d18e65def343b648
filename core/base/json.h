#pragma once

#include "base/Error.h"
#include "base/Field.h"

#include <nlohmann/json.hpp>

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace faintline {

/// JSON whose keys keep the order in which they were written.
using Json = nlohmann::ordered_json;

/// Text → JSON, of at most 100 levels and 1000 keys an object; throws Error{where, line and column and what is wrong}.
Json parseJson(std::string_view text, const std::string &where);

/// The JSON in a file of at most 64 MiB; throws Error naming the file.
Json readJsonFile(const std::string &path);

/// Checks that a value is an object that holds no key but the known ones; throws Error naming the key and the known
/// ones.
void checkKeys(const Json &object, const std::string &where, const std::vector<std::string> &known);

/// One setting's value from JSON, checked against its kind and range; throws Error.
FieldValue fieldValueFromJson(const Json &value, const FieldInfo &info);

Json jsonFromFieldValue(const FieldValue &value);

/// `where` and a key as one name: "lines[2].snrDb".
inline std::string jsonName(const std::string &where, const std::string &key)
{
    return where.empty() ? key : where + "." + key;
}

/// Sets those members of a struct that a JSON object has keys for. Keys in neither the table nor `otherKeys`, values of
/// the wrong kind or out of range throw Error naming `where.key`.
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

/// Checks every member of a struct against its range; throws Error naming `where.member`.
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

} // namespace faintline
