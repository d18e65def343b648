#include "plan/chain.h"

#include "base/logmath.h"
#include "detect/GuidedDetector.h"
#include "detect/ModelBank.h"
#include "plan/constants.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    /// The values in whole cells; the last one is used for all remaining axes.
    std::vector<Index> perAxis(const std::vector<double> &values, const Grid &grid)
    {
        std::vector<Index> result;
        for (std::size_t axis = 0; axis < grid.axes.size(); ++axis)
            result.push_back(values.empty() ? 0 : Index(std::llround(values[std::min(axis, values.size() - 1)])));
        return result;
    }

    /// Bins over which a line of power y leaks more than half the noise into its neighbours, by the window's side
    /// lobes.
    std::function<Index(double)> leakageExtentOf(const FrameGeometry &geometry, Index cells)
    {
        std::vector<Index> bins;
        Index reach = 0;
        for (int db = 0; db <= leakageLimitDb; ++db) {
            while (ratioFromDb(db) * leakageBound(geometry.window, double(reach) / geometry.binsPerCell) > 0.5
                   && reach < cells)
                ++reach;
            bins.push_back(reach);
        }
        return [bins](double y) {
            return bins[std::size_t(std::clamp(std::ceil(dbFromRatio(std::max(y, 1.0))), 0.0, double(leakageLimitDb)))];
        };
    }

    /// The ends of a real recording's spectrum, where a line does not have its usual statistics. None for a selected
    /// band, nor for a family, which omits members there.
    std::vector<std::vector<Index>> excludedPlaces(const FrameGeometry &geometry, Index bins,
                                                   const FamilySettings &family, Index inhibitBins)
    {
        if (!geometry.hasRealEnds || !family.isNone() || bins < 8 * inhibitBins)
            return {};
        return {{0}, {bins - 1}};
    }

    FrameGeometry geometryOf(const AnalysisPlan &plan)
    {
        return plan.frames->geometry().isOfSpectra() ? frameGeometry(plan.settings.spectrogram) : FrameGeometry{};
    }

    /// Level at which an excursion ends. Path scores, in nats, are forgotten down to 8 nat below the threshold: paths
    /// so near have branched off the path that crossed it, and would also cross. For any other statistic: the level
    /// that noise exceeds in one cell of a thousand, in its own unit.
    double shoulderOf(const AnalysisPlan &plan)
    {
        const double threshold = plan.threshold;
        if (isScoreOfPaths(plan.settings.detector))
            return threshold - std::min(shoulderNats, 0.5 * std::abs(threshold));
        const auto decision = double(framesPerDecision(plan.settings.detector, geometryOf(plan)));
        return std::min(threshold, plan.calibration->levelExceededBy(shoulderNoiseProbability / decision));
    }

    ChainSettings chainSettings(const AnalysisPlan &plan)
    {
        const AnalysisSettings &settings = plan.settings;
        ChainSettings chain;
        chain.threshold = plan.threshold;
        chain.shoulder = shoulderOf(plan);
        if (!isScoreOfPaths(settings.detector))
            chain.trackThreshold = settings.track.endNats;
        chain.linkCells = perAxis(settings.decide.linkCells, plan.grid());
        chain.track = settings.track;
        const FrameGeometry geometry = plan.frames->geometry();
        const auto inBins = [&](std::vector<double> cells) {
            for (double &value : cells)
                value = std::ceil(value * geometry.binsPerCell);
            return perAxis(cells, plan.grid());
        };
        if (geometry.isOfSpectra()) {
            const Index bins = plan.grid().axes.back().count;
            chain.leakageExtent = leakageExtentOf(geometry, bins);
            chain.skirtStep = Index(std::ceil(geometry.binsPerCell));
            chain.excluded =
                excludedPlaces(geometry, bins, settings.family, inBins(settings.decide.inhibitCells).back());
        }
        chain.inhibitCells = inBins(settings.decide.inhibitCells);
        if (!settings.decide.forgetCells.empty())
            chain.forgetCells = inBins(settings.decide.forgetCells);
        if (plan.model.space.stateCount() > tracedBrieflyFromStates)
            chain.onsetFrames = onsetFramesOfMany;
        if (settings.noise.causal) {
            // A live run reports an event once nothing can be joined to it any more, so the onset of tracks must be
            // bounded.
            chain.onsetFrames = chain.onsetFrames > 0 ? chain.onsetFrames : liveRunUpFrames;
            chain.keepsNumbers = true;
        }
        chain.resets = settings.decide.resets;
        chain.inhibits = settings.decide.inhibits;
        return chain;
    }

    /// For the settings of the sequential Markov detector.
    std::unique_ptr<PathDetector> makeSmd(const AnalysisPlan &plan, const SmdSettings &smd)
    {
        if (!plan.isBank())
            return std::make_unique<Smd>(plan.model, resetRule(smd, plan.calibration->lnK));
        std::vector<ModelBank::Member> members;
        for (const BankMember &member : plan.bank)
            members.push_back({member.model, resetRule(smd, member.calibration->lnK), member.offset});
        return std::make_unique<ModelBank>(members);
    }

} // namespace

std::size_t bytesOfStates(const AnalysisPlan &plan)
{
    Index states = 0;
    for (std::size_t i = 0; i < plan.modelCount(); ++i)
        states += plan.modelAt(i).space.stateCount();
    return sizeof(float) * std::size_t(states);
}

std::unique_ptr<Detector> makeDetector(const AnalysisPlan &plan)
{
    if (const auto *smd = std::get_if<SmdSettings>(&plan.settings.detector))
        return makeSmd(plan, *smd);
    return makeDetector(plan.settings.detector, plan.model, plan.grid(), geometryOf(plan), {});
}

std::unique_ptr<PathDetector> makePathDetector(const AnalysisPlan &plan, bool showsStatistic)
{
    if (const auto *smd = std::get_if<SmdSettings>(&plan.settings.detector))
        return makeSmd(plan, *smd);
    return std::make_unique<GuidedDetector>(makeDetector(plan), plan.model,
                                            ResetRule{ResetLaw::Fixed, plan.calibration->lnK},
                                            showsStatistic ? makeDetector(plan) : nullptr);
}

std::unique_ptr<DetectionChain> makeChain(const AnalysisPlan &plan, std::unique_ptr<PathDetector> detector,
                                          bool looksBack)
{
    std::vector<MarkovModel> models;
    for (std::size_t i = 0; i < plan.modelCount(); ++i)
        models.push_back(plan.modelAt(i));
    ChainSettings settings = chainSettings(plan);
    if (!looksBack)
        settings.onsetFrames = 1;
    return std::make_unique<DetectionChain>(std::move(models), plan.grid(), std::move(detector), std::move(settings));
}

std::unique_ptr<DetectionChain> makeChain(const AnalysisPlan &plan)
{
    return makeChain(plan, makePathDetector(plan, true));
}

std::vector<CellBox> excludedBoxes(const AnalysisPlan &plan)
{
    const ChainSettings settings = chainSettings(plan);
    std::vector<CellBox> boxes;
    for (const std::vector<Index> &place : settings.excluded)
        boxes.push_back({place, settings.inhibitCells});
    return boxes;
}

} // namespace faintline
