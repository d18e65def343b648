#include "analyse/analyse.h"
#include "analyse/events.h"
#include "scene/SimulatedRecording.h"
#include "support/test.h"

#include "support/lines.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace faintline;

namespace {

constexpr double rateHz = 1000.0;
constexpr double windowSeconds = 0.25;
constexpr double cellHz = 1.0 / windowSeconds;
constexpr double binHz = 0.5 * cellHz;
constexpr double frameSeconds = 0.5 * windowSeconds;
constexpr double lineSeconds = 50.0; // 400 frames
constexpr double nearCells = 3.0;    // a track's point beyond is not on the line
constexpr double snrsDb[] = {0.0, 3.0, 6.0, 10.0, 20.0};

enum class Movement { Constant, Drifting, Wandering };
constexpr const char *movementNames[] = {"constant", "drifting", "wandering"};

/// A line of 50 s in 70 s of white noise, whose place, times and drift depend on the seed.
LineScene sceneOf(double snrDb, Movement motion, int seed)
{
    LineScene scene = test::scene(rateHz, lineSeconds + 20.0, seed);
    Random random(std::uint64_t(seed), 99);
    const double start = 5.0 + 10.0 * random.uniform();
    const double middleHz = 200.0 + 100.0 * random.uniform();
    const double drift =
        motion == Movement::Drifting ? 0.25 * binHz / frameSeconds * (2.0 * random.uniform() - 1.0) : 0.0;
    LineSettings line =
        test::line(middleHz - 0.5 * lineSeconds * drift, drift, start, lineSeconds, snrDb, windowSeconds);
    if (motion == Movement::Wandering) {
        line.wanderHz = binHz;
        line.wanderSeconds = 60.0 * frameSeconds;
    }
    scene.lines = {line};
    return scene;
}

AnalysisSettings settingsOf(const ModelSettings &model)
{
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = windowSeconds;
    settings.model = model;
    return settings;
}

std::shared_ptr<const Analysis> tracksOf(const LineScene &scene, const AnalysisSettings &settings)
{
    AnalysisRequest request;
    request.depth = AnalysisDepth::Tracks;
    return analyse(std::make_shared<SimulatedRecording>(scene), settings, request);
}

double quantile(std::vector<double> values, double share)
{
    if (values.empty())
        return NAN;
    std::sort(values.begin(), values.end());
    return values[std::size_t(share * double(values.size() - 1))];
}

/// What the tracks of lines of one kind say of them.
struct Measured {
    Index frames = 0;           ///< of the lines
    Index followed = 0;         ///< frames of tracks on a line, while it is there
    Index inBand = 0;           ///< of these, with the line inside the 5-95 % band
    std::vector<double> errors; ///< cells
    std::vector<double> onsets; ///< too late, frames; of lines that have a track at all
    std::vector<double> ends;

    void add(const SimulatedRecording &recording, const ModelSettings &model)
    {
        const auto analysis = tracksOf(recording.scene(), settingsOf(model));
        const TruthLine line = recording.truth().lines.front();
        const Axis &axis = analysis->grid().axes.front();
        Index first = analysis->time().count;
        Index last = -1;
        for (const Track &track : analysis->tracks)
            for (const std::size_t i : track.presentPoints()) {
                const double seconds = analysis->time().value(double(track.points[i].frame));
                const double hz = line.frequencyAt(seconds);
                const SmoothedPoint &point = track.smoothed[i];
                const double error = std::abs(axis.value(point.position) - hz) / cellHz;
                if (error > nearCells)
                    continue;
                first = std::min(first, track.points[i].frame);
                last = std::max(last, track.points[i].frame);
                if (seconds < line.startSeconds || seconds > line.endSeconds)
                    continue;
                ++followed;
                inBand += hz >= axis.value(double(point.low)) && hz <= axis.value(double(point.high)) ? 1 : 0;
                errors.push_back(error);
            }
        frames += Index((line.endSeconds - line.startSeconds) / frameSeconds);
        if (last < 0)
            return;
        onsets.push_back(double(first) - analysis->time().position(line.startSeconds));
        ends.push_back(double(last) - analysis->time().position(line.endSeconds));
    }

