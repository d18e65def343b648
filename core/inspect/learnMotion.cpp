#include "inspect/learnMotion.h"

#include "analyse/preparePlan.h"
#include "base/Error.h"
#include "refine/bothWays.h"
#include "refine/pathStrips.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace faintline {

namespace {

    constexpr std::string_view learning = "learning motion from tracks";
    constexpr double stayingFirstProbability = 0.9;
    constexpr double stayingLowerProbability = 0.8;
    constexpr double stayingUpperProbability = 0.998;
    constexpr int learningIterations = 3;
    constexpr std::size_t mostLearnedFrames = 20'000;

    std::vector<const Track *> tracksToLearnFrom(const Analysis &analysis)
    {
        std::vector<const Track *> tracks;
        for (const Track &track : analysis.tracks)
            if (track.hasSecondPass() && track.peakStatistic >= analysis.sureStatistic())
                tracks.push_back(&track);
        std::stable_sort(tracks.begin(), tracks.end(),
                         [](const Track *a, const Track *b) { return a->peakStatistic > b->peakStatistic; });
        std::size_t frames = 0;
        const auto end = std::find_if(tracks.begin(), tracks.end(), [&](const Track *track) {
            return (frames += track->points.size()) > mostLearnedFrames;
        });
        tracks.erase(tracks.empty() ? end : std::max(end, tracks.begin() + 1), tracks.end());
        return tracks;
    }

    std::vector<PathStrip> stripsOf(const Analysis &analysis, const std::vector<const Track *> &tracks,
                                    const RunContext &context)
    {
        std::vector<PathStrip> strips;
        for (const Track *track : tracks) {
            PathStrip strip;
            strip.firstFrame = track->points.front().frame;
            strip.halfWidth = bothWaysHalfWidth(analysis.frames->geometry().binsPerCell);
            for (std::size_t i = 0; i < std::min(mostLearnedFrames, track->points.size()); ++i)
                strip.centres.push_back(Index(std::lround(track->smoothed[i].position)));
            strips.push_back(std::move(strip));
        }
        readStrips(analysis, strips, context, learning);
        return strips;
    }

    /// h from the numbers of changes by 0, 1, … steps in either direction.
    std::vector<double> lawOf(std::vector<double> changes)
    {
        const double all = std::accumulate(changes.begin(), changes.end(), 0.0);
        const double staying = std::clamp(changes.front() / all, stayingLowerProbability, stayingUpperProbability);
        const double others = all - changes.front();
        std::vector<double> law{staying};
        for (std::size_t i = 1; i < changes.size(); ++i) {
            const double share = others > 0.0 ? changes[i] / others : 1.0 / double(changes.size() - 1);
            law.push_back(0.5 * (1.0 - staying) * share);
        }
        return law;
    }

    std::vector<double> changesUnder(const std::vector<double> &law, const Analysis &analysis,
                                     const std::vector<PathStrip> &strips, const RunContext &context)
    {
        ModelSettings settings = analysis.settings.model;
        settings.slopeChange = law;
        const MarkovModel markov = makeModel(settings, analysis.grid());
        BothWaysModel model = bothWaysModel(analysis);
        model.axis = &markov.space.axes().front();
        std::vector<double> changes(law.size());
        for (std::size_t i = 0; i < strips.size(); ++i) {
            context.checkpoint(double(i) / double(strips.size()), learning);
            model.lnK.assign(std::size_t(strips[i].frameCount()), analysis.calibration->lnK);
            const std::vector<double> found = slopeChangesOf(strips[i], model);
            std::transform(found.begin(), found.end(), changes.begin(), changes.begin(), std::plus<>());
        }
        return changes;
    }

} // namespace

bool canLearnMotion(const Analysis &analysis)
{
    return analysis.grid().isSpectrum() && analysis.settings.model.motion == Motion::Slopes
           && analysis.settings.model.slopeChange.size() > 1 && analysis.frames->geometry().isOfSpectra()
           && !tracksToLearnFrom(analysis).empty();
}

LearnedMotion learnMotion(const Analysis &analysis, const RunContext &context)
{
    if (!canLearnMotion(analysis))
        throw Error("motion",
                    "can be learned only from strong tracks of lines whose slope may change; no such track was found");
    const std::vector<const Track *> tracks = tracksToLearnFrom(analysis);
    const std::vector<PathStrip> strips = stripsOf(analysis, tracks, context.part(0.0, 0.2));
    LearnedMotion motion;
    motion.present = analysis.settings.model.slopeChange;
    motion.learned.assign(motion.present.size(),
                          0.5 * (1.0 - stayingFirstProbability) / double(motion.present.size() - 1));
    motion.learned.front() = stayingFirstProbability;
    std::vector<double> changes;
    for (int step = 0; step < learningIterations; ++step) {
        changes = changesUnder(motion.learned, analysis, strips, context.part(0.2 + 0.2 * step, 0.4 + 0.2 * step));
        motion.learned = lawOf(changes);
    }
    motion.tracks = tracks.size();
    motion.frames = std::accumulate(changes.begin(), changes.end(), 0.0);
    motion.presentLnK = analysis.calibration->lnK;
    AnalysisPlan learned = analysis;
    learned.settings = withLearnedMotion(analysis, motion);
    calibratePlan(learned, context.part(0.8, 1.0));
    motion.learnedLnK = learned.calibration->lnK;
    motion.presentThreshold = analysis.threshold;
    motion.learnedThreshold = learned.threshold;
    motion.gainPerFrame = motion.learnedLnK - motion.presentLnK;
    for (std::size_t i = 0; i < changes.size(); ++i)
        if (changes[i] > 0.0)
            motion.gainPerFrame += changes[i] / motion.frames * std::log(motion.learned[i] / motion.present[i]);
    return motion;
}

AnalysisSettings withLearnedMotion(const Analysis &analysis, const LearnedMotion &motion)
{
    AnalysisSettings settings = analysis.settings;
    settings.spectrogram.windowSeconds = analysis.frames->geometry().windowSeconds;
    settings.model.slopeChange = motion.learned;
    return settings;
}

} // namespace faintline
