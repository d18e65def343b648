#include "analysis/chain.h"

#include "base/logmath.h"
#include "detect/GuidedDetector.h"
#include "detect/ModelBank.h"
#include "spectrum/NoiseNormaliser.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr double shoulderNats = 8.0;
    constexpr double noiseOnShoulder = 1e-3; ///< of the cells of a frame that decides
    constexpr Index manyStates = 1'000'000; ///< of so many, tracing a path back over tens of frames takes seconds
    constexpr Index onsetFramesOfMany = 16;

    std::vector<Index> perAxis(const std::vector<double> &values, const Grid &grid)
    {
        std::vector<Index> result;
        for (std::size_t axis = 0; axis < grid.axes.size(); ++axis)
            result.push_back(values.empty() ? 0 : static_cast<Index>(std::llround(values[std::min(axis, values.size() - 1)])));
        return result;
    }

    /// Bins over which a line of power y leaks more than half the noise into its neighbours, by the window's side lobes.
    std::function<Index(double)> spillOf(const Spectrogram &spectrogram)
    {
        constexpr int largestDb = 140;
        std::vector<Index> bins;
        Index reach = 0;
        for (int db = 0; db <= largestDb; ++db) {
            while (ratioFromDb(db) * leakageBound(spectrogram.settings().window, static_cast<double>(reach) / spectrogram.binsPerCell()) > 0.5
                   && reach < spectrogram.frequency().count)
                ++reach;
            bins.push_back(reach);
        }
        return [bins](double y) {
            return bins[static_cast<std::size_t>(std::clamp(std::ceil(dbFromRatio(std::max(y, 1.0))), 0.0, static_cast<double>(largestDb)))];
        };
    }

    /// A real recording's spectrum overlaps with its mirror image at 0 Hz, where there is often a constant as well, and at half
    /// the rate: y has other statistics there (χ² of one degree of freedom) and a line none to itself. Not so in a band that was asked for.
    std::vector<std::vector<Index>> blindPlaces(const Spectrogram &spectrogram, Index inhibitBins)
    {
        const SelectionSettings &selection = spectrogram.selection();
        const Index bins = spectrogram.frequency().count;
        if (spectrogram.recording().info().isComplex || selection.lowHz < selection.highHz || bins < 8 * inhibitBins)
            return {};
        return {{0}, {bins - 1}};
    }

    FrameGeometry geometryOf(const Analysis &analysis)
    {
        const bool isSpectral = dynamic_cast<const NormalisedSpectrogram *>(analysis.frames.get()) != nullptr;
        return isSpectral ? frameGeometry(analysis.settings.spectrogram) : FrameGeometry{};
    }

    /// Where an excursion ends. The score of paths, in nats, is forgotten down to 8 nat below the threshold: what lies so near has branched
    /// off the path that crossed it, and would cross in its turn. Of any other statistic: at the level that noise exceeds in one cell of
    /// a thousand, in its own unit.
    double shoulderOf(const Analysis &analysis)
    {
        const double threshold = analysis.threshold;
        if (isScoreOfPaths(analysis.settings.detector))
            return threshold - std::min(shoulderNats, 0.5 * std::abs(threshold));
        const auto decision = static_cast<double>(framesPerDecision(analysis.settings.detector, geometryOf(analysis)));
        return std::min(threshold, analysis.calibration->levelExceededBy(noiseOnShoulder / decision));
    }

    ChainSettings chainSettings(const Analysis &analysis)
    {
        const AnalysisSettings &settings = analysis.settings;
        ChainSettings chain;
        chain.threshold = analysis.threshold;
        chain.shoulder = shoulderOf(analysis);
        if (!isScoreOfPaths(settings.detector))
            chain.trackThreshold = settings.track.endNats;
        chain.linkCells = perAxis(settings.decide.linkCells, analysis.grid());
        chain.track = settings.track;
        double binsPerCell = 1.0;
        const auto inBins = [&](std::vector<double> cells) {
            for (double &value : cells)
                value = std::ceil(value * binsPerCell);
            return perAxis(cells, analysis.grid());
        };
        if (const auto *spectral = dynamic_cast<const NormalisedSpectrogram *>(analysis.frames.get())) {
            binsPerCell = spectral->spectrogram().binsPerCell();
            chain.spill = spillOf(spectral->spectrogram());
            chain.skirtStep = static_cast<Index>(std::ceil(binsPerCell));
            chain.blind = blindPlaces(spectral->spectrogram(), inBins(settings.decide.inhibitCells).back());
        }
        chain.inhibitCells = inBins(settings.decide.inhibitCells);
        if (!settings.decide.forgetCells.empty())
            chain.forgetCells = inBins(settings.decide.forgetCells);
        if (analysis.model.space.stateCount() > manyStates)
            chain.onsetFrames = onsetFramesOfMany;
        chain.resets = settings.decide.resets;
        chain.inhibits = settings.decide.inhibits;
        return chain;
    }

} // namespace

