#include "exchange/survey/SurveyOrigin.h"

#include "base/Error.h"
#include "base/json.h"
#include "base/wholeNumber.h"
#include "evaluate/comparison/settingDifferences.h"
#include "plan/calibrationVersion.h"

namespace faintline {

namespace {

    std::string shownSettings(const SurveyOrigin &origin)
    {
        return origin.settings == "{}" ? "the defaults" : origin.settings;
    }

    /// "spectrogram.windowSeconds = 0.5, here 1": the first setting that differs.
    std::string firstDifference(const SurveyOrigin &there, const SurveyOrigin &wanted)
    {
        const auto differences =
            settingDifferences(settingsFromJson(there.settings, "there"), settingsFromJson(wanted.settings, "here"));
        if (differences.empty())
            return shownSettings(there);
        const SettingDifference &first = differences.front();
        return first.field.name + " = " + first.a + " there, " + first.b + " here";
    }

} // namespace

SurveyOrigin originOf(const SurveySettings &settings, const std::string &shard)
{
    const OpenOptions &open = settings.open;
    Json reading = Json::object();
    if (open.iq)
        reading["iq"] = true;
    if (!open.rawType.empty())
        reading = {{"iq", open.iq},
                   {"rawType", open.rawType},
                   {"rawRateHz", open.rawRateHz},
                   {"rawChannels", open.rawChannels},
                   {"rawHeaderBytes", open.rawHeaderBytes}};
    return {settingsToJson(settings.analysis), reading.dump(), FAINTLINE_VERSION, std::to_string(calibrationVersion),
            shard};
}

SurveySettings settingsOf(const SurveyOrigin &origin, const std::string &where)
{
    const Json reading = parseJson(origin.reading, where);
    return readingJson(where, [&] {
        OpenOptions open;
        open.iq = reading.value("iq", false);
        open.rawType = reading.value("rawType", std::string());
        open.rawRateHz = reading.value("rawRateHz", 0.0);
        open.rawChannels = wholeNumber(reading, where, "rawChannels", 1);
        open.rawHeaderBytes = wholeNumber(reading, where, "rawHeaderBytes", Index(0));
        return SurveySettings{settingsFromJson(origin.settings, where), open};
    });
}

void checkOrigin(const SurveyOrigin &there, const SurveyOrigin &wanted, const std::string &path)
{
    const std::string advice = "; choose another name for this survey";
    if (there.settings != wanted.settings)
        throw Error(path, "is a survey with other settings: " + firstDifference(there, wanted) + advice);
    if (there.reading != wanted.reading)
        throw Error(path, "is a survey with other reading options: " + there.reading + " there, " + wanted.reading
                              + " here" + advice);
    if (there.version != wanted.version)
        throw Error(path,
                    "was written by Faintline " + there.version + "; this is Faintline " + wanted.version + advice);
    if (there.calibrations != wanted.calibrations)
        throw Error(path, "was written with calibrations of version "
                              + (there.calibrations.empty() ? "?" : there.calibrations) + "; here they have version "
                              + wanted.calibrations + advice);
    if (there.shard != wanted.shard)
        throw Error(path, "contains " + (there.shard.empty() ? "a whole survey" : "shard " + there.shard) + ", not "
                              + (wanted.shard.empty() ? "a whole survey" : "shard " + wanted.shard) + advice);
}

} // namespace faintline
