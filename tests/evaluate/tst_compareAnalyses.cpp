#include "analyse/analyse.h"
#include "evaluate/comparison/compareAnalyses.h"
#include "evaluate/comparison/differencePicture.h"
#include "evaluate/comparison/settingDifferences.h"
#include "evaluate/experiments/measureCost.h"
#include "exchange/writeComparison.h"
#include "support/test.h"

#include "base/Error.h"
#include "scene/SimulatedRecording.h"

#include <cmath>

using namespace faintline;
using In = ComparedEvent::In;

namespace {

constexpr Index frameCount = 100;

Track track(int id, Index onset, Index end, Index cell, double cellsPerFrame = 0.0)
{
    Track result;
    result.id = id;
    result.onsetFrame = result.detectFrame = onset;
    result.endFrame = end;
    result.peakStatistic = 20.0 + id;
    for (Index frame = onset; frame <= end; ++frame)
        result.points.push_back({frame, cell + std::llround(cellsPerFrame * double(frame - onset)), 0, 1.0});
    return result;
}

/// An analysis that holds nothing but tracks, on frames of `stepSeconds` and bins of `stepHz`.
Analysis holding(std::vector<Track> tracks, double stepSeconds = 0.5, double stepHz = 2.0, bool isCyclic = false)
{
    Analysis analysis;
    const auto frames = Index(std::lround(frameCount * 0.5 / stepSeconds));
    const auto cells = Index(std::lround(100.0 * 2.0 / stepHz));
    const Axis hertz{"frequency", "Hz", 0.0, stepHz, cells, isCyclic};
    analysis.frames = std::make_shared<FrameArray>(Axis{"time", "s", 0.0, stepSeconds, frames, false}, Grid{{hertz}},
                                                   std::vector<float>());
    analysis.tracks = std::move(tracks);
    return analysis;
}

/// "A1", "B2", "A1=B2" in the order of the comparison.
QStringList words(const Comparison &comparison)
{
    QStringList result;
    for (const ComparedEvent &event : comparison.events) {
        QStringList sides;
        if (event.a)
            sides << QStringLiteral("A%1").arg(event.a->id);
        if (event.b)
            sides << QStringLiteral("B%1").arg(event.b->id);
        result << sides.join('=');
    }
    return result;
}

QStringList compared(std::vector<Track> a, std::vector<Track> b, const CompareTolerance &tolerance = {})
{
    return words(compareAnalyses(holding(std::move(a)), holding(std::move(b)), tolerance));
}

/// A statistic's picture, by eye: rows of cells in nat.
Analysis withStatistic(const std::vector<std::vector<float>> &rows, double threshold, double stepSeconds = 1.0,
                       double stepHz = 1.0)
{
    Analysis analysis;
    const Axis time{"time", "s", 0.0, stepSeconds, std::ssize(rows), false};
    const auto cells = std::ssize(rows.front());
    analysis.frames = std::make_shared<FrameArray>(time, Grid{{{"frequency", "Hz", 0.0, stepHz, cells, false}}},
                                                   std::vector<float>());
    const auto picture = std::make_shared<PeakPyramid>(time, cells, ByteScale(ByteScale::Kind::ScoreNats));
    for (const std::vector<float> &row : rows)
        picture->append(row);
    picture->finish();
    analysis.statistic = picture;
    analysis.threshold = threshold;
    return analysis;
}

double valueOf(const PeakPyramid &picture, int level, Index row, Index cell)
{
    return picture.scale().value(picture.row(level, row)[std::size_t(cell)]);
}

} // namespace

/// What two analyses of one recording find: alike, and each by itself.
class tst_compareAnalyses : public QObject
{
    Q_OBJECT

private slots:
    void sameTrackIsInBoth()
    {
        QCOMPARE(compared({track(1, 10, 40, 20)}, {track(7, 10, 40, 20)}), QStringList{"A1=B7"});
        QCOMPARE(compared({}, {}), QStringList());
        QCOMPARE(compared({track(1, 10, 40, 20)}, {}), QStringList{"A1"});
        QCOMPARE(compared({}, {track(1, 10, 40, 20)}), QStringList{"B1"});
    }

    void toleranceInFrequency()
    {
        QCOMPARE(compared({track(1, 10, 40, 20)}, {track(1, 10, 40, 24)}), QStringList{"A1=B1"});
        QCOMPARE(compared({track(1, 10, 40, 20)}, {track(1, 10, 40, 25)}), (QStringList{"A1", "B1"}));
        QCOMPARE(compared({track(1, 10, 40, 20)}, {track(1, 10, 40, 25)}, {5.0, 2.0}), QStringList{"A1=B1"});
    }

    void toleranceInTime()
    {
        // The first ends at frame 40; two frames of tolerance on either side reach four frames.
        QCOMPARE(compared({track(1, 10, 40, 20)}, {track(1, 44, 80, 20)}), QStringList{"A1=B1"});
        QCOMPARE(compared({track(1, 10, 40, 20)}, {track(1, 45, 80, 20)}), (QStringList{"A1", "B1"}));
        QCOMPARE(compared({track(1, 10, 40, 20)}, {track(1, 41, 80, 20)}, {4.0, 0.0}), (QStringList{"A1", "B1"}));
    }

