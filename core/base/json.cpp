#include "base/json.h"

#include "base/oneLine.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace faintline {

namespace {

    std::string place(std::string_view text, std::size_t byte)
    {
        const std::string_view before = text.substr(0, byte > 0 ? byte - 1 : 0);
        const auto line = std::count(before.begin(), before.end(), '\n') + 1;
        const std::size_t lineStart = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
        return "line " + std::to_string(line) + ", column " + std::to_string(before.size() - lineStart + 1);
    }

    /// Builds a value like the library's own parser, but in time linear in the length of the text: objects have a
    /// limited number of keys, each of which is searched among the others. (The library's call-backs search a whole
    /// list for each of its members.)
    class BoundedParser : public nlohmann::detail::json_sax_dom_parser<Json>
    {
        using Base = nlohmann::detail::json_sax_dom_parser<Json>;
        static constexpr std::size_t nestingLimit = 100; // values are processed recursively
        static constexpr int mostKeys = 1000;

    public:
        BoundedParser(Json &value, const std::string &where) : Base(value), m_where(where) {}

        bool start_object(std::size_t size)
        {
            goDown();
            return Base::start_object(size);
        }
        bool start_array(std::size_t size)
        {
            goDown();
            return Base::start_array(size);
        }
        bool end_object()
        {
            m_keys.pop_back();
            return Base::end_object();
        }
        bool end_array()
        {
            m_keys.pop_back();
            return Base::end_array();
        }
        bool key(std::string &name)
        {
            if (++m_keys.back() > mostKeys)
                throw Error(m_where, "has an object of more than " + std::to_string(mostKeys)
                                         + " keys, the limit for "
                                           "any input");
            return Base::key(name);
        }

    private:
        void goDown()
        {
            m_keys.push_back(0);
            if (m_keys.size() > nestingLimit)
                throw Error(m_where, "is nested more than " + std::to_string(nestingLimit)
                                         + " levels deep, the limit for "
                                           "any input");
        }

        const std::string &m_where;
        std::vector<int> m_keys; ///< for each level
    };

    /// A value in an error message, without the contents of arrays and objects, which may be long.
    std::string shown(const Json &value)
    {
        if (value.is_structured())
            return value.is_array() ? "[…]" : "{…}";
        return value.is_string() ? value.get<std::string>() : value.dump();
    }

} // namespace

Json parseJson(std::string_view text, const std::string &where)
{
    if (text.starts_with("\xEF\xBB\xBF"))
        text.remove_prefix(3);
    Json value;
    try {
        BoundedParser parser(value, where);
        Json::sax_parse(text, &parser);
        return value;
    } catch (const Json::parse_error &error) {
        throw Error(where, "is not valid JSON at " + place(text, error.byte));
    } catch (const Json::exception &) {
        throw Error(where, "is not valid JSON: it contains a number that is too large");
    }
}

Json readJsonFile(const std::string &path)
{
    constexpr std::uintmax_t jsonFileLimitBytes = std::uintmax_t(64) << 20;
    std::error_code code;
    if (!std::filesystem::exists(path, code))
        throw Error(path, "no such file");
    if (!std::filesystem::is_regular_file(path, code))
        throw Error(path, "is not a file; expected a JSON file");
    const std::uintmax_t size = std::filesystem::file_size(path, code);
    if (!code && size > jsonFileLimitBytes)
        throw Error(path, "is larger than 64 MiB, too large for a JSON file");
    std::ifstream stream(path, std::ios::binary);
    std::string text(std::size_t(code ? 0 : size), '\0');
    if (code || !stream || !stream.read(text.data(), static_cast<std::streamsize>(text.size())))
        throw Error(path, "cannot be read");
    return parseJson(text, path);
}

void checkKeys(const Json &object, const std::string &where, const std::vector<std::string> &known)
{
    if (!object.is_object())
        throw Error(where.empty() ? "JSON" : where, "must be an object, { … }");
    for (const auto &item : object.items())
        if (std::find(known.begin(), known.end(), item.key()) == known.end())
            throw Error(jsonName(where, item.key()), "unknown; expected one of " + listed(known));
}

std::vector<Json> listOf(const Json &object, const std::string &key, const std::string &where)
{
    const auto found = object.find(key);
    if (found == object.end())
        return {};
    if (!found->is_array())
        throw Error(jsonName(where, key), "must be a list, [ … ]");
    return {found->begin(), found->end()};
}

FieldValue fieldValueFromJson(const Json &value, const FieldInfo &info)
{
    FieldValue result = shown(value);
    if (value.is_boolean()) {
        result = value.get<bool>();
    } else if (value.is_number() && info.kind == FieldKind::Integer) {
        const auto number = value.get<double>();
        if (std::floor(number) == number && std::abs(number) < 2147483648.0)
            result = int(number);
    } else if (value.is_number() && info.kind == FieldKind::Numbers) {
        result = std::vector{value.get<double>()}; // a list of one
    } else if (value.is_number()) {
        result = value.get<double>();
    } else if (value.is_string() && !info.words.empty()) {
        return parseFieldValue(info, value.get<std::string>());
    } else if (value.is_array() && info.kind == FieldKind::Numbers
               && std::all_of(value.begin(), value.end(), [](const Json &one) { return one.is_number(); })) {
        result = value.get<std::vector<double>>();
    }
    checkFieldValue(info, result);
    return result;
}

Json jsonFromFieldValue(const FieldValue &value)
{
    return std::visit([](const auto &held) { return Json(held); }, value);
}

std::string complaint(const Json::exception &error)
{
    const std::string text = error.what(); // "[json.exception.type_error.302] type must be string, but is number"
    if (error.id >= 304 && error.id <= 306)
        return "expected an object or a list, found a " + text.substr(text.rfind(' ') + 1);
    const std::size_t end = text.find("] ");
    return end == std::string::npos ? text : text.substr(end + 2);
}

} // namespace faintline
