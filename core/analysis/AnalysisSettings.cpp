#include "analysis/AnalysisSettings.h"

#include "base/Error.h"
#include "base/json.h"
#include "model/sonarModels.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace faintline {

namespace {

    /// Setting the value of one of the three thresholds also selects it.
    Field<DecideSettings> chosenBy(Field<DecideSettings> field, DecideSettings::By by)
    {
        field.set = [inner = field.set, by](DecideSettings &settings, const FieldValue &value) {
            inner(settings, value);
            settings.by = by;
        };
        return field;
    }

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

    std::size_t editDistance(std::string_view a, std::string_view b)
    {
        std::vector<std::size_t> row(b.size() + 1);
        for (std::size_t j = 0; j <= b.size(); ++j)
            row[j] = j;
        for (std::size_t i = 1; i <= a.size(); ++i) {
            std::size_t diagonal = row[0];
            row[0] = i;
            for (std::size_t j = 1; j <= b.size(); ++j) {
                const std::size_t above = row[j];
                row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
                diagonal = above;
            }
        }
        return row.back();
    }

    void checkLaw(const std::string &name, const std::vector<double> &law, int rateCount)
    {
        KinematicAxis axis;
        axis.cells = 1;
        axis.rateCount = rateCount;
        axis.rateChange = law;
        try {
            axis.check("model");
        } catch (const Error &error) {
            throw fieldError(name, formatFieldValue(law), error.why());
        }
    }

    int slopeIndex(double slope, int slopesPerBin)
    {
        return int(std::lround(slope * slopesPerBin));
    }

    int slopeCount(const ModelSettings &model)
    {
        return slopeIndex(model.highestSlope, model.slopesPerBin) - slopeIndex(model.lowestSlope, model.slopesPerBin)
               + 1;
    }

    /// Checks slopes in bins per frame; those in Hz/s can only be converted with a recording.
    void checkSlopes(const ModelSettings &model)
    {
        if (model.lowestSlope > model.highestSlope)
            throw fieldError("model.lowestSlope", formatNumber(model.lowestSlope),
                             "must not exceed model.highestSlope");
        if (model.slopeUnit != SlopeUnit::BinsPerFrame)
            return;
        const auto check = [&](const char *name, double slope) {
            constexpr double largest = 100.0;
            if (std::abs(slope) > largest)
                throw fieldError(
                    std::string("model.") + name, formatNumber(slope),
                    "must lie in -100 … 100 bins/frame; use a shorter window to reduce it for the same Hz/s");
            const double inSteps = slope * model.slopesPerBin;
            if (std::abs(inSteps - std::round(inSteps)) > 1e-6)
                throw fieldError(std::string("model.") + name, formatNumber(slope),
                                 "must be a multiple of 1/" + std::to_string(model.slopesPerBin)
                                     + " bin/frame (model.slopesPerBin)");
        };
        check("lowestSlope", model.lowestSlope);
        check("highestSlope", model.highestSlope);
        if (slopeCount(model) > 1001)
            throw fieldError("model.slopesPerBin", std::to_string(model.slopesPerBin),
                             "gives " + std::to_string(slopeCount(model)) + " slopes; at most 1001 are possible");
    }

    /// Lines can only be subtracted if their positions are known to a fraction of a cell.
    void checkSubtracts(const AnalysisSettings &settings)
    {
        if (!settings.track.bothWays || settings.noise.causal || !std::holds_alternative<SmdSettings>(settings.detector)
            || settings.model.likelihood == LikelihoodKind::Linear)
            checkSubtractsNothing(settings, "requires two-sided tracks: track.bothWays=true, "
                                            "noise.causal=false, detector.kind=smd, and not model.likelihood=linear");
        if (!settings.family.isNone())
            checkSubtractsNothing(settings, "is not possible with a family; use family.relation=none");
        if (!settings.selection.channels.empty())
            checkSubtractsNothing(settings, "is not possible with several channels; use selection.channels=");
    }

    SonarMotion turning(const ModelSettings &settings)
    {
        SonarMotion motion = manoeuvring();
        motion.rangeRateChange = settings.rangeRateChange;
        motion.bearingRateChange = settings.bearingRateChange;
        return motion;
    }

} // namespace

