#include "inspect/previewStatistic.h"

#include "base/memoryShares.h"
#include "plan/chain.h"

#include <algorithm>

namespace faintline {

namespace {

    constexpr Index leadInFrames = 128;  ///< before the displayed frames
    constexpr Index settlingPings = 16;  ///< the same of pings
    constexpr Index averagedFrames = 48; ///< the last settling frames, over which ln K is averaged
    constexpr double settlingGain = 0.3;
    constexpr Index mostPreviewCells = 70'000'000;
    constexpr Index blockFrames = 64;

    /// Blocks of frames, from memory if available.
    class Blocks
    {
    public:
        Blocks(const NormalisedFrames &source, const KeptFrames *kept) : m_source(source), m_kept(kept) {}

        std::span<const float> at(Index frame, Index count)
        {
            const Index cells = m_source.grid().size();
            const auto size = std::size_t(count * cells);
            if (m_kept)
                return std::span(m_kept->values).subspan(std::size_t((frame - m_kept->first) * cells), size);
            m_block.resize(size);
            m_source.read(frame, count, m_block);
            return m_block;
        }

    private:
        const NormalisedFrames &m_source;
        const KeptFrames *m_kept;
        std::vector<float> m_block;
    };

    /// ln K with which half of the states continue, from the first frames of the range.
    double settledLnK(const MarkovModel &model, double lnK, const FrameRange &range, Blocks &blocks,
                      const RunContext &context)
    {
        Smd smd(model, {ResetLaw::Half, lnK, 0.0, settlingGain});
        smd.useThreads(context.threads);
        std::vector<float> statistic(std::size_t(model.space.cellCount()));
        const Index frames = std::min(range.end - range.readFirst, leadInFrames);
        const Index averaged = std::min(averagedFrames, (frames + 1) / 2);
        double sum = 0.0;
        Index counted = 0;
        for (Index frame = 0; frame < frames; ++frame) {
            context.checkpoint(0.0, "previewing");
            smd.update(blocks.at(range.readFirst + frame, 1), statistic);
            if (frame < frames - averaged)
                continue;
            sum += smd.regulation().lnK;
            ++counted;
        }
        return counted > 0 ? sum / double(counted) : lnK;
    }

} // namespace

std::shared_ptr<const KeptFrames> keepFrames(NormalisedFramesPointer source, Index first, Index count,
                                             const RunContext &context)
{
    auto kept = std::make_shared<KeptFrames>();
    const Index cells = source->grid().size();
    kept->values.resize(std::size_t(count * cells));
    for (Index done = 0; done < count; done += blockFrames) {
        context.checkpoint(double(done) / double(count), "reading the visible part");
        const Index block = std::min(blockFrames, count - done);
        source->read(first + done, block,
                     std::span(kept->values).subspan(std::size_t(done * cells), std::size_t(block * cells)));
    }
    kept->source = std::move(source);
    kept->first = first;
    kept->count = count;
    return kept;
}

FrameRange previewRange(const NormalisedFrames &frames, Index first, Index last)
{
    const Index count = frames.time().count;
    if (count == 0)
        return {};
    FrameRange range;
    range.first = std::clamp<Index>(first, 0, count - 1);
    range.readFirst = std::max<Index>(0, range.first - (frames.grid().isSpectrum() ? leadInFrames : settlingPings));
    range.end = std::clamp<Index>(last, range.first, count - 1) + 1;
    const Index cells = (range.end - range.readFirst) * frames.grid().size();
    range.isKeepable = std::size_t(cells) * sizeof(float) <= memoryShares::previewFrames;
    return cells <= mostPreviewCells ? range : FrameRange{};
}

bool isWorthAPreview(const Analysis &before, const AnalysisSettings &settings)
{
    return (!before.grid().isSpectrum() || settings.model.motion == Motion::Slopes)
           && firstStale(before.settings, settings) == Stage::Detector
           && !(before.settings.model == settings.model && before.settings.detector == settings.detector);
}

StatisticPreview previewStatistic(const Analysis &before, const AnalysisSettings &settings, const FrameRange &range,
                                  const KeptFrames *kept, const RunContext &context)
{
    checkSettings(settings);
    AnalysisPlan trial;
    trial.settings = settings;
    trial.recording = before.recording;
    trial.frames = before.frames;
    const std::vector<MarkovModel> models = makeModels(settings.model, before.grid());
    trial.model = models.front();
    Blocks blocks(*before.frames, kept);
    auto calibration = std::make_shared<Calibration>(*before.calibration);
    if (const auto *smd = std::get_if<SmdSettings>(&settings.detector)) {
        if (smd->reset == SmdSettings::Reset::Fixed)
            calibration->lnK = smd->lnK;
        else if (smd->reset == SmdSettings::Reset::Calibrated)
            calibration->lnK = settledLnK(trial.model, before.calibration->lnK, range, blocks, context);
    }
    trial.calibration = calibration;
    for (std::size_t i = 0; i < models.size() && models.size() > 1; ++i) {
        const bool isKnown = i < before.bank.size();
        trial.bank.push_back({models[i], isKnown ? before.bank[i].calibration : trial.calibration,
                              isKnown ? before.bank[i].offset : 0.0});
    }

    const auto detector = makeDetector(trial);
    detector->useThreads(context.threads);
    const Index cells = before.grid().size();
    const Axis &time = before.time();
    const auto statistic = std::make_shared<PeakPyramid>(
        Axis{time.name, time.unit, time.value(double(range.first)), time.step, range.end - range.first, false}, cells,
        ByteScale(ByteScale::Kind::ScoreNats), memoryShares::closeup);
    std::vector<float> scores;
    for (Index frame = range.readFirst; frame < range.end;) {
        context.checkpoint(double(frame - range.readFirst) / double(range.end - range.readFirst), "previewing");
        const Index stop = frame < range.first ? range.first : range.end;
        const Index block = std::min(blockFrames, stop - frame);
        scores.resize(std::size_t(block * cells));
        detector->updateBlock(blocks.at(frame, block), scores, cells);
        if (frame >= range.first)
            statistic->append(scores);
        frame += block;
    }
    statistic->finish();
    return {statistic, calibration->lnK};
}

} // namespace faintline
