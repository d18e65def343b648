#include "inspect/closeup.h"

#include "analyse/preparePlan.h"
#include "analyse/usable.h"
#include "base/Error.h"
#include "base/logmath.h"
#include "frames/Spectrogram.h"
#include "inspect/Replay.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace faintline {

namespace {

    constexpr const char *closingUp = "computing the close-up";
    constexpr Index blockValues = Index(1) << 18;

    PeakPyramid emptyPicture(const Analysis &analysis, const FrameStretch &stretch, ByteScale::Kind kind,
                             std::size_t byteBudget)
    {
        Axis time = analysis.time();
        time.first = time.value(double(stretch.begin));
        time.count = stretch.end - stretch.begin;
        return PeakPyramid(time, analysis.grid().size(), ByteScale(kind), byteBudget);
    }

    /// Calls `read`, and then `take` with each block of frames, in order.
    template <class Read, class Take>
    void readFrames(const Analysis &analysis, const FrameStretch &frames, const RunContext &context, const Read &read,
                    const Take &take)
    {
        const Index cells = analysis.grid().size();
        const Index most = std::max<Index>(1, blockValues / cells);
        std::vector<float> block;
        for (Index first = frames.begin; first < frames.end; first += most) {
            const double share = double(first - frames.begin) / double(frames.end - frames.begin);
            context.checkpoint(share, closingUp);
            const Index count = std::min(most, frames.end - first);
            block.resize(std::size_t(count * cells));
            read(first, count, block);
            take(block);
        }
    }

} // namespace

Index framesPerRowWithin(std::size_t byteBudget, Index frames, Index cells)
{
    Index merged = 1;
    while (4 * (frames / merged) * cells / 3 > Index(byteBudget))
        merged *= 4;
    return merged;
}

FrameStretch closeupStretch(const PeakPyramid &picture, const FrameStretch &visible, double framesPerPixel,
                            std::size_t byteBudget)
{
    const Index perRow = picture.framesPerRow(0);
    if (perRow == 1 || framesPerPixel >= double(perRow) || visible.isEmpty())
        return {};
    const auto widened = [&](Index by) {
        const Index begin = std::clamp<Index>(visible.begin - by, 0, picture.frameCount());
        return FrameStretch{begin - begin % perRow, std::clamp<Index>(visible.end + by, 0, picture.frameCount())};
    };
    const auto mergedIn = [&](const FrameStretch &one) {
        return framesPerRowWithin(byteBudget, one.end - one.begin, picture.cells());
    };
    constexpr Index atTheSides = 2; // pixels there may begin or end a frame farther out
    const FrameStretch least = widened(atTheSides);
    if (least.isEmpty() || mergedIn(least) >= perRow)
        return {};
    const FrameStretch more = widened(atTheSides + (visible.end - visible.begin) / 2);
    return mergedIn(more) == mergedIn(least) ? more : least;
}

std::shared_ptr<const PeakPyramid> inputCloseup(const Analysis &analysis, const FrameStretch &stretch,
                                                std::size_t byteBudget, const RunContext &context)
{
    auto picture = std::make_shared<PeakPyramid>(emptyPicture(analysis, stretch, ByteScale::Kind::PowerDb, byteBudget));
    readFrames(
        analysis, stretch, context,
        [&](Index first, Index count, std::span<float> block) { analysis.frames->read(first, count, block); },
        [&](std::span<const float> block) { picture->append(block); });
    picture->finish();
    return picture;
}

std::shared_ptr<const PeakPyramid> statisticCloseup(const Analysis &analysis, const FrameStretch &stretch,
                                                    std::size_t byteBudget, const RunContext &context)
{
    auto picture =
        std::make_shared<PeakPyramid>(emptyPicture(analysis, stretch, ByteScale::Kind::ScoreNats, byteBudget));
    Replay replay(analysis);
    replay.seek(stretch.begin);
    replay.stepTo(stretch.end, context, closingUp, [&](Index frame) {
        if (frame >= stretch.begin)
            picture->append(replay.statistic());
    });
    picture->finish();
    return picture;
}

std::optional<PlainPicture> plainPicture(const Analysis &analysis, std::size_t byteBudget, const RunContext &context)
{
    if (!analysis.background || !(analysis.grid().axes.back() == analysis.lines.front()->grid().axes.back()))
        return {};
    std::vector<float> noise;
    std::ranges::copy_if(analysis.background->lnPower, std::back_inserter(noise),
                         [](float ln) { return ln > NoiseBackground::silence; });
    if (noise.empty())
        return {};
    const auto low = noise.begin() + std::ssize(noise) / 20;
    std::ranges::nth_element(noise, low);
    const RecordingInfo &info = analysis.recording->info();
    const double perHz = // of the frames' unit
        (info.isComplex ? 1.0 : 2.0) * std::exp(analysis.background->lnUnit) / info.sampleRateHz;
    const double referenceDb = std::round(dbFromRatio(std::exp(double(*low)) * perHz));
    const auto gain = float(perHz / ratioFromDb(referenceDb));
    const FrameStretch all{0, analysis.time().count};
    auto picture = std::make_shared<PeakPyramid>(emptyPicture(analysis, all, ByteScale::Kind::PowerDb, byteBudget));
    readFrames(
        analysis, all, context,
        [&](Index first, Index count, std::span<float> block) {
            analysis.lines.front()->readPower(first, count, block);
            for (float &power : block)
                power *= gain;
        },
        [&](std::span<const float> block) { picture->append(block); });
    picture->finish();
    return PlainPicture{std::move(picture), referenceDb};
}

ChannelPicture channelPicture(const RecordingPointer &recording, const AnalysisSettings &settings, int channel,
                              std::size_t byteBudget, const RunContext &context)
{
    constexpr double noiseShare = 0.5; // of the work
    Analysis alone;
    alone.settings = settings;
    alone.settings.selection.channel = channel;
    alone.settings.selection.channels.clear();
    alone.settings.family = {};
    alone.recording = recording;
    const auto spectrogram =
        std::make_shared<Spectrogram>(recording, alone.settings.spectrogram, alone.settings.selection);
    normalisePlan(alone, spectrogram, context.part(0.0, noiseShare));
    if (alone.background)
        if (const std::string silence = silenceWords(*spectrogram, *alone.background, context); !silence.empty())
            throw Error(recording->info().path, silence);
    const FrameStretch all{0, alone.time().count};
    return {inputCloseup(alone, all, byteBudget, context.part(noiseShare, 1.0)), alone.grid().axes.back()};
}

} // namespace faintline
