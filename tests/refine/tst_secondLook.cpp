#include "analyse/analyse.h"
#include "analyse/events.h"
#include "base/Random.h"
#include "scene/SimulatedRecording.h"
#include "support/test.h"

#include "support/lines.h"
#include "support/recordings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace faintline;

namespace {

constexpr double rateHz = 400.0;
constexpr double windowSeconds = 0.25;
constexpr double cellHz = 1.0 / windowSeconds;

LineSettings line(double hz, double snrDb, double from, double seconds, double drift = 0.0)
{
    return test::line(hz, drift, from, seconds, snrDb, windowSeconds);
}

std::shared_ptr<const Analysis> analysisOf(const std::vector<LineSettings> &lines, double seconds, int seed,
                                           bool bothWays = true)
{
    LineScene scene = test::scene(rateHz, seconds, seed);
    scene.lines = lines;
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = windowSeconds;
    settings.track.bothWays = bothWays;
    return analyse(std::make_shared<SimulatedRecording>(scene), settings);
}

/// A line that is switched off for one second of every four, from 30 s on.
std::vector<LineSettings> keyedLine()
{
    std::vector<LineSettings> keyed;
    for (int i = 0; i < 10; ++i)
        keyed.push_back(line(91.3, 10.0, 30.0 + 4.0 * i, 3.0));
    return keyed;
}

double secondsOf(const Analysis &analysis, Index frame)
{
    return analysis.time().value(double(frame));
}

} // namespace

/// Tracks seen from both ends, against lines of known place.
class tst_secondLook : public QObject
{
    Q_OBJECT

private slots:
    void placeAndBand_data();
    void placeAndBand();
    void beginsAndEndsWithTheLine_data();
    void beginsAndEndsWithTheLine();
    void keyedAndFadingLinesAreOneTrack();
    void pausesAreNotReported();
    void equalLinesAtTheEdgeStayOnTheAxis();
    void everyBurstHasItsOwnDetection();
    void pausesAmongDenseLinesAreNotBridged();
    void detectionStaysCausal();
    void aStrongLineIsOneTrack();
    void aLongTrackIsOne();
    void withoutItTheChainsTracksStay();
    void aLineInTwoPartsHasTheEvidenceOfEach();
    void anyThresholdWillDo_data();
    void anyThresholdWillDo();
    void notUnderTheLinearLikelihood();
    void aCloudIsNoLine();
};

void tst_secondLook::placeAndBand_data()
{
    QTest::addColumn<double>("snrDb");
    QTest::addColumn<double>("drift");
    QTest::addColumn<double>("largestError"); // of 90 %, cells
    QTest::newRow("3 dB, constant") << 3.0 << 0.0 << 0.4;
    QTest::newRow("3 dB, drifting") << 3.0 << 0.8 << 0.4;
    QTest::newRow("10 dB, constant") << 10.0 << 0.0 << 0.25;
    QTest::newRow("10 dB, drifting") << 10.0 << 0.8 << 0.25;
}

void tst_secondLook::placeAndBand()
{
    QFETCH(double, snrDb);
    QFETCH(double, drift);
    QFETCH(double, largestError);
    int frames = 0;
    int inBand = 0;
    std::vector<double> errors;
    for (int seed = 1; seed <= 3; ++seed) {
        const double hz = 60.3 + 7.77 * seed;
        const auto analysis = analysisOf({line(hz, snrDb, 0.0, 100.0, drift)}, 100.0, seed);
        for (const Track &track : analysis->tracks)
            for (std::size_t i = 0; i < track.points.size(); ++i) {
                const SmoothedPoint &point = track.smoothed[i];
                const double truth = hz + drift * secondsOf(*analysis, track.points[i].frame);
                const Axis &axis = analysis->grid().axes.front();
                if (std::abs(axis.value(point.position) - truth) > 3.0 * cellHz)
                    continue; // none of this line
                ++frames;
                inBand += truth >= axis.value(double(point.low)) && truth <= axis.value(double(point.high)) ? 1 : 0;
                errors.push_back(std::abs(axis.value(point.position) - truth) / cellHz);
            }
    }
    QVERIFY2(frames > 3 * 600, qPrintable(QString::number(frames)));
    std::sort(errors.begin(), errors.end());
    const double error = errors[errors.size() * 9 / 10];
    const double share = double(inBand) / frames;
    QVERIFY2(error < largestError, qPrintable(QString::number(error)));
    QVERIFY2(share > 0.8 && share <= 1.0, qPrintable(QString::number(share)));
}