Index stateCount(const Analysis &analysis)
{
    Index states = analysis.bank.empty() ? analysis.model.space.stateCount() : 0;
    for (const BankMember &member : analysis.bank)
        states += member.model.space.stateCount();
    return states;
}

std::size_t bytesOfStates(const Analysis &analysis)
{
    return sizeof(float) * static_cast<std::size_t>(stateCount(analysis));
}

std::unique_ptr<Detector> makeDetector(const Analysis &analysis)
{
    const AnalysisSettings &settings = analysis.settings;
    const auto *smd = std::get_if<SmdSettings>(&settings.detector);
    if (!analysis.bank.empty()) {
        std::vector<ModelBank::Member> members;
        for (const BankMember &member : analysis.bank)
            members.push_back({member.model, resetRule(*smd, member.calibration->lnK), member.offset});
        return std::make_unique<ModelBank>(members);
    }
    return makeDetector(settings.detector, analysis.model, analysis.grid(), geometryOf(analysis),
                        smd ? resetRule(*smd, analysis.calibration->lnK) : ResetRule{});
}

std::unique_ptr<DetectionChain> makeChain(const Analysis &analysis, std::unique_ptr<Detector> detector, bool looksBack)
{
    if (!detector->hasPaths())
        detector = std::make_unique<GuidedDetector>(std::move(detector), analysis.model, ResetRule{ResetLaw::Fixed, analysis.calibration->lnK});
    std::vector<MarkovModel> models;
    for (const BankMember &member : analysis.bank)
        models.push_back(member.model);
    if (models.empty())
        models.push_back(analysis.model);
    ChainSettings settings = chainSettings(analysis);
    if (!looksBack)
        settings.onsetFrames = 1;
    return std::make_unique<DetectionChain>(std::move(models), analysis.grid(), std::move(detector), std::move(settings));
}

std::unique_ptr<DetectionChain> makeChain(const Analysis &analysis)
{
    return makeChain(analysis, makeDetector(analysis));
}

std::unique_ptr<DetectionChain> makeScoringChain(const Analysis &analysis)
{
    constexpr bool looksBack = false;
    return makeChain(analysis, makeDetector(analysis), looksBack);
}

std::vector<CellBox> blindBoxes(const Analysis &analysis)
{
    const ChainSettings settings = chainSettings(analysis);
    std::vector<CellBox> boxes;
    for (const std::vector<Index> &place : settings.blind)
        boxes.push_back({place, settings.inhibitCells});
    return boxes;
}

const ChainCheckpoint *checkpointBefore(const Analysis &analysis, Index frame)
{
    const auto after = std::upper_bound(analysis.checkpoints.begin(), analysis.checkpoints.end(), frame,
                                        [](Index wanted, const ChainCheckpoint &checkpoint) { return wanted < checkpoint.frame; });
    return after == analysis.checkpoints.begin() ? nullptr : &*std::prev(after);
}

} // namespace faintline