    double coverage() const { return double(inBand) / double(followed); }
    static double within15(const std::vector<double> &late)
    {
        return double(std::count_if(late.begin(), late.end(), [](double frames) { return std::abs(frames) <= 15.0; }))
               / double(late.size());
    }
};

ModelSettings ease8()
{
    return {};
}

/// How likely noise is said to make a track as significant, and how many of the tracks are on no line.
struct Group {
    double highest; ///< probability
    Index tracks = 0;
    Index falseTracks = 0;
    double stated = 0.0; ///< sum of the probabilities
    Index inNoise = 0;   ///< events of recordings without lines
};

std::vector<Group> groupsOf()
{
    return {{1e-6}, {1e-3}, {0.01}, {0.03}, {0.1}, {0.3}, {1.0}};
}

Group &groupAt(std::vector<Group> &groups, double probability)
{
    return *std::find_if(groups.begin(), groups.end(),
                         [&](const Group &g) { return probability < g.highest || g.highest == 1.0; });
}

/// Whether half of a track's points are within two cells of a line, while it is there.
bool isOnLine(const Track &track, const Analysis &analysis, const Truth &truth)
{
    const Axis &axis = analysis.grid().axes.front();
    std::size_t on = 0;
    for (std::size_t i = 0; i < track.points.size(); ++i) {
        const double seconds = analysis.time().value(double(track.points[i].frame));
        on += std::any_of(truth.lines.begin(), truth.lines.end(),
                          [&](const TruthLine &line) {
                              return seconds >= line.startSeconds && seconds <= line.endSeconds
                                     && std::abs(axis.value(track.smoothed[i].position) - line.frequencyAt(seconds))
                                            <= 2.0 * cellHz;
                          })
                  ? 1
                  : 0;
    }
    return 2 * on >= track.points.size();
}

constexpr double noiseSeconds = 60.0;
constexpr double falseAlarmsPerRecording = 1.0;

} // namespace

/// Reliability of what a track states about itself: its 5-95 % band, its onset and end, and the probability that it is
/// noise.
/// In the long lane it prints the tables of docs/performance.md.
class tst_coverage : public QObject
{
    Q_OBJECT

private slots:
    void bands_data();
    void bands();
    void probabilityOfNoise();
};

void tst_coverage::bands_data()
{
    QTest::addColumn<int>("motion");
    QTest::addColumn<bool>("isGlide");
    for (const bool isGlide : {false, true})
        for (int motion = 0; motion < 3; ++motion)
            QTest::addRow("%s, %s", isGlide ? "glide" : "ease8", movementNames[motion]) << motion << isGlide;
}

// With one run of a kind, 400 frames are as good as some 20 independent ones; the bounds hold for all SNRs together.
void tst_coverage::bands()
{
    QFETCH(int, motion);
    QFETCH(bool, isGlide);
    Measured all;
    for (const double snrDb : snrsDb) {
        Measured measured;
        const int runs = test::isLong() ? 50 : snrDb == 3.0 || snrDb == 10.0 ? 2 : 1;
        for (int run = 0; run < runs; ++run)
            measured.add(SimulatedRecording(sceneOf(snrDb, Movement(motion), 1 + run + 1000 * motion)),
                         isGlide ? laws::glide() : ease8());
        all.followed += measured.followed;
        all.inBand += measured.inBand;
        std::printf("| %s, %s | %2.0f dB | %lld | %.3f | %.3f | %.2f | %.2f | %.2f | %.2f |\n",
                    isGlide ? "glide" : "ease8", movementNames[motion], snrDb,
                    static_cast<long long>(measured.followed), double(measured.followed) / double(measured.frames),
                    measured.coverage(), quantile(measured.errors, 0.5), quantile(measured.errors, 0.9),
                    Measured::within15(measured.onsets), Measured::within15(measured.ends));
        std::fflush(stdout);
        if (isGlide)
            continue; // another law than that of these lines: errors are larger, and the bands wider
        if (snrDb == 3.0)
            QVERIFY2(quantile(measured.errors, 0.9) < 0.4, qPrintable(QString::number(quantile(measured.errors, 0.9))));
        if (snrDb == 10.0)
            QVERIFY2(quantile(measured.errors, 0.9) < 0.25,
                     qPrintable(QString::number(quantile(measured.errors, 0.9))));
    }
    QVERIFY2(all.coverage() > 0.83, qPrintable(QString::number(all.coverage())));
}