const std::vector<Field<ModelSettings>> &ModelSettings::fields()
{
    using S = ModelSettings;
    static const std::vector<Field<S>> table{
        field(&S::motion, "motion", motionNames,
              "Motion of signals: slopes as given here, or sonar targets that keep their rates, that turn, or both in "
              "parallel."),
        field(&S::slopeUnit, "slopeUnit", slopeUnitNames,
              "Unit of the lowest and highest slope; Hz/s are converted to bins per frame with the window in use and "
              "rounded outward to a multiple of 1/slopesPerBin."),
        field(&S::lowestSlope, "lowestSlope", "bins/frame", -1e9, 1e9,
              "Most negative slope a line may have, at least -100 bins/frame; in Hz/s if model.slopeUnit is "
              "hzPerSecond."),
        field(
            &S::highestSlope, "highestSlope", "bins/frame", -1e9, 1e9,
            "Most positive slope a line may have, at most 100 bins/frame; in Hz/s if model.slopeUnit is hzPerSecond."),
        field(&S::slopesPerBin, "slopesPerBin", "", 1.0, 64.0,
              "Number of slopes per bin/frame: 8 means steps of 1/8 bin/frame."),
        field(&S::slopeChange, "slopeChange", "", 0.0, 1.0,
              "Law h(0), h(1), … of the slope's change from frame to frame, in steps of the slope set; h(0) + 2·(h(1) "
              "+ …) = 1."),
        field(&S::rangeRateChange, "rangeRateChange", "", 0.0, 1.0,
              "Law h(0), h(1), … of a manoeuvring target's change of range rate from ping to ping; h(0) + 2·(h(1) + …) "
              "= 1."),
        field(&S::bearingRateChange, "bearingRateChange", "", 0.0, 1.0,
              "Law of the change of its bearing rate, in the "
              "same form."),
        field(&S::rounding, "rounding", roundingNames, "Rounding of a movement by half a bin."),
        field(&S::likelihood, "likelihood", likelihoodNames,
              "Signal law in a frame: constant amplitude (rice; also for Swerling 1 and 3), power that fluctuates from "
              "frame to frame (exponential: Swerling 2; swerling4), or the power itself (linear)."),
        field(&S::snr, "snr", "", 1e-6, 1e6,
              "Signal-to-noise ratio r0 for which the likelihood is designed, as a power ratio in one frame."),
    };
    return table;
}

const std::vector<Field<DecideSettings>> &DecideSettings::fields()
{
    using S = DecideSettings;
    static const std::vector<Field<S>> table{
        chosenBy(field(&S::falseAlarmsPerHour, "falseAlarmsPerHour", "1/h", 1e-9, 1e9,
                       "False alarms per hour of recording that the threshold permits on noise."),
                 S::By::FalseAlarmsPerHour),
        chosenBy(field(&S::pfaPerCell, "pfaPerCell", "", 1e-15, 0.5,
                       "Probability that a cell of noise exceeds the threshold in a frame."),
                 S::By::PfaPerCell),
        chosenBy(field(&S::thresholdNats, "thresholdNats", "nat", -100.0, 1e6, "Threshold on the statistic."),
                 S::By::Nats),
        field(&S::by, "by", S::byNames, "Quantity that sets the threshold."),
        field(&S::linkCells, "linkCells", "bins", 0.0, 1000.0,
              "Largest distance between threshold crossings of one event, per axis; the last number repeats."),
        field(
            &S::inhibitCells, "inhibitCells", "cells", 0.0, 1000.0,
            "Half width, in resolution cells, of the box inhibited around a track, per axis; the last number repeats."),
        field(&S::forgetCells, "forgetCells", "cells", 0.0, 1000.0,
              "Half width of the box in which the detector is reset around a new track, per axis; none: as "
              "inhibitCells."),
        field(&S::resets, "resets", "Whether the detector is reset in the box around a new track."),
        field(&S::inhibits, "inhibits", "Whether the detector is inhibited in the box around a track."),
    };
    return table;
}

const std::vector<Field<SubtractSettings>> &SubtractSettings::fields()
{
    using S = SubtractSettings;
    static const std::vector<Field<S>> table{
        field(&S::lines, "lines",
              "Whether strong lines are subtracted with their phase and the rest is searched again, for weak lines "
              "beside them."),
        field(&S::leastDb, "leastDb", "dB", 3.0, 200.0,
              "Mean power over the noise, in one frame, from which on a line is subtracted."),
    };
    return table;
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
    checkChannels(settings.selection);
    checkFamily(settings.family);
    if (settings.noise.causal) // tracks that a stronger family explains are only known at the end
        checkHasNoFamily(settings, "is not possible with noise.causal=true");
    checkSubtracts(settings);
    checkSlopes(settings.model);
    if (settings.conventional.hits > settings.conventional.window)
        throw fieldError("conventional.hits", std::to_string(settings.conventional.hits),
                         "must not exceed conventional.window");
    const bool isInBins = settings.model.slopeUnit == SlopeUnit::BinsPerFrame;
    checkLaw("model.slopeChange", settings.model.slopeChange,
             isInBins ? slopeCount(settings.model) : std::max(1, int(settings.model.slopeChange.size())));
    checkLaw("model.rangeRateChange", settings.model.rangeRateChange, 1);
    checkLaw("model.bearingRateChange", settings.model.bearingRateChange, 1);
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
                         "needs a recording; for frames and pings, give the slopes in binsPerFrame");
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