void tst_secondLook::beginsAndEndsWithTheLine_data()
{
    QTest::addColumn<double>("snrDb");
    QTest::newRow("6 dB") << 6.0;
    QTest::newRow("10 dB") << 10.0;
}

void tst_secondLook::beginsAndEndsWithTheLine()
{
    QFETCH(double, snrDb);
    const double frame = 0.5 * windowSeconds;
    int near = 0;
    for (int seed = 1; seed <= 5; ++seed) {
        const auto analysis = analysisOf({line(91.3, snrDb, 30.0, 40.0)}, 100.0, seed);
        QCOMPARE(std::ssize(analysis->tracks), 1);
        const Track &track = analysis->tracks.front();
        near += std::abs(secondsOf(*analysis, track.onsetFrame) - 30.0) < 5.0 * frame ? 1 : 0;
        near += std::abs(secondsOf(*analysis, track.endFrame) - 70.0) < 5.0 * frame ? 1 : 0;
        QVERIFY(track.isPresent(1) && track.isPresent(track.points.size() - 2)); // and one frame beyond
        if (snrDb >= 10.0)
            for (std::size_t i = 0; i < track.points.size(); ++i)
                if (const double t = secondsOf(*analysis, track.points[i].frame); t > 31.0 && t < 69.0)
                    QVERIFY(track.smoothed[i].presence > 0.9f);
    }
    QVERIFY2(near >= 9, qPrintable(QString::number(near)));
}

// Pauses of eight frames after every 24, and a level that falls by 10 dB and rises again.
void tst_secondLook::keyedAndFadingLinesAreOneTrack()
{
    const std::vector<LineSettings> keyed = keyedLine();
    std::vector<LineSettings> fading;
    for (int i = 0; i < 40; ++i)
        fading.push_back(line(91.3, 9.0 + 5.0 * std::cos(2.0 * std::numbers::pi * i / 20.0), 30.0 + i, 1.0));
    for (const std::vector<LineSettings> &lines : {keyed, fading})
        for (int seed = 1; seed <= 3; ++seed) {
            const auto analysis = analysisOf(lines, 100.0, seed);
            QCOMPARE(std::ssize(analysis->tracks), 1);
            const Track &track = analysis->tracks.front();
            QVERIFY(std::abs(secondsOf(*analysis, track.onsetFrame) - 30.0) < 1.0);
            QVERIFY(std::abs(secondsOf(*analysis, track.endFrame) - lines.back().startSeconds
                             - lines.back().durationSeconds)
                    < 1.0);
        }
}

void tst_secondLook::pausesAreNotReported()
{
    constexpr double edge = windowSeconds; // where the signal fills a part of the window
    int reported = 0;                      // in pauses
    int missing = 0;                       // between pauses
    for (int seed = 1; seed <= 3; ++seed) {
        const auto analysis = analysisOf(keyedLine(), 100.0, seed);
        const Track &track = analysis->tracks.front();
        const std::vector<std::size_t> present = track.presentPoints();
        for (std::size_t i = 0; i < track.points.size(); ++i) {
            const bool isReported = std::find(present.begin(), present.end(), i) != present.end();
            const double phase = std::fmod(secondsOf(*analysis, track.points[i].frame) - 30.0, 4.0);
            reported += isReported && phase > 3.0 + edge && phase < 4.0 - edge ? 1 : 0;
            missing += !isReported && phase > edge && phase < 3.0 - edge ? 1 : 0;
        }
    }
    // Of 9 pauses of 3 such frames, and 10 stretches of 19. A pause has to be as significant as a detection; at 10 dB
    // most pauses of 8 frames are.
    QVERIFY2(reported <= 40, qPrintable(QString::number(reported)));
    QVERIFY2(missing <= 6, qPrintable(QString::number(missing)));
}

