// The conditions on several settings that checkSettings checks.

#include "base/Error.h"
#include "plan/AnalysisSettings.h"
#include "plan/constants.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

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

    bool isInBins(const ModelSettings &model)
    {
        return model.slopeUnit == SlopeUnit::BinsPerFrame;
    }

    void checkOrder(const ModelSettings &model)
    {
        if (model.lowestSlope > model.highestSlope)
            throw fieldError("model.lowestSlope", formatNumber(model.lowestSlope),
                             "must not exceed model.highestSlope");
    }

    /// Slopes in Hz/s can only be checked with a recording, when they have been converted.
    void checkSlope(const std::string &name, double slope, const ModelSettings &model)
    {
        if (!isInBins(model))
            return;
        if (std::abs(slope) > slopeLimitBinsPerFrame)
            throw fieldError(name, formatNumber(slope),
                             "must lie in -100 … 100 bins/frame; use a shorter window to reduce it for the same Hz/s");
        const double inSteps = slope * model.slopesPerBin;
        if (std::abs(inSteps - std::round(inSteps)) > 1e-6)
            throw fieldError(name, formatNumber(slope),
                             "must be a multiple of 1/" + std::to_string(model.slopesPerBin)
                                 + " bin/frame (model.slopesPerBin)");
    }

    void checkSlopeCount(const ModelSettings &model)
    {
        if (isInBins(model) && slopeCount(model) > slopeCountLimit)
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

    void checkHits(const ConventionalSettings &conventional)
    {
        if (conventional.hits > conventional.window)
            throw fieldError("conventional.hits", std::to_string(conventional.hits),
                             "must not exceed conventional.window");
    }

    int rateCount(const ModelSettings &model)
    {
        return isInBins(model) ? slopeCount(model) : std::max(1, int(model.slopeChange.size()));
    }

} // namespace

const std::vector<SettingRule> &settingRules()
{
    using S = const AnalysisSettings &;
    static const std::vector<SettingRule> rules{
        {"selection.channels", "Channels to be added are whole numbers, all different, and at most 64.",
         [](S s) { checkChannels(s.selection); }},
        {"family.members",
         "A family has 1 to 64 different members; multiples of a fundamental lie above 0 and are at "
         "most 64.",
         [](S s) { checkFamily(s.family); }},
        {"family.relation",
         "A background from the past alone (noise.causal) requires single lines: tracks that a "
         "stronger family explains are only known at the end.",
         [](S s) {
             if (s.noise.causal)
                 checkHasNoFamily(s, "is not possible with noise.causal=true");
         }},
        {"subtract.lines",
         "Subtracting lines requires two-sided tracks of single lines in one channel, which give "
         "their positions to a fraction of a cell.",
         &checkSubtracts},
        {"model.lowestSlope", "The lowest slope does not exceed the highest.", [](S s) { checkOrder(s.model); }},
        {"model.lowestSlope", "In bins/frame, a slope is a multiple of 1/slopesPerBin from -100 to 100.",
         [](S s) { checkSlope("model.lowestSlope", s.model.lowestSlope, s.model); }},
        {"model.highestSlope", "In bins/frame, a slope is a multiple of 1/slopesPerBin from -100 to 100.",
         [](S s) { checkSlope("model.highestSlope", s.model.highestSlope, s.model); }},
        {"model.slopesPerBin", "The slope set has at most 1001 slopes.", [](S s) { checkSlopeCount(s.model); }},
        {"conventional.hits", "The hits of a conventional track are at most the pings of its window.",
         [](S s) { checkHits(s.conventional); }},
        {"model.slopeChange",
         "A law h of changes has no more terms than there are slopes, none of them negative, and "
         "h(0) + 2·(h(1) + …) = 1.",
         [](S s) { checkLaw("model.slopeChange", s.model.slopeChange, rateCount(s.model)); }},
        {"model.rangeRateChange", "No term of a law h of changes is negative, and h(0) + 2·(h(1) + …) = 1.",
         [](S s) { checkLaw("model.rangeRateChange", s.model.rangeRateChange, 1); }},
        {"model.bearingRateChange", "No term of a law h of changes is negative, and h(0) + 2·(h(1) + …) = 1.",
         [](S s) { checkLaw("model.bearingRateChange", s.model.bearingRateChange, 1); }},
    };
    return rules;
}

} // namespace faintline