void tst_coverage::probabilityOfNoise()
{
    const int runs = test::isLong() ? 1200 : 30;
    std::vector<Group> groups = groupsOf();
    AnalysisSettings settings = settingsOf({});
    settings.decide.falseAlarmsPerHour = falseAlarmsPerRecording * 3600.0 / noiseSeconds;
    for (int seed = 1; seed <= runs; ++seed)
        for (const bool hasLine : {false, true}) {
            LineScene scene = test::scene(rateHz, noiseSeconds, 20000 + 2 * seed + (hasLine ? 1 : 0));
            Random random(std::uint64_t(seed), 98);
            if (hasLine)
                scene.lines = {test::line(60.0 + 380.0 * random.uniform(), 2.0 * random.uniform() - 1.0,
                                          5.0 + 20.0 * random.uniform(), 12.5 + 12.5 * random.uniform(),
                                          -5.0 + 10.0 * random.uniform(), windowSeconds)};
            const SimulatedRecording recording(scene);
            const auto analysis = tracksOf(scene, settings);
            for (const Event &event : events(*analysis)) {
                Group &group = groupAt(groups, event.noiseProbability);
                if (!hasLine) {
                    ++group.inNoise;
                    continue;
                }
                ++group.tracks;
                group.stated += event.noiseProbability;
                group.falseTracks +=
                    isOnLine(*trackOfId(analysis->tracks, event.id), *analysis, recording.truth()) ? 0 : 1;
            }
        }
    double lowest = 0.0;
    double expectedBelow = 0.0;
    Index foundBelow = 0;
    for (const Group &group : groups) {
        const double highest = std::min(group.highest, -std::expm1(-falseAlarmsPerRecording));
        const double expected = runs * (std::log1p(-lowest) - std::log1p(-highest));
        if (group.highest <= 0.3) {
            expectedBelow += expected;
            foundBelow += group.inNoise;
        }
        std::printf("| %g to %.2g | %.1f | %lld | %lld | %lld | %.3f | %.3f |\n", lowest, highest, expected,
                    static_cast<long long>(group.inNoise), static_cast<long long>(group.tracks),
                    static_cast<long long>(group.falseTracks),
                    double(group.falseTracks) / double(std::max<Index>(1, group.tracks)),
                    group.stated / double(std::max<Index>(1, group.tracks)));
        lowest = highest;
    }
    std::fflush(stdout);
    // Events of noise alone are a Poisson process with the stated rate, whose calibration is known to some 25 %.
    const double found = double(foundBelow);
    QVERIFY2(std::abs(found - expectedBelow) < 3.0 * std::sqrt(expectedBelow) + 0.25 * expectedBelow,
             qPrintable(QString("%1 events where %2 are expected").arg(found).arg(expectedBelow)));
    // Almost no noise is claimed to be impossible.
    QCOMPARE(groups[0].inNoise, Index(0));
    QVERIFY(groups[0].falseTracks <= groups[0].tracks / 100);
}

FAINTLINE_TEST(tst_coverage)
#include "tst_coverage.moc"