void tst_secondLook::equalLinesAtTheEdgeStayOnTheAxis()
{
    // Two lines 2 and 4 cells above 0 Hz, and pauses in which their paths are free to go anywhere.
    std::vector<LineSettings> lines;
    for (int i = 0; i < 5; ++i)
        for (const double cells : {2.0, 4.0})
            lines.push_back(line(cells * cellHz, 10.0, 10.0 + 16.0 * i, 15.0));
    const auto analysis = analysisOf(lines, 100.0, 1);
    QVERIFY(!analysis->tracks.empty());
    for (const Track &track : analysis->tracks)
        for (std::size_t i = 0; i < track.points.size(); ++i) {
            QVERIFY(track.points[i].cell >= 0 && track.points[i].cell < analysis->grid().size());
            QVERIFY(track.smoothed[i].position >= 0.0);
        }
}

void tst_secondLook::everyBurstHasItsOwnDetection()
{
    std::vector<LineSettings> bursts;
    for (int i = 0; i < 9; ++i)
        bursts.push_back(line(90.0, 15.0, 6.0 + 12.37 * i, 4.0));
    double squares = 0.0; // of the errors of frequency
    for (int seed = 1; seed <= 3; ++seed) {
        const auto analysis = analysisOf(bursts, 120.0, seed);
        const std::vector<Event> found = events(*analysis);
        QCOMPARE(found.size(), bursts.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            const double begin = bursts[i].startSeconds;
            const QString text = QString("seed %1, burst %2 at %3 s: detected at %4 s, %5 Hz")
                                     .arg(seed)
                                     .arg(i)
                                     .arg(begin)
                                     .arg(found[i].detectSeconds)
                                     .arg(found[i].position.back());
            QVERIFY2(found[i].detectSeconds > begin && found[i].detectSeconds < begin + 1.0, qPrintable(text));
            squares += std::pow(found[i].position.back() - 90.0, 2);
            // Nothing is there but at the ends, in frames half of whose window is empty.
            const Track &track = *trackOfId(analysis->tracks, found[i].id);
            for (std::size_t at = 0; at < track.points.size(); ++at)
                if (const double t = secondsOf(*analysis, track.points[at].frame);
                    t < begin - 0.5 * windowSeconds || t > begin + 4.0 + 0.5 * windowSeconds)
                    QVERIFY2(track.smoothed[at].presence < 0.1f, qPrintable(text));
        }
    }
    // The Cramer-Rao bound of one window's frequency at 15 dB is 0.28 Hz, of the mean of sixteen 0.07 Hz.
    const double rms = std::sqrt(squares / double(3 * bursts.size()));
    QVERIFY2(rms < 0.1, qPrintable(QString::number(rms)));
}

// Eight lines four cells apart, and in the middle between two of them one that is switched off for 30 s.
void tst_secondLook::pausesAmongDenseLinesAreNotBridged()
{
    std::vector<LineSettings> lines{line(64.0, 15.0, 20.0, 30.0), line(64.0, 15.0, 80.0, 30.0)};
    for (int i = 0; i < 8; ++i)
        lines.push_back(line(24.0 + 16.0 * i, 15.0, 0.0, 130.0));
    for (int seed = 1; seed <= 3; ++seed) {
        const auto analysis = analysisOf(lines, 130.0, seed);
        int inPause = 0;
        int present = 0;
        for (const Track &track : analysis->tracks)
            for (const std::size_t i : track.presentPoints()) {
                const double t = secondsOf(*analysis, track.points[i].frame);
                const double hz = analysis->grid().axes.front().value(track.smoothed[i].position);
                if (std::abs(hz - 64.0) > cellHz)
                    continue;
                inPause += t > 51.0 && t < 79.0 ? 1 : 0;
                present += (t > 21.0 && t < 49.0) || (t > 81.0 && t < 109.0) ? 1 : 0;
            }
        QCOMPARE(inPause, 0);
        QVERIFY2(present > 400, qPrintable(QString::number(present))); // of 448
    }
}

