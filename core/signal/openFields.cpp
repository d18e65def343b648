#include "signal/openFields.h"

#include "signal/formats/SampleType.h"

#include <algorithm>

namespace faintline {

namespace {

    /// Those of receivers first.
    std::vector<std::string> typeNames()
    {
        std::vector<std::string> names;
        for (const char *kind : {"c", "r"})
            for (const char *number : {"i16_le", "i8", "u8", "f32_le", "f64_le", "i32_le", "u16_le", "u32_le", "i16_be",
                                       "f32_be", "f64_be", "i32_be", "u16_be", "u32_be"})
                names.push_back(std::string(kind) + number);
        return names;
    }

    Field<OpenOptions> typeField()
    {
        Field<OpenOptions> result;
        result.name = "rawType";
        result.kind = FieldKind::Choice;
        result.choices = typeNames();
        result.sentence = "Type of a sample, as in SigMF: c or r (complex or real), f, i or u (float, signed, "
                          "unsigned), bits, and the byte order.";
        result.get = [](const OpenOptions &options) { return FieldValue(options.rawType); };
        result.set = [](OpenOptions &options, const FieldValue &value) {
            options.rawType = std::get<std::string>(value);
        };
        return result.labelled("Type");
    }

    Field<OpenOptions> headerField()
    {
        Field<OpenOptions> result = field(&OpenOptions::rawChannels, "rawHeaderBytes", "bytes", 0, 2147483647.0,
                                          "What precedes the first sample.");
        result.get = [](const OpenOptions &options) { return FieldValue(int(options.rawHeaderBytes)); };
        result.set = [](OpenOptions &options, const FieldValue &value) {
            options.rawHeaderBytes = std::get<int>(value);
        };
        return result.labelled("Skip at the start");
    }

} // namespace

const std::vector<Field<OpenOptions>> &openFields()
{
    using S = OpenOptions;
    static const std::vector<Field<S>> table{
        typeField(),
        field(&S::rawRateHz, "rawRateHz", "Hz", 1e-9, 1e15, "Samples of a channel per second.").labelled("Sample rate"),
        field(&S::rawChannels, "rawChannels", "", 1, 1024, "Channels, whose samples alternate.").labelled("Channels"),
        headerField(),
        field(&S::iq, "iq", "Take real channels in pairs, as I and Q of one complex channel.")
            .labelled("Pairs are I/Q"),
    };
    return table;
}

Json toJson(const OpenOptions &options)
{
    Json json = options.rawType.empty() ? Json::object() : writeFields(options, openFields());
    if (options.iq)
        json["iq"] = true;
    return json;
}

OpenOptions openOptionsFromJson(Json json, const std::string &where, std::initializer_list<const char *> otherKeys)
{
    if (json.contains("rawType") && json["rawType"].is_string())
        json["rawType"] = parseSampleType(json["rawType"].get<std::string>(), jsonName(where, "rawType")).name();
    OpenOptions options;
    readFields(json, openFields(), options, where, otherKeys);
    return options;
}

} // namespace faintline
