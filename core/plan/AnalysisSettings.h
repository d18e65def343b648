#pragma once

#include "base/Field.h"
#include "frames/Family.h"
#include "frames/Spectrogram.h"
#include "model/MarkovModel.h"
#include "noise/NoiseNormaliser.h"
#include "noise/pings/PingNoise.h"
#include "plan/makeDetector.h"
#include "track/ConventionalTracker.h"
#include "track/HmmTracker.h"

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace faintline {

/// How signals move from frame to frame.
enum class Motion {
    Slopes,         ///< a set of slopes and the law of their change, the same on each axis
    NonManoeuvring, ///< sonar targets that keep their rates (sonarModels.h)
    Manoeuvring,    ///< sonar targets that turn
    Bank            ///< the last two in parallel (ModelBank)
};
inline constexpr std::array<std::string_view, 4> motionNames{"slopes", "nonManoeuvring", "manoeuvring", "bank"};

/// Unit in which slopes are given. Computations use bins per frame (plan/slopeUnit.h).
enum class SlopeUnit { BinsPerFrame, HzPerSecond };
inline constexpr std::array<std::string_view, 2> slopeUnitNames{"binsPerFrame", "hzPerSecond"};

/// Signal model: how the slope changes, and how a signal differs from noise.
struct ModelSettings {
    Motion motion = Motion::Slopes;
    SlopeUnit slopeUnit = SlopeUnit::BinsPerFrame;
    double lowestSlope = -1.0; ///< range of slopes; in bins per frame, multiples of 1/slopesPerBin
    double highestSlope = 1.0;
    int slopesPerBin = 8; ///< neighbouring slopes differ by 1/slopesPerBin bin per frame
    std::vector<double> slopeChange{0.9,
                                    0.05}; ///< h(0), h(1), …, of a change by one slope, two, …; h(0) + 2 Σ h(i) = 1
    /// h of manoeuvring targets, as in Parsons.
    std::vector<double> rangeRateChange = std::vector<double>(5, 1.0 / 9.0);
    std::vector<double> bearingRateChange{0.5, 0.25};
    Rounding rounding = Rounding::HalfDown;
    LikelihoodKind likelihood = LikelihoodKind::Rice;
    double snr = 0.5; ///< r0 or ρ, power ratio in one frame

    static const std::vector<Field<ModelSettings>> &fields();
    bool operator==(const ModelSettings &) const = default;
};

/// Criterion for an event.
struct DecideSettings {
    enum class By { FalseAlarmsPerHour, PfaPerCell, Nats };
    static constexpr std::array<std::string_view, 3> byNames{"falseAlarmsPerHour", "pfaPerCell", "thresholdNats"};

    double falseAlarmsPerHour = 1.0;
    double pfaPerCell = 1e-6;
    double thresholdNats = 20.0;
    By by = By::FalseAlarmsPerHour; ///< which of the three applies; setting one of them selects it
    std::vector<double> linkCells{3.0};
    std::vector<double> inhibitCells{2.5}; ///< per axis; the last number repeats
    std::vector<double> forgetCells;       ///< per axis; empty: as inhibitCells
    bool resets = true;                    ///< the detector forgets cells that a track has taken over
    bool inhibits = true;                  ///< the detector is inhibited around a track

    static const std::vector<Field<DecideSettings>> &fields();
    bool operator==(const DecideSettings &) const = default;
};

/// Laws of motion for presets. Coarse slopes that change freely suit lines that may turn at any moment. Fine slopes
/// with inertia suit all others: a path should neither follow noise at no cost, nor pay for a slope between two whole
/// bins.
namespace laws {
    /// Billon 2005: five slopes, one bin apart, h = (1/3, 1/3).
    ModelSettings billon();
    /// One slope: lines that stay within their bin.
    ModelSettings steady();
    /// Fast signals: slopes in steps of half a bin up to four bins per frame, h = (0.8, 0.1).
    ModelSettings glide();
} // namespace laws

/// Whether strong lines are subtracted, and weaker ones searched for in the remainder (refine/subtractLines.h).
struct SubtractSettings {
    bool lines = false;
    double leastDb = 20.0; ///< mean power over the noise along the track, per frame

    static const std::vector<Field<SubtractSettings>> &fields();
    bool operator==(const SubtractSettings &) const = default;
};

/// All settings that determine a result for a recording; saved, undone, compared and passed as one value.
struct AnalysisSettings {
    SelectionSettings selection;
    SpectrogramSettings spectrogram;
    NormaliserSettings noise;
    PingNoiseSettings pings; ///< of recorded pings, which have no spectrogram
    FamilySettings family;
    ModelSettings model;
    DetectorSettings detector;
    DecideSettings decide;
    TrackSettings track;
    SubtractSettings subtract;
    ConventionalSettings conventional; ///< for comparison with the detector, on frames of several axes

    /// The table of all settings, "stage.name", in the order of the chain.
    static const std::vector<Field<AnalysisSettings>> &fields();
    bool operator==(const AnalysisSettings &) const = default;
};

/// The table's row of that name. Throws Error that lists the nearest known names.
const Field<AnalysisSettings> &settingField(std::string_view name);

/// Default of a setting; for a setting of a detector, with that detector selected.
FieldValue defaultValue(const Field<AnalysisSettings> &field);

/// Parses, checks and sets one setting. Throws Error.
void setSetting(AnalysisSettings &settings, std::string_view name, std::string_view text);

/// A condition on several settings, beyond the ranges of the single ones.
struct SettingRule {
    std::string field;                                   ///< the setting that its error names and forms mark
    std::string sentence;                                ///< what must hold
    std::function<void(const AnalysisSettings &)> check; ///< throws Error if it does not
};

/// All rules, in the order in which they are checked.
const std::vector<SettingRule> &settingRules();

/// Checks the range of every setting, and the rules. Throws the first Error.
void checkSettings(const AnalysisSettings &settings);

/// Number of slopes of the set; slopes are in bins per frame.
int slopeCount(const ModelSettings &model);

/// Check for functions limited to single lines. If a family is set, throws Error naming family.relation and `why` it is
/// not supported.
void checkHasNoFamily(const AnalysisSettings &settings, std::string why);

/// Check for functions limited to one channel. If several are added, throws Error naming selection.channels and `why`
/// it is not supported.
void checkHasOneChannel(const AnalysisSettings &settings, std::string why);

/// Check for functions limited to the unchanged recording. If lines are subtracted, throws Error naming subtract.lines
/// and `why` it is not supported.
void checkSubtractsNothing(const AnalysisSettings &settings, std::string why);

/// The stages of the chain, in order; a change of one invalidates the following ones.
enum class Stage { Spectrogram, Noise, Detector, Nothing };

/// The earliest stage whose result differs between two settings.
Stage firstStale(const AnalysisSettings &before, const AnalysisSettings &after);

/// Writes all settings that differ from the defaults as JSON text, and reads it back (missing keys take their defaults,
/// unknown ones are errors). The round trip is exact.
std::string settingsToJson(const AnalysisSettings &settings, bool onlyChanged = true);
AnalysisSettings settingsFromJson(const std::string &json, const std::string &where);

/// Named initial settings for a kind of recording.
struct Preset {
    std::string name;
    std::string sentence;
    AnalysisSettings settings;
};
const std::vector<Preset> &presets();
const Preset &preset(std::string_view name);

/// The model for frames on a grid: the slope set and law on each axis, or that of a sonar's targets; for a bank, its
/// first model.
MarkovModel makeModel(const ModelSettings &settings, const Grid &grid);

/// Name of a bank's model, as in `sonarMotions()`.
std::string nameOfBankModel(std::size_t model);

/// All models of a bank, or the single model.
std::vector<MarkovModel> makeModels(const ModelSettings &settings, const Grid &grid);

} // namespace faintline
