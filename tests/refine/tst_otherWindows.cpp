#include "refine/otherWindows.h"
#include "support/test.h"

#include "analyse/analyse.h"
#include "analyse/events.h"
#include "scene/SimulatedRecording.h"
#include "support/lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

using namespace faintline;
using namespace faintline::test;

namespace {

constexpr double steadyHz = 3000.3;

/// Sweeps that need a short window, and a steady line too faint for it.
LineScene sweepsBesideAFaintLine(double faintDb)
{
    LineScene result = sweeps();
    result.lines.push_back(line(steadyHz, 0.0, 0.0, result.durationSeconds, faintDb, 0.025));
    return result;
}

/// Steady lines for which a long window is chosen.
LineScene sixThatStandStill(int seed)
{
    LineScene result = scene(4000.0, 32.0, seed);
    for (int i = 0; i < 6; ++i)
        result.lines.push_back(line(100.0 + 100.0 * i, 0.0, 0.0, 32.0, 8.0, 0.2));
    return result;
}

/// Two of each, at 10 dB in 12.5 ms, of which the chosen window sees none.
LineScene slowAndFastGlides()
{
    LineScene result = scene(16000.0, 40.0, 4);
    for (int i = 0; i < 2; ++i)
        result.lines.push_back(line(4000.0, -1500.0, 4.0 + 9.0 * i, 1.5, 10.0, 0.0125));
    for (int i = 0; i < 2; ++i)
        result.lines.push_back(line(7000.0, -6000.0, 22.0 + 9.0 * i, 0.9, 10.0, 0.0125));
    return result;
}

std::shared_ptr<const Analysis> analysed(const LineScene &scene, const AnalysisSettings &settings = {},
                                         const Analysis *previous = nullptr)
{
    return analyse(std::make_shared<SimulatedRecording>(scene), settings, {.previous = previous});
}

struct Analyses {
    std::shared_ptr<const Analysis> chosen; ///< windows of 25 ms, which suit the sweeps
    std::shared_ptr<const Analysis> longer; ///< 100 ms
};

Analyses inBothWindows(const LineScene &scene)
{
    const auto recording = std::make_shared<SimulatedRecording>(scene);
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = 0.1;
    const auto longer = analyse(recording, settings);
    settings.spectrogram.windowSeconds = 0.025;
    settings.model.lowestSlope = laws::glide().lowestSlope;
    settings.model.highestSlope = laws::glide().highestSlope;
    settings.model.slopesPerBin = laws::glide().slopesPerBin;
    settings.model.slopeChange = laws::glide().slopeChange;
    return {analyse(recording, settings), longer};
}

/// The next longer window.
const Analysis &longerOf(const Analysis &analysis)
{
    return *analysis.others.at(analysis.choice->chosen);
}

std::vector<Event> ofAnotherWindow(const Analysis &analysis)
{
    std::vector<Event> result;
    for (const Event &event : events(analysis))
        if (trackOfId(analysis.tracks, event.id)->windowSeconds > 0.0)
            result.push_back(event);
    return result;
}

} // namespace

/// What other windows than the chosen one know better.
class tst_otherWindows : public QObject
{
    Q_OBJECT

private slots:
    void oneBesideSweepsIsFound();
    void numbersFollowTheOrderOfDetection();
    void whatTheChosenWindowHasIsNotTakenTwice();
    void onePutsPiecesTogether();
    void noiseBringsFew();
    void oneInAHumHasToBeSureOverIt();
    void aGlideBesideLinesThatStandStillIsFound();
    void oneThatWandersBesideLinesThatStandStillIsFound();
    void reportsTheMeanPositionWithinAFrame();
    void strongLinesThatStandStillStay();
    void shorterWindowsAreTriedForWhatIsTooFast();
    void faintLinesThatGlidesCrossStay();
    void partsBetweenWhichLittleIsLostAreOneTrack();
    void aStrongFastLineIsOneTrack();
    void aChangeOfTheThresholdAsksAgain();
};

