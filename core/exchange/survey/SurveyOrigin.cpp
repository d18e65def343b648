#include "exchange/survey/SurveyOrigin.h"

#include "base/Error.h"
#include "evaluate/comparison/settingDifferences.h"
#include "plan/calibrationVersion.h"
#include "signal/openFields.h"

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
    return {settingsToJson(settings.analysis), toJson(settings.open).dump(), FAINTLINE_VERSION,
            std::to_string(calibrationVersion), shard};
}

SurveySettings settingsOf(const SurveyOrigin &origin, const std::string &where)
{
    return {settingsFromJson(origin.settings, where), openOptionsFromJson(parseJson(origin.reading, where), where)};
}

void checkOrigin(const SurveyOrigin &there, const SurveyOrigin &wanted, const std::string &path)
{
    const std::string advice = "; choose another name for this survey";
    if (there.settings != wanted.settings)
        throw Error(path, "is a survey with other settings: " + firstDifference(there, wanted) + advice);
    if (openOptionsFromJson(parseJson(there.reading, path), path)
        != openOptionsFromJson(parseJson(wanted.reading, path), path))
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
