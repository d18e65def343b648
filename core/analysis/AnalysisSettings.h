#pragma once

#include "base/Field.h"
#include "detect/makeDetector.h"
#include "model/MarkovModel.h"
#include "spectrum/Family.h"
#include "spectrum/NoiseNormaliser.h"
#include "spectrum/Spectrogram.h"
#include "track/ConventionalTracker.h"
#include "track/HmmTracker.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace faintline {

/// How signals move from frame to frame.
enum class Motion {
    Slopes,         ///< a slope set and the law of its change, alike on every axis
    NonManoeuvring, ///< sonar targets that keep their rates (sonarModels.h)
    Manoeuvring,    ///< sonar targets that turn
    Bank            ///< both of these in parallel (ModelBank)
};
inline constexpr std::array<std::string_view, 4> motionNames{"slopes", "nonManoeuvring", "manoeuvring", "bank"};

/// What slopes are given in. All that computes takes them in bins a frame (analysis/slopeUnit.h).
enum class SlopeUnit { BinsPerFrame, HzPerSecond };
inline constexpr std::array<std::string_view, 2> slopeUnitNames{"binsPerFrame", "hzPerSecond"};

/// What a signal is taken to do: how its slope changes, and how it differs from noise.
struct ModelSettings {
    Motion motion = Motion::Slopes;
    SlopeUnit slopeUnit = SlopeUnit::BinsPerFrame;
    double lowestSlope = -1.0; ///< slope set; in bins per frame whole multiples of 1/slopesPerBin
    double highestSlope = 1.0;
    int slopesPerBin = 8; ///< neighbouring slopes differ by 1/slopesPerBin bin per frame
    std::vector<double> slopeChange{0.9,
                                    0.05}; ///< h(0), h(1), …, of a change by one slope, two, …; h(0) + 2 Σ h(i) = 1
    /// h of manoeuvring targets, as Parsons has it.
    std::vector<double> rangeRateChange = std::vector<double>(5, 1.0 / 9.0);
    std::vector<double> bearingRateChange{0.5, 0.25};
    Rounding rounding = Rounding::HalfDown;
    LikelihoodKind likelihood = LikelihoodKind::Rice;
    double snr = 0.5; ///< r0 or ρ, power ratio in one frame

    static const std::vector<Field<ModelSettings>> &fields();
    bool operator==(const ModelSettings &) const = default;
};

/// When a statistic becomes an event.
struct DecideSettings {
    enum class By { FalseAlarmsPerHour, PfaPerCell, Nats };
    static constexpr std::array<std::string_view, 3> byNames{"falseAlarmsPerHour", "pfaPerCell", "thresholdNats"};

    double falseAlarmsPerHour = 1.0;
    double pfaPerCell = 1e-6;
    double thresholdNats = 20.0;
    By by = By::FalseAlarmsPerHour; ///< which of the three counts; setting one of them makes it count
    std::vector<double> linkCells{3.0};
    std::vector<double> inhibitCells{2.5}; ///< per axis; the last number repeats
    std::vector<double> forgetCells;       ///< per axis; empty: as inhibitCells
    bool resets = true;                    ///< the detector forgets what a track has taken over
    bool inhibits = true;                  ///< the detector is inhibited around a track

    static const std::vector<Field<DecideSettings>> &fields();
    bool operator==(const DecideSettings &) const = default;
};

/// The laws of motion that presets are made of. Coarse slopes that change freely suit lines that turn at any moment;
/// fine slopes with inertia suit everything that does not: a path must not follow noise for nothing, nor pay for a
/// slope between two whole bins.
namespace laws {
    /// Billon 2005: five slopes a bin apart, h = (1/3, 1/3).
    ModelSettings billon();
    /// One slope: lines that stay within their bin.
    ModelSettings steady();
    /// Fast signals: slopes of half a bin up to four bins a frame, h = (0.8, 0.1).
    ModelSettings glide();
} // namespace laws

/// Whether strong lines are taken out, and what lies beside them is looked for in the rest (analysis/subtractLines.h).
struct SubtractSettings {
    bool lines = false;
    double leastDb = 20.0; ///< mean power over the noise along the track, in one frame

    static const std::vector<Field<SubtractSettings>> &fields();
    bool operator==(const SubtractSettings &) const = default;
};

/// Everything that determines a result besides the recording: one value, saved, undone, compared and passed as a whole.
struct AnalysisSettings {
    SelectionSettings selection;
    SpectrogramSettings spectrogram;
    NormaliserSettings noise;
    FamilySettings family;
    ModelSettings model;
    DetectorSettings detector;
    DecideSettings decide;
    TrackSettings track;
    SubtractSettings subtract;
    ConventionalSettings conventional; ///< beside the detector, on frames of several axes

    /// The table of all settings, "stage.name", in the order of the chain.
    static const std::vector<Field<AnalysisSettings>> &fields();
    bool operator==(const AnalysisSettings &) const = default;
};

/// The table's row of that name. Throws Error that names the nearest known ones.
const Field<AnalysisSettings> &settingField(std::string_view name);

/// Its default; of a detector's own settings, with that detector chosen.
FieldValue defaultValue(const Field<AnalysisSettings> &field);

/// Sets one setting from text, checked. Throws Error.
void setSetting(AnalysisSettings &settings, std::string_view name, std::string_view text);

/// Checks what no single field can: laws that must sum to 1, orders of limits. Throws Error.
void checkSettings(const AnalysisSettings &settings);

/// For what knows single lines only. Throws Error naming family.relation where a family is set, and `why` it is not
/// possible.
void checkHasNoFamily(const AnalysisSettings &settings, std::string why);

/// For what knows one channel only. Throws Error naming selection.channels where several are added, and `why` it is not
/// possible.
void checkHasOneChannel(const AnalysisSettings &settings, std::string why);

/// For what knows the recording as it is only. Throws Error naming subtract.lines where lines are subtracted, and `why`
/// it is not possible.
void checkSubtractsNothing(const AnalysisSettings &settings, std::string why);

/// The stages of the chain, in order; a change of one makes those after it stale.
enum class Stage { Spectrogram, Noise, Detector, Nothing };

/// The earliest stage whose result differs between two settings.
Stage firstStale(const AnalysisSettings &before, const AnalysisSettings &after);

/// JSON text of all settings that differ from the defaults, and back (missing keys take their defaults, unknown ones
/// are refused). Round trip is exact.
std::string settingsToJson(const AnalysisSettings &settings, bool onlyChanged = true);
AnalysisSettings settingsFromJson(const std::string &json, const std::string &where);

/// A named starting point for a kind of recording.
struct Preset {
    std::string name;
    std::string sentence;
    AnalysisSettings settings;
};
const std::vector<Preset> &presets();
const Preset &preset(std::string_view name);

/// The model for frames on a grid: the slope set and law on every axis, or that of a sonar's targets; a bank's first
/// one.
MarkovModel makeModel(const ModelSettings &settings, const Grid &grid);

/// All models of a bank, or the only one.
std::vector<MarkovModel> makeModels(const ModelSettings &settings, const Grid &grid);

} // namespace faintline
