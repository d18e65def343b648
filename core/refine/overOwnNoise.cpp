#include "refine/overOwnNoise.h"

#include "frames/Spectrogram.h"
#include "refine/ownNoiseLaw.h"
#include "refine/pathStrips.h"
#include "refine/secondLook.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace faintline {

namespace {

    /// ln Λ against noise of n exponential cells with this mean.
    double evidence(double count, double mean)
    {
        return mean > 1.0 ? count * (mean - 1.0 - std::log(mean)) : 0.0;
    }

    /// Factor by which overlap increases the variance of means over many frames.
    double overlapOf(const Spectrogram &spectrogram)
    {
        const SpectrogramSettings &settings = spectrogram.settings();
        const double scatter =
            overlapFactor(sampleWindow(settings.window, spectrogram.windowSamples()), settings.stepsPerWindow);
        return scatter * scatter;
    }

    /// Fraction of a track's evidence that remains under the noise's own law.
    double shareLeft(const PathStrip &strip, const OwnNoiseLaw &law)
    {
        double runs = 0.0;
        double count = 0.0;
        double power = 0.0;
        double own = 0.0;
        for (std::size_t i = 0; i < strip.centres.size(); ++i)
            if (const float y = strip.y[i]; !std::isnan(y)) {
                count += 1.0;
                power += double(y);
                own += double(law(strip.centres[i], y));
                runs += law.runs(strip.centres[i], std::ssize(strip.centres));
            }
        const double all = evidence(count, power / count);
        return all > 0.0 ? evidence(count, own / count) / all * count / runs : 1.0;
    }

} // namespace

void holdAgainstOwnNoise(Analysis &analysis, const RunContext &context)
{
    if (!looksTwice(analysis) || !analysis.settings.family.isNone())
        return;
    const Spectrogram &spectrogram = *analysis.frames->spectrogram();
    const OwnNoiseLaw law(*analysis.frames, analysis.tracks, spectrogram.binsPerCell(), overlapOf(spectrogram),
                          context.part(0.0, 0.5));
    if (law.isAsAssumed())
        return;
    std::vector<Track> tracks = std::exchange(analysis.tracks, {});
    std::vector<PathStrip> strips;
    for (const Track &track : tracks)
        strips.push_back(stripAlong(track, 0));
    readStrips(analysis, strips, context.part(0.5, 1.0), "testing tracks against the noise");
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        const bool isKept =
            tracks[i].isSubtracted || tracks[i].peakStatistic * shareLeft(strips[i], law) >= analysis.threshold;
        (isKept ? analysis.tracks : analysis.explainedByNoise).push_back(std::move(tracks[i]));
    }
}

} // namespace faintline
