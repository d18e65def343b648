#include "plan/AnalysisSettings.h"

#include "base/Error.h"
#include "base/editDistance.h"
#include "base/json.h"
#include "model/sonarModels.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace faintline {

namespace {

    template <class T>
    void append(std::vector<Field<AnalysisSettings>> &table, const std::string &prefix, T AnalysisSettings::*member)
    {
        auto fields =
            within<AnalysisSettings>(prefix, T::fields(), [member](auto &settings) { return &(settings.*member); });
        table.insert(table.end(), fields.begin(), fields.end());
    }

    /// Selects the detector; another kind gets its default settings.
    Field<AnalysisSettings> detectorKind()
    {
        Field<AnalysisSettings> kind;
        kind.name = "detector.kind";
        kind.sentence = "The detector: sequential Markov, P out of N, integrator, single-frame energy, fixed-window "
                        "Viterbi, Shiryaev-Roberts.";
        kind.label = "Kind";
        kind.advice =
            "The sequential Markov detector finds signals of unknown onset, duration and drift. The others are "
            "faster, simpler, and there for comparison: the integrator and the energy do not follow drift, P "
            "out of N counts exceedances, fixed-window Viterbi decides once a block.";
        kind.kind = FieldKind::Choice;
        kind.choices.assign(detectorNames.begin(), detectorNames.end());
        kind.get = [](const AnalysisSettings &settings) {
            return std::string(detectorNames[settings.detector.index()]);
        };
        kind.set = [](AnalysisSettings &settings, const FieldValue &value) {
            const auto found = std::find(detectorNames.begin(), detectorNames.end(), std::get<std::string>(value));
            const auto index = std::size_t(found - detectorNames.begin());
            if (index < detectorNames.size() && index != settings.detector.index())
                settings.detector = detectorOfKind(index);
        };
        return kind;
    }

    template <std::size_t... I>
    void appendDetectors(std::vector<Field<AnalysisSettings>> &table, std::index_sequence<I...>)
    {
        const auto append = [&](const auto &fields) { table.insert(table.end(), fields.begin(), fields.end()); };
        (append(within<AnalysisSettings>(std::string(detectorNames[I]),
                                         std::variant_alternative_t<I, DetectorSettings>::fields(),
                                         [](auto &settings) { return std::get_if<I>(&settings.detector); })),
         ...);
    }

    int slopeIndex(double slope, int slopesPerBin)
    {
        return int(std::lround(slope * slopesPerBin));
    }

    SonarMotion turning(const ModelSettings &settings)
    {
        SonarMotion motion = manoeuvring();
        motion.rangeRateChange = settings.rangeRateChange;
        motion.bearingRateChange = settings.bearingRateChange;
        return motion;
    }

} // namespace

int slopeCount(const ModelSettings &model)
{
    return slopeIndex(model.highestSlope, model.slopesPerBin) - slopeIndex(model.lowestSlope, model.slopesPerBin) + 1;
}

const std::vector<Field<AnalysisSettings>> &AnalysisSettings::fields()
{
    static const std::vector<Field<AnalysisSettings>> table = [] {
        using S = AnalysisSettings;
        std::vector<Field<S>> all;
        append(all, "selection", &S::selection);
        append(all, "spectrogram", &S::spectrogram);
        append(all, "noise", &S::noise);
        append(all, "pings", &S::pings);
        append(all, "family", &S::family);
        append(all, "model", &S::model);
        all.push_back(detectorKind());
        appendDetectors(all, std::make_index_sequence<detectorNames.size()>());
        append(all, "decide", &S::decide);
        append(all, "track", &S::track);
        append(all, "subtract", &S::subtract);
        append(all, "conventional", &S::conventional);
        return all;
    }();
    return table;
}

const Field<AnalysisSettings> &settingField(std::string_view name)
{
    const auto &fields = AnalysisSettings::fields();
    const auto found = std::find_if(fields.begin(), fields.end(), [&](const auto &f) { return f.name == name; });
    if (found != fields.end())
        return *found;
    const auto nearest = std::min_element(fields.begin(), fields.end(), [&](const auto &a, const auto &b) {
        return editDistance(a.name, name) < editDistance(b.name, name);
    });
    throw Error(std::string(name), "unknown setting; did you mean " + nearest->name
                                       + "? (faintline-cli describe lists "
                                         "all)");
}

