#include "support/manySignals.h"

#include "analyse/analyse.h"
#include "base/Error.h"
#include "base/Random.h"
#include "support/recordings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace faintline::test {

namespace {

    constexpr double wholeSeconds = 100.0;
    constexpr double noiseDeviation = 0.1;
    constexpr double burstSeconds = 0.02;
    constexpr double burstDb = 10.0;
    constexpr Index longestSwap = 8; ///< frames that may be off
    constexpr double leastShare = 0.03;

    std::function<double(double)> straight(double hz, double hzPerSecond)
    {
        return [=](double t) { return hz + hzPerSecond * t; };
    }

    SignalScene slowScene(std::string name)
    {
        return {std::move(name), 8000.0, wholeSeconds, 0.25, {}};
    }

    SignalScene beside(double strongDb, double weakDb, double cells, double hz)
    {
        char name[48];
        std::snprintf(name, sizeof name, "%+.0f and %+.0f dB, %.1f cells", strongDb, weakDb, cells);
        SignalScene scene = slowScene(name);
        scene.known = {{0.0, wholeSeconds, strongDb, straight(hz, 0.0)},
                       {0.0, wholeSeconds, weakDb, straight(hz + cells * scene.cellHz(), 0.0)}};
        return scene;
    }

    /// They meet in the middle.
    SignalScene crossing(double firstDb, double secondDb, double firstSlope, double secondSlope, double hz)
    {
        char name[64];
        std::snprintf(name, sizeof name, "crossing %+.0f and %+.0f dB, %+.1f and %+.1f Hz/s", firstDb, secondDb,
                      firstSlope, secondSlope);
        SignalScene scene = slowScene(name);
        scene.known = {{0.0, wholeSeconds, firstDb, straight(hz - 0.5 * wholeSeconds * firstSlope, firstSlope)},
                       {0.0, wholeSeconds, secondDb, straight(hz - 0.5 * wholeSeconds * secondSlope, secondSlope)}};
        return scene;
    }

    /// They come as near as one cell, and part again, on parabolas.
    SignalScene kiss(double db, double hz)
    {
        char name[48];
        std::snprintf(name, sizeof name, "kiss to 1 cell, %+.0f dB", db);
        SignalScene scene = slowScene(name);
        for (const double side : {-1.0, 1.0})
            scene.known.push_back({0.0, wholeSeconds, db, [=](double t) {
                                       const double u = t - 0.5 * wholeSeconds;
                                       return hz + side * (2.0 + 0.01 * u * u);
                                   }});
        return scene;
    }

    SignalScene whistles(int seed)
    {
        SignalScene scene{"20 whistles", 48000.0, 6.0, 512.0 / 48000.0, {}, 12, true};
        Random random(std::uint64_t(seed), 77);
        for (int i = 0; i < 20; ++i) {
            const double length = 0.4 + 0.8 * random.uniform();
            const double from = (scene.seconds - length) * random.uniform();
            const double middle = 6000.0 + 9000.0 * random.uniform();
            const double slope = std::min(12000.0, 8000.0 / length) * (2.0 * random.uniform() - 1.0); // Hz/s
            const double wave = 0.3 + 0.5 * random.uniform();                                         // s
            const double swing = 13000.0 * random.uniform() * wave / (2.0 * std::numbers::pi);
            const double phase = 2.0 * std::numbers::pi * random.uniform();
            const double centre = from + 0.5 * length;
            scene.known.push_back({from, from + length, 8.0 + 17.0 * random.uniform(), [=](double t) {
                                       return middle + slope * (t - centre)
                                              + swing * std::sin(2.0 * std::numbers::pi * (t - centre) / wave + phase);
                                   }});
        }
        return scene;
    }

    double smallest(const SignalScene &scene, std::size_t of, double seconds)
    {
        double least = std::numeric_limits<double>::infinity();
        const double hz = scene.known[of].hz(seconds);
        for (std::size_t i = 0; i < scene.known.size(); ++i) {
            const KnownSignal &other = scene.known[i];
            if (i != of && seconds >= other.from && seconds <= other.to)
                least = std::min(least, std::abs(other.hz(seconds) - hz));
        }
        return least;
    }

    /// Distances of all tracks from all signals, frame by frame.
    class Scorer
    {
    public:
        Scorer(const SignalScene &scene, const Analysis &analysis)
            : m_scene(scene), m_analysis(analysis), m_axis(analysis.grid().axes.back()),
              m_margin(scene.isFast ? 2.0 * scene.windowSeconds : 0.0)
        {
        }

