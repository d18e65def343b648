#include "scene/Truth.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    const std::vector<Field<TruthLine>> &lineFields()
    {
        using S = TruthLine;
        static const std::vector<Field<S>> table{
            field(&S::startSeconds, "startSeconds", "s", -1e12, 1e12, "Start time of the line."),
            field(&S::endSeconds, "endSeconds", "s", -1e12, 1e12, "End time of the line."),
            field(&S::snrDb, "snrDb", "dB", -1e3, 1e3, "SNR of the line in a rectangular window of referenceSeconds."),
            field(&S::referenceSeconds, "referenceSeconds", "s", 0.0, 1e12,
                  "Length of the window to which the SNR "
                  "refers."),
            field(&S::amplitude, "amplitude", "", 0.0, 1e30, "Amplitude of the tone; full scale is 1."),
            field(&S::stepSeconds, "stepSeconds", "s", 0.0, 1e12, "Time between the values of frequencyHz."),
            field(&S::frequencyHz, "frequencyHz", "Hz", -1e15, 1e15, "Frequency from the start, one value per step."),
        };
        return table;
    }

} // namespace

double TruthLine::frequencyAt(double seconds) const
{
    const double last = double(frequencyHz.size() - 1);
    const double position = stepSeconds > 0.0 ? std::clamp((seconds - startSeconds) / stepSeconds, 0.0, last) : 0.0;
    const auto index = std::size_t(position);
    return index + 1 < frequencyHz.size()
               ? std::lerp(frequencyHz[index], frequencyHz[index + 1], position - std::floor(position))
               : frequencyHz.back();
}

Json toJson(const Truth &truth)
{
    Json json;
    json["lines"] = Json::array();
    for (const TruthLine &line : truth.lines)
        json["lines"].push_back(writeFields(line, lineFields()));
    return json;
}

Truth truthFromJson(const Json &json)
{
    checkKeys(json, "truth", {"lines"});
    Truth truth;
    const auto lines = json.find("lines");
    if (lines == json.end() || !lines->is_array())
        throw Error("truth.lines", "must be a list, [ … ]");
    truth.lines.resize(lines->size());
    for (std::size_t i = 0; i < lines->size(); ++i) {
        const std::string name = "lines[" + std::to_string(i) + "]";
        readFields((*lines)[i], lineFields(), truth.lines[i], name);
        if (truth.lines[i].frequencyHz.empty())
            throw Error(name + ".frequencyHz", "must hold at least one value");
    }
    return truth;
}

} // namespace faintline