void tst_secondLook::detectionStaysCausal()
{
    const std::vector<LineSettings> lines{line(91.3, 3.0, 30.0, 40.0)};
    const auto seen = analysisOf(lines, 100.0, 2);
    const auto found = analysisOf(lines, 100.0, 2, false);
    QCOMPARE(seen->tracks.size(), found->tracks.size());
    for (std::size_t i = 0; i < seen->tracks.size(); ++i) {
        QCOMPARE(seen->tracks[i].detectFrame, found->tracks[i].detectFrame);
        QCOMPARE(seen->tracks[i].peakStatistic, found->tracks[i].peakStatistic);
    }
    QVERIFY(seen->statisticCounts == found->statisticCounts);
}

void tst_secondLook::aStrongLineIsOneTrack()
{
    for (int seed = 1; seed <= 3; ++seed) {
        const auto analysis = analysisOf({line(91.3, 40.0, 10.0, 80.0, 0.3)}, 100.0, seed);
        QCOMPARE(std::ssize(analysis->tracks), 1);
    }
}

// Followed in pieces, which meet without a gap or a frame twice.
void tst_secondLook::aLongTrackIsOne()
{
    const double seconds = 2600.0; // 20 800 frames
    const auto analysis = analysisOf({line(91.3, 8.0, 0.0, seconds)}, seconds, 1);
    const auto longest =
        std::max_element(analysis->tracks.begin(), analysis->tracks.end(),
                         [](const Track &a, const Track &b) { return a.points.size() < b.points.size(); });
    QVERIFY(longest != analysis->tracks.end());
    QVERIFY2(std::ssize(longest->points) > 20700, qPrintable(QString::number(longest->points.size())));
    for (std::size_t i = 0; i < longest->points.size(); ++i)
        QCOMPARE(longest->points[i].frame, longest->onsetFrame + Index(i));
    QCOMPARE(longest->points.back().frame, longest->endFrame);
}

void tst_secondLook::withoutItTheChainsTracksStay()
{
    const auto analysis = analysisOf({line(91.3, 6.0, 30.0, 40.0)}, 100.0, 1, false);
    QVERIFY(!analysis->tracks.empty());
    for (const Track &track : analysis->tracks)
        QVERIFY(track.smoothed.empty());
}

void tst_secondLook::aLineInTwoPartsHasTheEvidenceOfEach()
{
    // A gap of 30 frames, in which the chain follows the line on.
    const auto analysis = analysisOf({line(91.3, 10.0, 10.0, 40.0), line(91.3, 10.0, 53.75, 40.0)}, 100.0, 1);
    QCOMPARE(std::ssize(analysis->tracks), 2);
    const Track &first = analysis->tracks.front();
    const Track &second = analysis->tracks.back();
    QVERIFY(secondsOf(*analysis, first.endFrame) < 52.0);
    QVERIFY(secondsOf(*analysis, second.onsetFrame) > 52.0);
    for (const Track *track : {&first, &second})
        QVERIFY(track->onsetFrame <= track->detectFrame && track->detectFrame <= track->endFrame);
    for (const Event &event : events(*analysis)) {
        QVERIFY(event.statistic >= analysis->threshold);
        QVERIFY(event.noiseProbability >= 0.0 && event.noiseProbability < 1e-6);
    }
}

void tst_secondLook::anyThresholdWillDo_data()
{
    QTest::addColumn<double>("nats");
    for (const double nats : {-5.0, 0.0, 1e-3, 40.0})
        QTest::addRow("%g nat", nats) << nats;
}