    void crossingLinesAreTwo()
    {
        // They meet in the middle and are within the tolerance for a fifth of the time.
        QCOMPARE(compared({track(1, 0, 40, 20, 1.0)}, {track(1, 0, 40, 62, -1.0)}), (QStringList{"A1", "B1"}));
        QCOMPARE(compared({track(1, 0, 40, 20, 1.0), track(2, 0, 40, 60, -1.0)},
                          {track(1, 0, 40, 60, -1.0), track(2, 0, 40, 20, 1.0)}),
                 (QStringList{"A1=B2", "A2=B1"}));
    }

    void oneToOneLongestFirst()
    {
        // B breaks A's line in three: the longest piece is the one in both.
        QCOMPARE(compared({track(1, 0, 90, 20)}, {track(1, 0, 20, 20), track(2, 25, 80, 20), track(3, 84, 90, 20)}),
                 (QStringList{"B1", "A1=B2", "B3"}));
    }

    void exchangingThemExchangesNames()
    {
        const std::vector<Track> some{track(1, 0, 90, 20), track(2, 5, 60, 70, 0.3), track(3, 50, 70, 10)};
        const std::vector<Track> other{track(1, 2, 30, 21), track(2, 30, 88, 19), track(3, 6, 66, 71, 0.3),
                                       track(4, 1, 5, 90)};
        const QStringList there = compared(some, other);
        QStringList back = compared(other, some);
        for (QString &word : back) {
            QStringList sides = word.split('=');
            for (QString &side : sides)
                side[0] = side[0] == 'A' ? 'B' : 'A';
            std::sort(sides.begin(), sides.end());
            word = sides.join('=');
        }
        QCOMPARE(QSet<QString>(back.begin(), back.end()), QSet<QString>(there.begin(), there.end()));
        QCOMPARE(there.size(), 5);
    }

    void gridsOfOtherSteps()
    {
        // The same line at 100 Hz from 10 s to 30 s: B has frames half as long and bins of half the width.
        const Analysis a = holding({track(1, 20, 60, 50)}, 0.5, 2.0);
        const Analysis b = holding({track(1, 40, 120, 100)}, 0.25, 1.0);
        const Comparison comparison = compareAnalyses(a, b);
        QCOMPARE(words(comparison), QStringList{"A1=B1"});
        // 20 s and a frame of 0.5 s twice on either side, both ends counted.
        QVERIFY(std::abs(comparison.events[0].sharedSeconds - 22.5) < 1e-9);
        // Four of the coarser bins are 8 Hz, eight of B's.
        QCOMPARE(words(compareAnalyses(a, holding({track(1, 40, 120, 108)}, 0.25, 1.0))), QStringList{"A1=B1"});
        QCOMPARE(words(compareAnalyses(a, holding({track(1, 40, 120, 109)}, 0.25, 1.0))), (QStringList{"A1", "B1"}));
    }

    void cyclicAxis()
    {
        const auto around = [](bool isCyclic) {
            const Analysis a = holding({track(1, 10, 40, 1)}, 0.5, 2.0, isCyclic),
                           b = holding({track(1, 10, 40, 98)}, 0.5, 2.0, isCyclic);
            return words(compareAnalyses(a, b));
        };
        QCOMPARE(around(true), QStringList{"A1=B1"});
        QCOMPARE(around(false), (QStringList{"A1", "B1"}));
    }

    void otherQuantitiesAreRefused()
    {
        Analysis ranges = holding({});
        ranges.frames = std::make_shared<FrameArray>(Axis{"time", "s", 0.0, 0.5, 10, false},
                                                     Grid{{{"range", "m", 0.0, 1.0, 10, false}}}, std::vector<float>());
        QVERIFY_THROWS_EXCEPTION(Error, compareAnalyses(holding({}), ranges));
    }

    void differenceByEye()
    {
        const Analysis a = withStatistic({{1.0f, 20.0f}, {2.0f, 3.0f}}, 10.0);
        const Analysis b = withStatistic({{1.0f, 5.0f}, {12.0f, 3.5f}}, 8.0);
        const auto picture = differencePicture(a, b);
        // (D_B - 8) - (D_A - 10)
        QCOMPARE(valueOf(*picture, 0, 0, 0), 2.0);
        QCOMPARE(valueOf(*picture, 0, 0, 1), -13.0);
        QCOMPARE(valueOf(*picture, 0, 1, 0), 12.0);
        QCOMPARE(valueOf(*picture, 0, 1, 1), 2.5);
        // Zoomed out, the one of largest magnitude stays, with its sign.
        QCOMPARE(valueOf(*picture, 1, 0, 0), 12.0);
        QCOMPARE(valueOf(*picture, 1, 0, 1), -13.0);
        const auto back = differencePicture(b, a);
        for (Index row = 0; row < 2; ++row)
            for (Index cell = 0; cell < 2; ++cell)
                QCOMPARE(valueOf(*back, 0, row, cell), -valueOf(*picture, 0, row, cell));
        QVERIFY(haveCommonUnit(a, b));
    }

