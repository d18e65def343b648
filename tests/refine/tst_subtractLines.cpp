#include "analyse/analyse.h"
#include "analyse/events.h"
#include "base/Error.h"
#include "exchange/writeEvents.h"
#include "refine/subtractLines.h"
#include "scene/SimulatedRecording.h"
#include "support/test.h"

#include "support/lines.h"

#include <algorithm>
#include <cmath>

using namespace faintline;

namespace {

constexpr double rateHz = 400.0;
constexpr double windowSeconds = 0.25;
constexpr double cellHz = 1.0 / windowSeconds;
constexpr double seconds = 60.0;

AnalysisSettings settingsWith(bool subtracts)
{
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = windowSeconds;
    settings.subtract.lines = subtracts;
    return settings;
}

std::shared_ptr<SimulatedRecording> recordingOf(const std::vector<LineSettings> &lines, int seed, bool isComplex)
{
    LineScene scene = test::scene(rateHz, seconds, seed);
    scene.isComplex = isComplex;
    scene.lines = lines;
    return std::make_shared<SimulatedRecording>(scene);
}

double hzAt(const LineSettings &line, const Analysis &analysis, Index frame)
{
    return line.frequencyHz + line.driftHzPerSecond * (analysis.time().value(double(frame)) - line.startSeconds);
}

/// Whether most of a track runs within a cell of a line.
bool isOn(const Track &track, const Analysis &analysis, const LineSettings &line)
{
    const Axis &axis = analysis.grid().axes.back();
    std::size_t near = 0;
    for (std::size_t i = 0; i < track.points.size(); ++i)
        if (std::abs(axis.value(track.lastPosition(i, axis)) - hzAt(line, analysis, track.points[i].frame)) < cellHz)
            ++near;
    return 2 * near > track.points.size();
}

/// How many cells away from a line a track is, in the mean.
double distanceOf(const Track &track, const Analysis &analysis, const LineSettings &line)
{
    const Axis &axis = analysis.grid().axes.back();
    double sum = 0.0;
    for (std::size_t i = 0; i < track.points.size(); ++i)
        sum += axis.value(track.lastPosition(i, axis)) - hzAt(line, analysis, track.points[i].frame);
    return std::abs(sum) / double(track.points.size()) / cellHz;
}

/// What was found of two lines.
struct Found {
    int strong = 0;
    int weak = 0;
    int near = 0; ///< neither, within eight cells of the strong one
    int far = 0;
};

Found foundIn(const Analysis &analysis, const LineSettings &strong, const LineSettings &weak)
{
    Found found;
    for (const Track &track : analysis.tracks) {
        const bool isNear = distanceOf(track, analysis, strong) < 8.0;
        ++(track.isSubtracted && isOn(track, analysis, strong) ? found.strong
           : isOn(track, analysis, weak)                       ? found.weak
           : isNear                                            ? found.near
                                                               : found.far);
    }
    return found;
}

LineSettings strongLine(double hz, double drift = 0.0)
{
    return test::line(hz, drift, 0.0, 0.0, 40.0, windowSeconds);
}

} // namespace

/// Weak lines beside strong ones, which are subtracted.
class tst_subtractLines : public QObject
{
    Q_OBJECT

private slots:
    void aWeakLineBesideAStrongOne_data();
    void aWeakLineBesideAStrongOne();
    void nothingIsLeftWhereAStrongLineBeginsAndStops();
    void nothingChangesWithoutAStrongLine();
    void offIsAsBefore();
    void theFirstRunIsKept();
    void inTheChosenWindowToo();
    void refusesWhatItCannotDo();
};

void tst_subtractLines::aWeakLineBesideAStrongOne_data()
{
    QTest::addColumn<bool>("isComplex");
    QTest::addColumn<double>("drift"); // of both, Hz/s
    QTest::addColumn<double>("lasts"); // the weak one, s
    QTest::newRow("real, steady") << false << 0.0 << 10.0;
    QTest::newRow("real, drifting") << false << 0.5 << 15.0;
    QTest::newRow("I/Q, steady") << true << 0.0 << 10.0;
    QTest::newRow("I/Q, drifting") << true << 0.5 << 40.0;
}