void tst_otherWindows::oneBesideSweepsIsFound()
{
    const auto analysis = analysed(sweepsBesideAFaintLine(-4.0));
    for (const auto &other : analysis->others)
        QVERIFY(!other->input && !other->statistic);
    const std::vector<Event> found = ofAnotherWindow(*analysis);
    QCOMPARE(found.size(), std::size_t(1));
    const Event &event = found.front();
    const double longer = longerOf(*analysis).frames->spectrogram()->windowSeconds();
    QCOMPARE(event.windowSeconds, longer);
    QVERIFY(std::abs(longer / analysis->frames->spectrogram()->windowSeconds() - 4.0) < 0.05);
    QVERIFY2(std::abs(event.position.front() - steadyHz) < 0.2 / longer,
             qPrintable(QString::number(event.position.front(), 'g', 9)));
    QVERIFY(event.onsetSeconds < 1.0 && event.endSeconds > 9.0);
    // Its power in one window of those shown: -4 dB in 1/40 s.
    const double shown = -4.0 + 10.0 * std::log10(analysis->frames->spectrogram()->windowSeconds() / 0.025);
    QVERIFY2(std::abs(event.snrDb - shown) < 1.5, qPrintable(QString::number(event.snrDb)));
    const Track &track = *trackOfId(analysis->tracks, event.id);
    QCOMPARE(std::ssize(track.points), track.endFrame - track.onsetFrame + 1);
    QCOMPARE(track.points.size(), track.smoothed.size());
    for (const TrackPoint &point : track.points)
        QVERIFY(point.statistic <= track.peakStatistic);
}

void tst_otherWindows::numbersFollowTheOrderOfDetection()
{
    const auto analysis = analysed(sweepsBesideAFaintLine(-4.0));
    for (std::size_t i = 0; i < analysis->tracks.size(); ++i) {
        QCOMPARE(analysis->tracks[i].id, int(i) + 1);
        QVERIFY(i == 0 || analysis->tracks[i - 1].detectFrame <= analysis->tracks[i].detectFrame);
    }
}

/// Of a somewhat stronger line the shorter window finds several pieces.
void tst_otherWindows::onePutsPiecesTogether()
{
    const auto [chosen, longer] = inBothWindows(sweepsBesideAFaintLine(3.0));
    const auto near = [](const std::vector<Event> &all) {
        std::vector<Event> result;
        std::copy_if(all.begin(), all.end(), std::back_inserter(result),
                     [](const Event &event) { return std::abs(event.position.front() - steadyHz) < 40.0; });
        return result;
    };
    const std::vector<Event> pieces = near(events(*chosen));
    QVERIFY2(pieces.size() > 1, qPrintable(QString::number(pieces.size())));
    const std::vector<Event> whole = near(events(*chosen, withOtherWindows(*chosen, std::array{longer}).tracks));
    QCOMPARE(whole.size(), std::size_t(1));
    QVERIFY(whole.front().onsetSeconds < 0.5 && whole.front().endSeconds > 9.5);
    QVERIFY(whole.front().detectSeconds <= pieces.front().detectSeconds);
}

/// A stronger line is found by several windows, and stays one event.
void tst_otherWindows::whatTheChosenWindowHasIsNotTakenTwice()
{
    const auto analysis = analysed(sweepsBesideAFaintLine(9.0));
    const auto isTheLine = [](const Event &event) { return std::abs(event.position.front() - steadyHz) < 40.0; };
    QVERIFY(std::ranges::all_of(analysis->others,
                                [&](const auto &other) { return std::ranges::any_of(events(*other), isTheLine); }));
    QVERIFY(std::ranges::none_of(ofAnotherWindow(*analysis), isTheLine));
    QCOMPARE(std::ranges::count_if(events(*analysis), isTheLine), Index(1));
}

/// Half an hour in which every window brings nine hundred false alarms: each of the others adds a hundredth.
void tst_otherWindows::noiseBringsFew()
{
    AnalysisSettings settings;
    settings.decide.falseAlarmsPerHour = 3600.0;
    LineScene noise;
    noise.sampleRateHz = 400.0;
    noise.durationSeconds = 1800.0;
    noise.seed = 11;
    const auto analysis = analysed(noise, settings);
    QVERIFY2(longerOf(*analysis).tracks.size() > 800, qPrintable(QString::number(longerOf(*analysis).tracks.size())));
    const std::size_t added = ofAnotherWindow(*analysis).size();
    QVERIFY2(added <= 18 * analysis->others.size(), qPrintable(QString::number(added)));
}

/// A hum of eight cells of the longer window, in which nothing is found, brings a line above the sure statistic of the
/// noise around it.
void tst_otherWindows::oneInAHumHasToBeSureOverIt()
{
    LineScene scene = sweeps();
    const double lineHz = 3040.0;
    scene.lines.push_back(line(lineHz, 0.0, 0.0, scene.durationSeconds, -4.0, 0.025));
    const auto isTheLine = [=](const Event &event) { return std::abs(event.position.front() - lineHz) < 5.0; };
    const auto countIn = [&](const Analyses &both) {
        return std::ranges::count_if(
            events(*both.chosen, withOtherWindows(*both.chosen, std::array{both.longer}).tracks), isTheLine);
    };
    QCOMPARE(countIn(inBothWindows(scene)), 1);

    constexpr int tones = 27; // three in a cell, at incommensurate frequencies
    for (int i = 0; i < tones; ++i)
        scene.lines.push_back(
            line(lineHz - 40.0 + 3.0 * i + 0.75 * std::sin(17.0 * i), 0.0, 0.0, scene.durationSeconds, -15.0, 0.025));
    const Analyses both = inBothWindows(scene);
    QVERIFY(std::ranges::any_of(events(*both.longer), isTheLine));
    QCOMPARE(countIn(both), 0);
}

