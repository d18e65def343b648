#include "analysis/previewStatistic.h"

#include "analysis/chain.h"

#include <algorithm>
#include <limits>

namespace faintline {

namespace {

    constexpr Index settlingFrames = 128; ///< before what is shown
    constexpr Index averagedFrames = 48;  ///< of these, the last, whose ln K is taken
    constexpr double settlingGain = 0.3;
    constexpr std::size_t mostBytes = std::size_t(64) << 20;
    constexpr Index blockFrames = 64;

    /// ln K with which half of the states go on, from the first frames kept.
    double settledLnK(const MarkovModel &model, double lnK, const KeptFrames &kept, const RunContext &context)
    {
        Smd smd(model, {ResetLaw::Half, lnK, 0.0, settlingGain});
        smd.useThreads(context.threads);
        const auto cells = static_cast<std::size_t>(kept.source->grid().size());
        std::vector<float> statistic(cells);
        const Index frames = std::min(kept.count, settlingFrames);
        double sum = 0.0;
        Index counted = 0;
        for (Index frame = 0; frame < frames; ++frame) {
            smd.update(std::span(kept.values).subspan(static_cast<std::size_t>(frame) * cells, cells), statistic);
            if (frame < frames - averagedFrames)
                continue;
            sum += smd.regulation().lnK;
            ++counted;
        }
        return counted > 0 ? sum / static_cast<double>(counted) : lnK;
    }

} // namespace

std::shared_ptr<const KeptFrames> keepFrames(NormalisedFramesPointer source, Index first, Index count, const RunContext &context)
{
    auto kept = std::make_shared<KeptFrames>();
    const Index cells = source->grid().size();
    kept->values.resize(static_cast<std::size_t>(count * cells));
    for (Index done = 0; done < count; done += blockFrames) {
        context.checkpoint(static_cast<double>(done) / static_cast<double>(count), "reading what is visible");
        const Index block = std::min(blockFrames, count - done);
        source->read(first + done, block,
                     std::span(kept->values).subspan(static_cast<std::size_t>(done * cells), static_cast<std::size_t>(block * cells)));
    }
    kept->source = std::move(source);
    kept->first = first;
    kept->count = count;
    return kept;
}

FrameRange previewRange(const NormalisedFrames &frames, Index first, Index last)
{
    const Index count = frames.time().count;
    if (frames.grid().axes.size() != 1 || count == 0)
        return {};
    FrameRange range;
    range.first = std::clamp<Index>(first, 0, count - 1);
    range.readFirst = std::max<Index>(0, range.first - settlingFrames);
    range.end = std::clamp<Index>(last, range.first, count - 1) + 1;
    const auto bytes = static_cast<std::size_t>((range.end - range.readFirst) * frames.grid().size()) * sizeof(float);
    return bytes <= mostBytes ? range : FrameRange{};
}

bool isWorthAPreview(const Analysis &before, const AnalysisSettings &settings)
{
    return before.bank.empty() && settings.model.motion == Motion::Slopes && before.grid().axes.size() == 1
        && firstStale(before.settings, settings) == Stage::Detector
        && !(before.settings.model == settings.model && before.settings.detector == settings.detector);
}

StatisticPreview previewStatistic(const Analysis &before, const AnalysisSettings &settings, const KeptFrames &kept, const FrameRange &range,
                                  const RunContext &context)
{
    checkSettings(settings);
    Analysis trial;
    trial.settings = settings;
    trial.recording = before.recording;
    trial.frames = before.frames;
    trial.model = makeModel(settings.model, before.grid());
    auto calibration = std::make_shared<Calibration>(*before.calibration);
    if (const auto *smd = std::get_if<SmdSettings>(&settings.detector)) {
        if (smd->reset == SmdSettings::Reset::Fixed)
            calibration->lnK = smd->lnK;
        else if (smd->reset == SmdSettings::Reset::Calibrated)
            calibration->lnK = settledLnK(trial.model, before.calibration->lnK, kept, context);
    }
    trial.calibration = calibration;

    const auto detector = makeDetector(trial);
    detector->useThreads(context.threads);
    const Index cells = before.grid().size();
    const Axis &time = before.time();
    const auto statistic = std::make_shared<PeakPyramid>(
        Axis{time.name, time.unit, time.value(static_cast<double>(range.first)), time.step, range.end - range.first, false}, cells,
        ByteScale(ByteScale::Kind::ScoreNats), std::numeric_limits<std::size_t>::max());
    std::vector<float> scores;
    for (Index frame = range.readFirst; frame < range.end;) {
        context.checkpoint(static_cast<double>(frame - range.readFirst) / static_cast<double>(range.end - range.readFirst), "previewing");
        const Index stop = frame < range.first ? range.first : range.end;
        const Index block = std::min(blockFrames, stop - frame);
        scores.resize(static_cast<std::size_t>(block * cells));
        detector->updateBlock(
            std::span(kept.values).subspan(static_cast<std::size_t>((frame - kept.first) * cells), scores.size()), scores, cells);
        if (frame >= range.first)
            statistic->append(scores);
        frame += block;
    }
    statistic->finish();
    return {statistic, calibration->lnK};
}

} // namespace faintline
