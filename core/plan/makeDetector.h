#pragma once

#include "base/Field.h"
#include "detect/BlockViterbi.h"
#include "detect/Detector.h"
#include "detect/Integrator.h"
#include "detect/PofN.h"
#include "detect/Smd.h"
#include "frames/NormalisedFrames.h"

#include <array>
#include <memory>
#include <string_view>
#include <variant>
#include <vector>

namespace faintline {

/// Settings of the sequential Markov detector.
struct SmdSettings {
    enum class Reset { Calibrated, Fixed, Half, Mean };
    static constexpr std::array<std::string_view, 4> resetNames{"calibrated", "fixed", "half", "mean"};

    Reset reset = Reset::Calibrated; ///< how K is determined
    double lnK = 0.0;                ///< for Fixed

    static const std::vector<Field<SmdSettings>> &fields();
    bool operator==(const SmdSettings &) const = default;
};

/// The energy detector: D = y, one frame.
struct EnergySettings {
    static const std::vector<Field<EnergySettings>> &fields();
    bool operator==(const EnergySettings &) const = default;
};

/// The Shiryaev-Roberts detector: SumDetector with a reset; all paths count.
struct ShiryaevRobertsSettings {
    /// 0: the classical procedure, whose statistic grows without bound on noise if the law loses no probability.
    double lnK = -0.1;

    static const std::vector<Field<ShiryaevRobertsSettings>> &fields();
    bool operator==(const ShiryaevRobertsSettings &) const = default;
};

/// Settings of any detector, in the order of `detectorNames`.
using DetectorSettings = std::variant<SmdSettings, PofNSettings, IntegratorSettings, EnergySettings,
                                      BlockViterbiSettings, ShiryaevRobertsSettings>;

inline constexpr std::array<std::string_view, std::variant_size_v<DetectorSettings>> detectorNames{
    "smd", "pOfN", "integrator", "energy", "blockViterbi", "shiryaevRoberts"};

/// Units of their statistics: nats for log-likelihoods, multiples of the noise for mean powers.
inline constexpr std::array<std::string_view, detectorNames.size()> detectorUnits{"nat",     "× noise", "× noise",
                                                                                  "× noise", "nat",     "nat"};

inline std::string_view statisticUnit(const DetectorSettings &settings)
{
    return detectorUnits[settings.index()];
}

/// Default settings of the alternative with that index.
DetectorSettings detectorOfKind(std::size_t index);

/// Whether the statistic is the score of a path, in nats, which a tracker continues. Tracks of other detectors start
/// from the paths of a sequential Markov detector beside them (GuidedDetector), whose scores are unrelated to the
/// statistic.
inline bool isScoreOfPaths(const DetectorSettings &settings)
{
    return std::holds_alternative<SmdSettings>(settings);
}

/// Frames between decisions: a block's length if a detector decides at the end of blocks, else 1.
Index framesPerDecision(const DetectorSettings &settings, const FrameGeometry &geometry);

/// Creates the detector that the settings describe. `rule`: calibrated reset of the sequential Markov detector.
std::unique_ptr<Detector> makeDetector(const DetectorSettings &settings, const MarkovModel &model, const Grid &grid,
                                       const FrameGeometry &geometry, const ResetRule &rule);

/// Number of decimals of a displayed statistic: a hundredth matters for noise power, not for a nat.
inline int statisticDecimals(const DetectorSettings &settings)
{
    return statisticUnit(settings) == "nat" ? 1 : 2;
}

} // namespace faintline