/// The chosen window is four times the automatic one; the glide passes 64 of its cells in one.
void tst_otherWindows::aGlideBesideLinesThatStandStillIsFound()
{
    LineScene lines = sixThatStandStill(8);
    lines.lines.push_back(line(900.0, 100.0, 10.0, 8.0, 10.0, 0.05));
    const auto analysis = analysed(lines);
    QVERIFY(analysis->frames->spectrogram()->windowSeconds() > 0.7);
    const std::vector<Event> found = ofAnotherWindow(*analysis);
    QCOMPARE(found.size(), std::size_t(1));
    QVERIFY(std::abs(found.front().onsetSeconds - 10.0) < 1.0 && std::abs(found.front().endSeconds - 18.0) < 1.0);
    QVERIFY2(std::abs(found.front().ratesPerSecond.front() - 100.0) < 5.0,
             qPrintable(QString::number(found.front().ratesPerSecond.front())));
    QVERIFY(analysis->tracks.size() >= 7);
}

/// The chosen window is sixteen times the automatic one; the line wanders over twenty of its cells, and has half of its
/// energy there.
void tst_otherWindows::oneThatWandersBesideLinesThatStandStillIsFound()
{
    LineScene lines = sixThatStandStill(5);
    lines.lines.push_back(line(1300.0, 0.0, 10.0, 12.0, 4.0, 0.2));
    lines.lines.back().wanderHz = 2.0;
    lines.lines.back().wanderSeconds = 5.0;
    const auto analysis = analysed(lines);
    QVERIFY(analysis->frames->spectrogram()->windowSeconds() > 3.0);
    const std::vector<Event> found = ofAnotherWindow(*analysis);
    QCOMPARE(found.size(), std::size_t(1));
    QVERIFY2(std::abs(found.front().position.front() - 1300.0) < 6.0,
             qPrintable(QString::number(found.front().position.front())));
    QVERIFY(std::abs(found.front().onsetSeconds - 10.0) < 2.0 && std::abs(found.front().endSeconds - 22.0) < 2.0);
    QCOMPARE(analysis->tracks.size(), std::size_t(7));
}

/// The frames of the chosen window are several times as far apart as the line's movements last.
void tst_otherWindows::reportsTheMeanPositionWithinAFrame()
{
    LineScene lines = sixThatStandStill(5);
    lines.lines.push_back(line(1300.0, 0.0, 4.0, 24.0, 14.0, 0.2));
    lines.lines.back().wanderHz = 5.0;
    lines.lines.back().wanderSeconds = 0.2;
    const auto analysis = analysed(lines);
    double square = 0.0;
    double count = 0.0;
    for (const Track &track : analysis->tracks)
        for (const SmoothedPoint &point : track.smoothed)
            if (const double hz = analysis->grid().axes.back().value(point.position); hz > 1000.0) {
                square += (hz - 1300.0) * (hz - 1300.0);
                count += 1.0;
            }
    QVERIFY(count > 10.0 && analysis->time().step > 0.9);
    QVERIFY2(std::sqrt(square / count) < 4.5, qPrintable(QString::number(std::sqrt(square / count))));
}

/// Every window has them, and the short ones for longer: before the middle of the first long frame, behind the last one's.
void tst_otherWindows::strongLinesThatStandStillStay()
{
    LineScene lines = scene(4000.0, 100.0, 3);
    for (int i = 0; i < 12; ++i)
        lines.lines.push_back(line(47.0 * (i + 1), 0.0, 0.0, 100.0, 12.0 + i, 0.5));
    const auto analysis = analysed(lines);
    QVERIFY(analysis->frames->spectrogram()->windowSeconds() > 3.0);
    QCOMPARE(ofAnotherWindow(*analysis).size(), std::size_t(0));
    const std::vector<Event> found = events(*analysis);
    QCOMPARE(found.size(), lines.lines.size());
    for (const Event &event : found)
        QVERIFY(std::abs(std::remainder(event.position.front(), 47.0)) < 0.03);
}