        SceneScore run()
        {
            const std::vector<Track> &tracks = m_analysis.tracks;
            const std::size_t count = m_scene.known.size();
            m_frames.assign(count, 0);
            m_errors.assign(count, {});
            std::vector<std::vector<int>> on(count, std::vector<int>(tracks.size(), 0));
            std::vector<std::vector<int>> nearest = on;
            std::vector<int> covered(count, 0);
            SceneScore score;
            for (std::size_t signal = 0; signal < count; ++signal)
                for (Index frame = 0; frame < m_analysis.time().count; ++frame) {
                    const double t = m_analysis.time().value(double(frame));
                    if (t < m_scene.known[signal].from || t > m_scene.known[signal].to)
                        continue;
                    ++m_frames[signal];
                    double best = std::numeric_limits<double>::infinity();
                    const bool isClear = smallest(m_scene, signal, t) >= m_scene.cellHz();
                    for (std::size_t i = 0; i < tracks.size(); ++i) {
                        const double distance = distanceTo(signal, tracks[i], frame);
                        best = std::min(best, distance);
                        if (distance > tolerance(signal, t))
                            continue;
                        ++on[signal][i];
                        nearest[signal][i] += isClear && nearestTo(tracks[i], frame) == int(signal) ? 1 : 0;
                    }
                    covered[signal] += best <= tolerance(signal, t) ? 1 : 0;
                    const double cellHz = m_scene.cellHz();
                    if (best < 2.0 * cellHz && smallest(m_scene, signal, t) >= 1.999 * cellHz)
                        m_errors[signal].push_back(best / cellHz);
                }
            for (std::size_t signal = 0; signal < count; ++signal) {
                const auto frames = double(std::max(1, m_frames[signal]));
                SignalScore one;
                one.coverage = covered[signal] / frames;
                for (std::size_t i = 0; i < tracks.size(); ++i) {
                    one.single = std::max(one.single, on[signal][i] / frames);
                    one.fragments += nearest[signal][i] >= leastShare * frames ? 1 : 0;
                }
                std::vector<double> &errors = m_errors[signal];
                std::sort(errors.begin(), errors.end());
                one.error = errors.empty() ? 0.0 : errors[errors.size() * 9 / 10];
                score.known.push_back(one);
            }
            judgeTracks(score);
            return score;
        }

    private:
        double secondsAt(Index frame) const { return m_analysis.time().value(double(frame)); }

        static const TrackPoint *pointAt(const Track &track, Index frame)
        {
            const Index at = frame - track.points.front().frame;
            return at < 0 || at >= std::ssize(track.points) ? nullptr : &track.points[std::size_t(at)];
        }

        double distanceTo(std::size_t signal, const Track &track, Index frame) const
        {
            if (!pointAt(track, frame))
                return std::numeric_limits<double>::infinity();
            const double hz = m_axis.value(track.lastPosition(std::size_t(frame - track.points.front().frame), m_axis));
            return std::abs(hz - m_scene.known[signal].hz(secondsAt(frame)));
        }

        double tolerance(std::size_t signal, double t) const
        {
            const double half = 0.25 * m_analysis.time().step;
            const auto &hz = m_scene.known[signal].hz;
            return m_scene.cellHz()
                   + 0.5 * std::abs(hz(t + half) - hz(t - half)) / (2.0 * half) * m_analysis.time().step;
        }

        /// The nearest signal, -1 if none is near.
        int nearestTo(const Track &track, Index frame) const
        {
            const double t = secondsAt(frame);
            int best = -1;
            double least = std::numeric_limits<double>::infinity();
            for (std::size_t signal = 0; signal < m_scene.known.size(); ++signal) {
                const KnownSignal &known = m_scene.known[signal];
                if (t < known.from - m_margin || t > known.to + m_margin)
                    continue;
                const double distance = distanceTo(signal, track, frame);
                if (distance <= tolerance(signal, t) && distance < least) {
                    least = distance;
                    best = int(signal);
                }
            }
            return best;
        }

        void judgeTracks(SceneScore &score) const
        {
            double all = 0.0;
            double good = 0.0;
            for (const Track &track : m_analysis.tracks) {
                int on = 0;
                int current = -1;
                int candidate = -1;
                Index since = 0;
                for (const TrackPoint &point : track.points) {
                    const int near = nearestTo(track, point.frame);
                    on += near >= 0 ? 1 : 0;
                    if (near < 0 || near == current) {
                        candidate = -1;
                        continue;
                    }
                    if (smallest(m_scene, std::size_t(near), secondsAt(point.frame)) < m_scene.cellHz())
                        continue; // nobody could tell
                    since = near == candidate ? since + 1 : 1;
                    candidate = near;
                    if (since < longestSwap)
                        continue;
                    score.swaps += current >= 0 ? 1 : 0;
                    current = near;
                    candidate = -1;
                }
                all += double(track.points.size());
                good += double(on);
                score.falseTracks += 2 * on < int(track.points.size()) ? 1 : 0;
            }
            score.precision = all > 0.0 ? good / all : 1.0;
        }

