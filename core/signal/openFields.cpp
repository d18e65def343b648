#include "signal/openFields.h"

#include "base/wholeNumber.h"
#include "signal/formats/SampleType.h"

#include <algorithm>
#include <limits>

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

    /// Of a form; files and the command line know longer ones.
    constexpr Index headerLimit = std::numeric_limits<int>::max();

    Field<OpenOptions> headerField()
    {
        Field<OpenOptions> result = field(&OpenOptions::rawChannels, "rawHeaderBytes", "bytes", 0, double(headerLimit),
                                          "What precedes the first sample.");
        result.get = [](const OpenOptions &options) {
            return FieldValue(int(std::min(options.rawHeaderBytes, headerLimit)));
        };
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
    if (!options.rawType.empty())
        json["rawHeaderBytes"] = options.rawHeaderBytes;
    if (options.rawRateHz == 0.0) // known from the file's name
        json.erase("rawRateHz");
    if (options.iq)
        json["iq"] = true;
    return json;
}

OpenOptions openOptionsFromJson(Json json, const std::string &where, std::initializer_list<const char *> otherKeys)
{
    OpenOptions options;
    if (json.contains("rawHeaderBytes")) {
        options.rawHeaderBytes = wholeNumber<Index>(json["rawHeaderBytes"], jsonName(where, "rawHeaderBytes"));
        if (options.rawHeaderBytes < 0)
            throw Error(jsonName(where, "rawHeaderBytes") + " = " + std::to_string(options.rawHeaderBytes),
                        "must be 0 or more");
        json.erase("rawHeaderBytes");
    }
    if (json.contains("rawType")) {
        const std::string name = jsonName(where, "rawType");
        if (!json["rawType"].is_string())
            throw Error(name, "must be a sample type, such as ci16_le");
        if (const auto type = json["rawType"].get<std::string>(); type.empty())
            json.erase("rawType");
        else
            json["rawType"] = parseSampleType(type, name).name();
    }
    if (json.contains("rawRateHz") && json["rawRateHz"].is_number() && json["rawRateHz"].get<double>() == 0.0)
        json.erase("rawRateHz");
    readFields(json, openFields(), options, where, otherKeys);
    return options;
}

} // namespace faintline