/// The automatic window has no glide, a quarter of it the slower ones, which a sixteenth sees better; that has the
/// faster ones, too.
void tst_otherWindows::shorterWindowsAreTriedForWhatIsTooFast()
{
    const LineScene glides = slowAndFastGlides();
    const auto analysis = analysed(glides);
    const double window = analysis->frames->spectrogram()->windowSeconds();
    QVERIFY(window > 0.15);
    const std::vector<Event> found = ofAnotherWindow(*analysis);
    QCOMPARE(found.size(), glides.lines.size());
    for (const Event &event : found) {
        const bool isFast = event.onsetSeconds > 20.0;
        QVERIFY2(!isFast || std::abs(event.windowSeconds - window / 16.0) < 0.1 * event.windowSeconds,
                 qPrintable(QString::number(event.windowSeconds)));
        QVERIFY(event.endSeconds - event.onsetSeconds > (isFast ? 0.7 : 1.2));
    }
}

/// They are asked again over the glides that cross them, also over those of windows that are tried later.
void tst_otherWindows::faintLinesThatGlidesCrossStay()
{
    LineScene lines = slowAndFastGlides();
    for (int i = 0; i < 2; ++i) {
        lines.lines.push_back(line(3000.0, 0.0, 3.0 + 9.0 * i, 4.0, -5.0, 0.0125));
        lines.lines.push_back(line(5000.0, 0.0, 20.5 + 9.0 * i, 4.0, -5.0, 0.0125));
    }
    const auto analysis = analysed(lines);
    QCOMPARE(ofAnotherWindow(*analysis).size(), std::size_t(4));
    std::vector<Event> steady = events(*analysis);
    std::erase_if(steady, [](const Event &event) { return std::abs(event.driftPerSecond) > 1.0; });
    QCOMPARE(steady.size(), std::size_t(2)); // each of two stretches
    for (const Event &event : steady)
        QVERIFY(event.endSeconds - event.onsetSeconds > 12.5);
}

/// Strong glides that only a shorter window sees, each with a pause.
void tst_otherWindows::partsBetweenWhichLittleIsLostAreOneTrack()
{
    LineScene glides = scene(16000.0, 40.0, 4);
    for (const double start : {4.0, 14.0, 24.0}) {
        glides.lines.push_back(line(4000.0, -1500.0, start, 0.7, 16.0, 0.0125));
        glides.lines.push_back(line(4000.0 - 1500.0 * 0.9, -1500.0, start + 0.9, 0.7, 16.0, 0.0125));
    }
    const std::vector<Event> found = ofAnotherWindow(*analysed(glides));
    QCOMPARE(found.size(), std::size_t(3));
    for (const Event &event : found)
        QVERIFY(event.endSeconds - event.onsetSeconds > 1.2);
}

/// In the chosen window the line moves over a hundred cells, among which its energy makes short tracks.
void tst_otherWindows::aStrongFastLineIsOneTrack()
{
    for (const int seed : {3, 4, 8}) {
        LineScene lines = sixThatStandStill(seed);
        lines.lines.push_back(line(900.0, 8.0, 2.0, 28.0, 25.0, 0.2));
        lines.lines.back().wanderHz = 10.0;
        lines.lines.back().wanderSeconds = 4.0;
        std::vector<Event> found = events(*analysed(lines));
        std::erase_if(found, [](const Event &event) { return event.position.front() < 700.0; });
        QCOMPARE(found.size(), std::size_t(1));
        QVERIFY(found.front().onsetSeconds < 3.0 && found.front().endSeconds > 29.0);
    }
}

void tst_otherWindows::aChangeOfTheThresholdAsksAgain()
{
    const LineScene scene = sweepsBesideAFaintLine(-4.0);
    const auto recording = std::make_shared<SimulatedRecording>(scene);
    const auto first = analyse(recording, {});
    AnalysisSettings settings;
    settings.decide.falseAlarmsPerHour = 10.0;
    const auto second = analyse(recording, settings, {.previous = first.get()});
    QVERIFY(longerOf(*second).frames == longerOf(*first).frames);
    QCOMPARE(ofAnotherWindow(*second).size(), std::size_t(1));
    const Event event = ofAnotherWindow(*second).front();
    // Counted from the threshold of the window shown.
    QVERIFY(std::abs((event.statistic - second->threshold)
                     - (ofAnotherWindow(*first).front().statistic - first->threshold)
                     - (longerOf(*first).threshold - longerOf(*second).threshold))
            < 1e-6);
}

FAINTLINE_TEST(tst_otherWindows)
#include "tst_otherWindows.moc"