/// At 0 dB, two cells from one at 40 dB: found as often as alone, where without subtraction it is never found, and
/// nothing else is found there that is not found without the strong one. It lasts as long as chance has a say.
void tst_subtractLines::aWeakLineBesideAStrongOne()
{
    QFETCH(bool, isComplex);
    QFETCH(double, drift);
    QFETCH(double, lasts);
    constexpr int seeds = 60;
    int alone = 0;
    int beside = 0;
    int hidden = 0;
    int strongOnes = 0;
    int near = 0;
    int far = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
        const double hz = 60.0 + 0.37 * seed;
        const LineSettings strong = strongLine(hz, drift);
        const LineSettings weak = test::line(hz + 2.0 * cellHz + 15.0 * drift, drift, 15.0, lasts, 0.0, windowSeconds);
        const auto both = recordingOf({weak, strong}, seed, isComplex); // the weak one's phase is the same alone
        const auto rest = analyse(both, settingsWith(true));
        const Found found = foundIn(*rest, strong, weak);
        const Found only = foundIn(*analyse(recordingOf({weak}, seed, isComplex), settingsWith(false)), strong, weak);
        alone += only.weak > 0 ? 1 : 0;
        beside += found.weak > 0 ? 1 : 0;
        hidden += foundIn(*rest->unsubtracted, strong, weak).weak > 0 ? 0 : 1;
        strongOnes += found.strong == 1 ? 1 : 0;
        near += std::max(0, found.near - only.near);
        far += found.far;
    }
    const QString counts = QString("of %1: alone %2, beside %3, hidden %4, strong %5, near %6, far %7")
                               .arg(seeds)
                               .arg(alone)
                               .arg(beside)
                               .arg(hidden)
                               .arg(strongOnes)
                               .arg(near)
                               .arg(far);
    qInfo() << qPrintable(counts);
    QVERIFY2(alone >= 10, qPrintable(counts));
    QVERIFY2(10 * std::abs(alone - beside) <= seeds, qPrintable(counts));
    QVERIFY2(hidden == seeds && strongOnes == seeds && near == 0, qPrintable(counts));
    QVERIFY2(far <= 4, qPrintable(counts)); // one is ordered in the hour that this is
}

void tst_subtractLines::nothingIsLeftWhereAStrongLineBeginsAndStops()
{
    for (const bool isComplex : {false, true})
        for (int seed = 1; seed <= 20; ++seed) {
            LineSettings strong = strongLine(70.0 + 0.37 * seed, 0.3);
            strong.startSeconds = 11.0 + 0.03 * seed;
            strong.durationSeconds = 25.0 + 0.07 * seed;
            const auto analysis = analyse(recordingOf({strong}, seed, isComplex), settingsWith(true));
            const Found found = foundIn(*analysis, strong, strong);
            QCOMPARE(found.strong, 1);
            QCOMPARE(found.weak + found.near, 0);
        }
}

void tst_subtractLines::nothingChangesWithoutAStrongLine()
{
    const auto recording = recordingOf({test::line(91.3, 0.2, 5.0, 40.0, 10.0, windowSeconds)}, 1, false);
    const auto with = analyse(recording, settingsWith(true));
    const auto without = analyse(recording, settingsWith(false));
    QVERIFY(!with->unsubtracted && !without->tracks.empty());
    QCOMPARE(with->tracks.size(), without->tracks.size());
    for (std::size_t i = 0; i < with->tracks.size(); ++i)
        QCOMPARE(with->tracks[i].peakStatistic, without->tracks[i].peakStatistic);
    QVERIFY(with->statisticCounts == without->statisticCounts);
    QVERIFY(with->input && with->statistic);
    QVERIFY(subtractionWords(*with).starts_with("no line of 20 dB or more"));
}

