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

    /// ln K with which half of the states continue, from the first frames of the range.
    double settledLnK(const MarkovModel &model, double lnK, const FrameRange &range, const NormalisedFrames &source,
                      const RunContext &context)
    {
        Smd smd(model, {ResetLaw::Half, lnK, 0.0, settlingGain});
        smd.useThreads(context.threads);
        std::vector<float> statistic(std::size_t(model.space.cellCount()));
        std::vector<float> y(statistic.size());
        const Index frames = std::min(range.end - range.readFirst, leadInFrames);
        const Index averaged = std::min(averagedFrames, (frames + 1) / 2);
        double sum = 0.0;
        Index counted = 0;
        for (Index frame = 0; frame < frames; ++frame) {
            context.checkpoint(0.0, "previewing");
            source.read(range.readFirst + frame, 1, y);
            smd.update(y, statistic);
            if (frame < frames - averaged)
                continue;
            sum += smd.regulation().lnK;
            ++counted;
        }
        return counted > 0 ? sum / double(counted) : lnK;
    }

} // namespace

KeptFrames::KeptFrames(NormalisedFramesPointer source, Index first, Index count, const RunContext &context)
    : NormalisedFrames(source->time(), source->grid()), m_source(std::move(source)), m_first(first), m_count(count),
      m_values(std::size_t(count * m_grid.size()))
{
    const Index cells = m_grid.size();
    for (Index done = 0; done < count; done += blockFrames) {
        context.checkpoint(double(done) / double(count), "reading the visible part");
        const Index block = std::min(blockFrames, count - done);
        m_source->read(first + done, block,
                       std::span(m_values).subspan(std::size_t(done * cells), std::size_t(block * cells)));
    }
}

void KeptFrames::read(Index first, Index count, std::span<float> out) const
{
    std::copy_n(m_values.begin() + (first - m_first) * m_grid.size(), count * m_grid.size(), out.begin());
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
                                  const NormalisedFrames &frames, const RunContext &context)
{
    checkSettings(settings);
    AnalysisPlan trial;
    trial.settings = settings;
    trial.recording = before.recording;
    trial.frames = before.frames;
    const std::vector<MarkovModel> models = makeModels(settings.model, before.grid());
    trial.model = models.front();
    auto calibration = std::make_shared<Calibration>(*before.calibration);
    if (const auto *smd = std::get_if<SmdSettings>(&settings.detector)) {
        if (smd->reset == SmdSettings::Reset::Fixed)
            calibration->lnK = smd->lnK;
        else if (smd->reset == SmdSettings::Reset::Calibrated)
            calibration->lnK = settledLnK(trial.model, before.calibration->lnK, range, frames, context);
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
    std::vector<float> y, scores;
    for (Index frame = range.readFirst; frame < range.end;) {
        context.checkpoint(double(frame - range.readFirst) / double(range.end - range.readFirst), "previewing");
        const Index stop = frame < range.first ? range.first : range.end;
        const Index block = std::min(blockFrames, stop - frame);
        y.resize(std::size_t(block * cells));
        scores.resize(y.size());
        frames.read(frame, block, y);
        detector->updateBlock(y, scores, cells);
        if (frame >= range.first)
            statistic->append(scores);
        frame += block;
    }
    statistic->finish();
    return {statistic, calibration->lnK};
}

} // namespace faintline