        const SignalScene &m_scene;
        const Analysis &m_analysis;
        const Axis &m_axis;
        double m_margin; ///< by which a window sees a signal before it begins, seconds
        std::vector<int> m_frames;
        std::vector<std::vector<double>> m_errors;
    };

} // namespace

std::vector<SignalScene> signalScenes(int seed)
{
    Random random(std::uint64_t(seed), 5);
    const double hz = 900.0 + 400.0 * random.uniform();
    std::vector<SignalScene> scenes;
    for (const double cells : {2.0, 3.0, 4.0, 6.0})
        scenes.push_back(beside(30.0, 6.0, cells, hz));
    scenes.push_back(beside(20.0, 8.0, 2.5, hz));
    scenes.push_back(beside(10.0, 10.0, 2.0, hz));
    scenes.push_back(beside(10.0, 10.0, 2.5, hz));
    scenes.push_back(beside(15.0, 12.0, 2.5, hz));
    scenes.push_back(crossing(6.0, 6.0, 0.0, 1.0, hz));
    scenes.push_back(crossing(12.0, 6.0, 0.0, 1.0, hz));
    scenes.push_back(crossing(12.0, 12.0, 0.0, 1.0, hz));
    scenes.push_back(crossing(9.0, 7.0, -0.6, 0.8, hz));
    scenes.push_back(crossing(6.0, 6.0, 0.0, 0.5, hz));
    scenes.push_back(kiss(10.0, hz));
    scenes.push_back(whistles(seed));
    return scenes;
}

SignalScene signalScene(std::string_view name, int seed)
{
    for (SignalScene &scene : signalScenes(seed))
        if (scene.name == name)
            return std::move(scene);
    throw Error(std::string(name), "there is no such scene");
}

RecordingPointer recordingOf(const SignalScene &scene, int seed)
{
    std::vector<float> samples(std::size_t(scene.rateHz * scene.seconds));
    Random(std::uint64_t(seed), 0).normals(samples, float(noiseDeviation));
    Random random(std::uint64_t(seed), 1);
    for (const KnownSignal &signal : scene.known) {
        const double length = scene.windowSeconds * scene.rateHz;
        const double amplitude = noiseDeviation * std::sqrt(4.0 * std::pow(10.0, 0.1 * signal.snrDb) / length);
        double phase = 2.0 * std::numbers::pi * random.uniform();
        const auto end = std::min(samples.size(), std::size_t(signal.to * scene.rateHz));
        for (auto n = std::size_t(signal.from * scene.rateHz); n < end; ++n) {
            samples[n] += float(amplitude * std::cos(phase));
            phase += 2.0 * std::numbers::pi * signal.hz(double(n) / scene.rateHz) / scene.rateHz;
        }
    }
    for (int burst = 0; burst < scene.bursts; ++burst) {
        std::vector<float> noise(std::size_t(burstSeconds * scene.rateHz));
        Random(std::uint64_t(seed), 100 + std::uint64_t(burst))
            .normals(noise, float(noiseDeviation * std::pow(10.0, 0.05 * burstDb)));
        const auto first = std::size_t(random.uniform() * double(samples.size() - noise.size()));
        for (std::size_t n = 0; n < noise.size(); ++n)
            samples[first + n] += noise[n];
    }
    return std::make_shared<MemoryRecording>(std::move(samples), scene.rateHz);
}

std::shared_ptr<const Analysis> analysisOf(const SignalScene &scene, int seed, AnalysisSettings settings)
{
    if (scene.isFast)
        settings.model = laws::glide();
    settings.spectrogram.windowSeconds = scene.windowSeconds;
    return analyse(recordingOf(scene, seed), settings, {.depth = AnalysisDepth::Tracks});
}

SignalScore SceneScore::worst() const
{
    SignalScore worst = known.front();
    for (const SignalScore &signal : known) {
        worst.coverage = std::min(worst.coverage, signal.coverage);
        worst.single = std::min(worst.single, signal.single);
        worst.fragments = std::max(worst.fragments, signal.fragments);
        worst.error = std::max(worst.error, signal.error);
    }
    return worst;
}

SignalScore SceneScore::mean() const
{
    SignalScore mean;
    double fragments = 0.0;
    for (const SignalScore &signal : known) {
        const auto count = double(known.size());
        mean.coverage += signal.coverage / count;
        mean.single += signal.single / count;
        mean.error += signal.error / count;
        fragments += signal.fragments / count;
    }
    mean.fragments = int(std::lround(fragments));
    return mean;
}

SceneScore scoreOf(const SignalScene &scene, const Analysis &analysis)
{
    return Scorer(scene, analysis).run();
}

} // namespace faintline::test