/// Whether it was on before or not, nothing of it is left in what is off.
void tst_subtractLines::offIsAsBefore()
{
    const auto recording =
        recordingOf({strongLine(91.3), test::line(99.3, 0.0, 0.0, 0.0, 3.0, windowSeconds)}, 1, false);
    const auto first = analyse(recording, settingsWith(false));
    const auto on = analyse(recording, settingsWith(true), {.previous = first.get()});
    const auto off = analyse(recording, settingsWith(false), {.previous = on.get()});
    const auto again = analyse(recording, settingsWith(true), {.previous = off.get()});
    QCOMPARE(eventsCsv(*off, events(*off)), eventsCsv(*first, events(*first)));
    QVERIFY(off->statisticCounts == first->statisticCounts);
    QCOMPARE(eventsCsv(*again, events(*again)), eventsCsv(*on, events(*on)));
    QVERIFY(again->statisticCounts == on->statisticCounts);
    QVERIFY(eventsCsv(*off, events(*off)) != eventsCsv(*on, events(*on)));
    QVERIFY(subtractionWords(*off).empty());
}

void tst_subtractLines::theFirstRunIsKept()
{
    const auto recording =
        recordingOf({strongLine(91.3), test::line(99.3, 0.0, 0.0, 0.0, 3.0, windowSeconds)}, 1, false);
    const auto on = analyse(recording, settingsWith(true));
    const auto off = analyse(recording, settingsWith(false));
    QVERIFY(on->unsubtracted && on->recording == recording);
    QCOMPARE(on->unsubtracted->tracks.size(), off->tracks.size());
    QVERIFY(on->unsubtracted->lnK == off->lnK && on->unsubtracted->continuedFraction == off->continuedFraction);
    QCOMPARE(on->threshold, off->threshold);
    QCOMPARE(std::ssize(on->tracks), Index(2));
    QVERIFY(on->tracks[0].isSubtracted != on->tracks[1].isSubtracted);
    for (const Event &event : events(*on))
        QCOMPARE(event.isSubtracted, event.snrDb > 20.0);
    QVERIFY2(subtractionWords(*on).starts_with("1 line of 20 dB or more subtracted, up to 37."),
             subtractionWords(*on).c_str());
}

void tst_subtractLines::inTheChosenWindowToo()
{
    AnalysisSettings settings = settingsWith(true);
    settings.spectrogram.windowSeconds = 0.0;
    const LineSettings strong = strongLine(91.3);
    const auto recording = recordingOf({strong}, 3, false);
    const auto analysis = analyse(recording, settings);
    QVERIFY(analysis->choice && analysis->unsubtracted);
    const auto strongest =
        std::max_element(analysis->tracks.begin(), analysis->tracks.end(),
                         [](const Track &a, const Track &b) { return a.peakStatistic < b.peakStatistic; });
    QVERIFY(strongest != analysis->tracks.end() && isOn(*strongest, *analysis, strong) && strongest->isSubtracted);
    QCOMPARE(std::ssize(analysis->tracks), Index(1));
}

void tst_subtractLines::refusesWhatItCannotDo()
{
    const auto recording = recordingOf({}, 1, false);
    for (const auto &[name, value] : {std::pair{"track.bothWays", "false"},
                                      {"noise.causal", "true"},
                                      {"model.likelihood", "linear"},
                                      {"detector.kind", "energy"},
                                      {"family.relation", "harmonics"}}) {
        AnalysisSettings settings = settingsWith(true);
        setSetting(settings, name, value);
        if (settings.family.relation != FamilySettings::Relation::None)
            settings.family.members = {1.0, 2.0};
        try {
            analyse(recording, settings);
            QFAIL(name);
        } catch (const Error &error) {
            QCOMPARE(QString::fromStdString(error.field()), QString("subtract.lines"));
        }
    }
}

FAINTLINE_TEST(tst_subtractLines)
#include "tst_subtractLines.moc"