// Chances of beginning and ending are probabilities, however low the threshold.
void tst_secondLook::anyThresholdWillDo()
{
    QFETCH(double, nats);
    LineScene scene = test::scene(rateHz, 20.0, 1);
    scene.lines = {line(91.3, 10.0, 5.0, 10.0)};
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = windowSeconds;
    settings.decide.by = DecideSettings::By::Nats;
    settings.decide.thresholdNats = nats;
    const auto analysis = analyse(std::make_shared<SimulatedRecording>(scene), settings);
    QVERIFY(!analysis->tracks.empty());
    for (const Track &track : analysis->tracks) {
        QCOMPARE(track.smoothed.size(), track.points.size());
        for (const SmoothedPoint &point : track.smoothed) {
            QVERIFY(point.presence >= 0.0f && point.presence <= 1.0f);
            QVERIFY(point.low <= point.high);
        }
    }
}

void tst_secondLook::notUnderTheLinearLikelihood()
{
    LineScene scene = test::scene(rateHz, 60.0, 1);
    scene.lines = {line(91.3, 10.0, 5.0, 50.0)};
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = windowSeconds;
    settings.model.likelihood = LikelihoodKind::Linear;
    const auto analysis = analyse(std::make_shared<SimulatedRecording>(scene), settings);
    QVERIFY(!analysis->tracks.empty());
    for (const Track &track : analysis->tracks)
        QVERIFY(track.smoothed.empty());
}

void tst_secondLook::aCloudIsNoLine()
{
    // Ten seconds of noise in 40 Hz, ten cells, ten times the power of what is there all the time; and a line that goes
    // through it, plainly above.
    const auto found = [](bool withLine, bool bothWays) {
        Random random(5, 0);
        std::vector<float> samples(std::size_t(120.0 * rateHz));
        random.normals(samples, 1.0f);
        std::vector<float> cloud(samples.size());
        for (int tone = 0; tone < 400; ++tone) { // as many as are a narrow band of noise
            const double hz = 80.0 + 40.0 * random.uniform();
            const double phase = 2.0 * std::numbers::pi * random.uniform();
            for (std::size_t n = 0; n < cloud.size(); ++n)
                cloud[n] += float(std::cos(2.0 * std::numbers::pi * hz * double(n) / rateHz + phase));
        }
        const double amplitude = std::sqrt(10.0 * 2.0 * 40.0 / (0.5 * rateHz) / 400.0);
        for (std::size_t n = 0; n < samples.size(); ++n) {
            const double t = double(n) / rateHz;
            if (t >= 50.0 && t < 60.0)
                samples[n] += float(amplitude) * cloud[n];
            if (withLine)
                samples[n] += float(2.5 * std::cos(2.0 * std::numbers::pi * 100.0 * t));
        }
        AnalysisSettings settings;
        settings.spectrogram.windowSeconds = windowSeconds;
        settings.track.bothWays = bothWays;
        return analyse(std::make_shared<test::MemoryRecording>(std::move(samples), rateHz, false), settings);
    };
    constexpr bool twice = true;
    constexpr bool once = false;
    const auto paths = int(found(false, once)->tracks.size());
    const auto seen = found(false, twice);
    const auto lines = int(seen->tracks.size());
    QVERIFY2(paths >= 4, qPrintable(QString::number(paths)));
    QVERIFY2(3 * lines <= paths, qPrintable(QString("%1 of %2").arg(lines).arg(paths)));
    const std::vector<AreaEvent> areas = areaEvents(*seen);
    QVERIFY(!areas.empty());
    const AreaEvent largest = *std::max_element(areas.begin(), areas.end(), [](const AreaEvent &a, const AreaEvent &b) {
        return a.endSeconds - a.onsetSeconds < b.endSeconds - b.onsetSeconds;
    });
    QVERIFY(largest.onsetSeconds < 55.0 && largest.endSeconds > 55.0);
    QVERIFY(largest.low < 100.0 && largest.high > 100.0);
    QVERIFY2(largest.levelDb > 3.0 && largest.levelDb < 11.0, qPrintable(QString::number(largest.levelDb)));
    const std::vector<Track> tracks = found(true, twice)->tracks;
    const auto longest = std::max_element(
        tracks.begin(), tracks.end(), [](const Track &a, const Track &b) { return a.points.size() < b.points.size(); });
    QVERIFY(longest != tracks.end() && longest->points.size() > 900);
}

FAINTLINE_TEST(tst_secondLook)
#include "tst_secondLook.moc"