    void differenceOfOtherGrids()
    {
        // A has twice as many frames and cells; in every cell of B lie two of them along each axis.
        const Analysis a = withStatistic({{0.0f, 1.0f, 2.0f, 3.0f}, {4.0f, 5.0f, 6.0f, 7.0f}}, 0.0, 0.5, 0.5);
        const Analysis b = withStatistic({{10.0f, 20.0f}}, 0.0);
        const auto picture = differencePicture(a, b);
        QCOMPARE(picture->rowCount(0), Index(1));
        QCOMPARE(picture->cells(), Index(2));
        // Cell 0 of B covers -0.5 … 0.5 Hz: A's cells 0 (0 Hz); cell 1: 0.5 and 1.0 Hz. Likewise in time: A's frame 0.
        QCOMPARE(valueOf(*picture, 0, 0, 0), 10.0);
        QCOMPARE(valueOf(*picture, 0, 0, 1), 18.0);
        const auto back = differencePicture(b, a);
        QCOMPARE(back->rowCount(0), Index(2));
        QCOMPARE(back->cells(), Index(4));
        QCOMPARE(valueOf(*back, 0, 0, 0), -10.0);
        QCOMPARE(valueOf(*back, 0, 1, 3), -13.0);
    }

    void settingsInWords()
    {
        AnalysisSettings a;
        AnalysisSettings b = a;
        QVERIFY(settingDifferences(a, b).empty());
        b.model.snr = 0.25;
        b.decide.pfaPerCell = 1e-3; // does not count
        auto differences = settingDifferences(a, b);
        QCOMPARE(differences.size(), std::size_t(1));
        QCOMPARE(QString::fromStdString(differences[0].field.name), QString("model.snr"));
        QCOMPARE(QString::fromStdString(differences[0].a), QString("0.5"));
        QCOMPARE(QString::fromStdString(differences[0].b), QString("0.25"));
        b = a;
        setSetting(b, "detector.kind", "pOfN");
        differences = settingDifferences(a, b);
        QCOMPARE(differences.size(), std::size_t(1));
        setSetting(b, "pOfN.n", "9");
        differences = settingDifferences(a, b);
        QCOMPARE(differences.size(), std::size_t(2));
        QVERIFY(differences[1].a.empty());
        QCOMPARE(QString::fromStdString(differences[1].b), QString("9"));
    }

    void fileOfBoth()
    {
        const Analysis a = holding({track(1, 10, 40, 20), track(2, 50, 60, 80)});
        const Analysis b = holding({track(1, 12, 40, 21)});
        const QTemporaryDir folder;
        const std::string path = folder.filePath("both.csv").toStdString();
        writeComparison(compareAnalyses(a, b), b.grid(), path);
        QFile file(QString::fromStdString(path));
        QVERIFY(file.open(QIODevice::ReadOnly));
        QCOMPARE(file.readAll(), QByteArray("in,event_a,event_b,t_onset,t_end,f,drift_hz_per_s,t_detect_a,t_detect_b,"
                                            "statistic_a,statistic_b,shared_s\n"
                                            "both,1,1,6,20,42,0,5,6,21,21,16.5\n"
                                            "A,2,,25,30,160,0,25,,22,,\n"));
        QVERIFY_THROWS_EXCEPTION(Error, checkComparisonPath("both.txt"));
    }

    void realOnes()
    {
        // A faint line: the detector finds it, thresholding one frame does not but for some seeds' chance.
        LineScene scene{.sampleRateHz = 400.0, .durationSeconds = 60.0, .seed = 4};
        LineSettings line{.snrDb = 1.5, .startSeconds = 10.0, .durationSeconds = 45.0, .frequencyHz = 90.0};
        scene.lines.push_back(line);
        const auto recording = std::make_shared<SimulatedRecording>(scene);
        AnalysisSettings settings = preset("billon").settings;
        settings.spectrogram.windowSeconds = 0.25;
        const auto a = analyse(recording, settings);
        settings.detector = EnergySettings{};
        const auto b = analyse(recording, settings, {.previous = a.get()});
        const Comparison comparison = compareAnalyses(*a, *b);
        QVERIFY(comparison.count(In::A) >= 1);
        QCOMPARE(comparison.count(In::A), std::ssize(comparison.events));
        QVERIFY(!haveCommonUnit(*a, *b));
        const auto picture = differencePicture(*a, *b);
        QCOMPARE(picture->frameCount(), a->time().count);
        // On the line A is far above its threshold and B is not.
        QVERIFY(valueOf(*picture, 0, a->time().nearest(50.0), a->grid().axes[0].nearest(90.0)) < -5.0);
        QVERIFY(measureCost(*a) > 0.0);
    }
};

FAINTLINE_TEST(tst_compareAnalyses)
#include "tst_compareAnalyses.moc"