FieldValue defaultValue(const Field<AnalysisSettings> &field)
{
    AnalysisSettings settings;
    const std::string_view stage = std::string_view(field.name).substr(0, field.name.find('.'));
    if (const auto found = std::find(detectorNames.begin(), detectorNames.end(), stage); found != detectorNames.end())
        settings.detector = detectorOfKind(std::size_t(found - detectorNames.begin()));
    return field.get(settings).value();
}

void setSetting(AnalysisSettings &settings, std::string_view name, std::string_view text)
{
    const auto &f = settingField(name);
    f.set(settings, parseFieldValue(f, text));
    if (!f.get(settings))
        throw Error(std::string(name), "belongs to a different detector; select that detector first with detector.kind")
            .ofField(f.name);
}

void checkSettings(const AnalysisSettings &settings)
{
    for (const auto &f : AnalysisSettings::fields())
        if (const auto value = f.get(settings))
            checkFieldValue(f, *value);
    for (const SettingRule &rule : settingRules())
        rule.check(settings);
}

void checkHasNoFamily(const AnalysisSettings &settings, std::string why)
{
    if (!settings.family.isNone())
        throw fieldError("family.relation",
                         std::string(FamilySettings::relationNames[std::size_t(settings.family.relation)]),
                         std::move(why));
}

void checkHasOneChannel(const AnalysisSettings &settings, std::string why)
{
    if (!settings.selection.channels.empty())
        throw fieldError("selection.channels", formatFieldValue(settings.selection.channels), std::move(why));
}

void checkSubtractsNothing(const AnalysisSettings &settings, std::string why)
{
    if (settings.subtract.lines)
        throw fieldError("subtract.lines", "true", std::move(why));
}

Stage firstStale(const AnalysisSettings &before, const AnalysisSettings &after)
{
    if (!(before.selection == after.selection && before.spectrogram == after.spectrogram))
        return Stage::Spectrogram;
    if (!(before.noise == after.noise && before.pings == after.pings && before.family == after.family))
        return Stage::Noise;
    return before == after ? Stage::Nothing : Stage::Detector;
}

std::string settingsToJson(const AnalysisSettings &settings, bool onlyChanged)
{
    const AnalysisSettings defaults;
    Json json = Json::object();
    for (const auto &f : AnalysisSettings::fields()) {
        const auto value = f.get(settings);
        // decide.by is always written; otherwise reading a threshold would select it.
        if (value && (!onlyChanged || f.name == "decide.by" || value != f.get(defaults)))
            json[f.name] = jsonFromFieldValue(*value);
    }
    return json.dump(2);
}

AnalysisSettings settingsFromJson(const std::string &text, const std::string &where)
{
    const Json json = parseJson(text, where);
    if (!json.is_object())
        throw Error(where, "must be a JSON object of settings, name: value");
    AnalysisSettings settings;
    // In the table's order, so that decide.by is applied last regardless of the file's order.
    for (const auto &[name, value] : json.items())
        settingField(name);
    for (const auto &f : AnalysisSettings::fields())
        if (json.contains(f.name))
            f.set(settings, fieldValueFromJson(json[f.name], f));
    checkSettings(settings);
    return settings;
}

MarkovModel makeModel(const ModelSettings &settings, const Grid &grid)
{
    if (settings.motion != Motion::Slopes)
        return sonarModel(grid, settings.motion == Motion::Manoeuvring ? turning(settings) : nonManoeuvring());
    if (settings.slopeUnit != SlopeUnit::BinsPerFrame)
        throw fieldError("model.slopeUnit", "hzPerSecond",
                         "needs a recording, or frames over frequency; for pings, give the slopes in binsPerFrame");
    std::vector<KinematicAxis> axes;
    for (const Axis &axis : grid.axes)
        axes.push_back({axis.name,
                        axis.count,
                        axis.cyclic,
                        slopeIndex(settings.lowestSlope, settings.slopesPerBin),
                        slopeCount(settings),
                        settings.slopeChange,
                        {},
                        settings.rounding,
                        false,
                        settings.slopesPerBin});
    return {StateSpace(std::move(axes)), Likelihood(settings.likelihood, settings.snr), 1.0};
}

std::string nameOfBankModel(std::size_t model)
{
    return model == 0 ? "nonManoeuvring" : "manoeuvring";
}

std::vector<MarkovModel> makeModels(const ModelSettings &settings, const Grid &grid)
{
    if (settings.motion != Motion::Bank)
        return {makeModel(settings, grid)};
    return {sonarModel(grid, nonManoeuvring()), sonarModel(grid, turning(settings))};
}

} // namespace faintline
