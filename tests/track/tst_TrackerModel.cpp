#include "support/test.h"
#include "track/TrackerModel.h"

#include "refine/numberByDetection.h"

#include <cmath>

using namespace faintline;

namespace {

KinematicAxis axis(const char *name, Index cells, bool isCyclic, int reach)
{
    KinematicAxis made;
    made.name = name;
    made.cells = cells;
    made.cyclic = isCyclic;
    made.firstRate = -reach;
    made.rateCount = 2 * reach + 1;
    made.rateChange = {1.0};
    return made;
}

/// Forty range cells and a ring of nine beams; a target goes by up to two cells and one beam.
const Grid &grid()
{
    static const Grid made{{{"range", "m", 0.0, 10.0, 40, false}, {"bearing", "°", 0.0, 40.0, 9, true}}};
    return made;
}

TrackerModel model(std::vector<double> windowCells)
{
    TrackSettings settings;
    settings.windowCells = std::move(windowCells);
    return {{StateSpace({axis("range", 40, false, 2), axis("bearing", 9, true, 1)}), Likelihood(), 1.0},
            grid(),
            settings,
            10.0};
}

Track detected(Index frame, Index cell, int id)
{
    Track track;
    track.id = id;
    track.detectFrame = frame;
    track.points = {{frame, cell, 0, 0.0}};
    return track;
}

} // namespace

/// The window that trackers share: which cells it covers wherever it stands.
class tst_TrackerModel : public QObject
{
    Q_OBJECT

private slots:
    void windowsHaveTheirSides();
    void cellsOfTheWindowOnTheGrid_data();
    void cellsOfTheWindowOnTheGrid();
    void cellsThatHaveMovedLieInThePadding();
    void tracksAreNumberedInOrder();
};

void tst_TrackerModel::windowsHaveTheirSides()
{
    const TrackerModel made = model({5.0, 3.0});
    QCOMPARE(made.halfWidth, (std::vector<Index>{5, 3}));
    QCOMPARE(made.reach, (std::vector<Index>{2, 1}));
    QCOMPARE(made.window.cellCount(), Index(11 * 7));
    QCOMPARE(made.padded.cellCount(), Index(15 * 9));
    QCOMPARE(made.largestExtent, Index(14));
    QCOMPARE(made.window.planeCount(), made.space.planeCount());
    QCOMPARE(made.scores.size(), std::size_t(made.padded.stateCount()));
    QCOMPARE(model({2.4}).halfWidth, (std::vector<Index>{2, 2}));       // the last number repeats
    QCOMPARE(model({1e4, 1e4}).halfWidth, (std::vector<Index>{19, 4})); // no cell is in it twice
    QCOMPARE(model({}).halfWidth, (std::vector<Index>{12, 4}));
    QCOMPARE(model({0.0}).window.cellCount(), Index(1));
}

void tst_TrackerModel::cellsOfTheWindowOnTheGrid_data()
{
    QTest::addColumn<int>("range");
    QTest::addColumn<int>("beam");
    QTest::newRow("in the middle") << 20 << 4;
    QTest::newRow("at the near end, across the wrap") << 1 << 0;
    QTest::newRow("at the far end, across the wrap") << 39 << 8;
}

void tst_TrackerModel::cellsOfTheWindowOnTheGrid()
{
    QFETCH(int, range);
    QFETCH(int, beam);
    const TrackerModel made = model({5.0, 3.0});
    const auto expected = [](Index r, Index b) { return r < 0 || r >= 40 ? Index(-1) : r * 9 + (b + 9) % 9; };
    const std::vector<Index> centre{range, beam};
    for (Index r = 0; r < 11; ++r)
        for (Index b = 0; b < 7; ++b)
            QCOMPARE(made.windowCell(centre, r * 7 + b), expected(range + r - 5, beam + b - 3));
    for (Index r = 0; r < 15; ++r)
        for (Index b = 0; b < 9; ++b)
            QCOMPARE(made.paddedCell(centre, r * 9 + b), expected(range + r - 7, beam + b - 4));
}

// The same cell of the grid, whether it is asked of the window that has moved or of the padded one that has not.
void tst_TrackerModel::cellsThatHaveMovedLieInThePadding()
{
    const TrackerModel made = model({5.0, 3.0});
    for (Index r = -8; r <= 8; ++r)
        for (Index b = -4; b <= 4; ++b)
            for (Index cell = 0; cell < made.window.cellCount(); ++cell) {
                const Index range = cell / 7 - 5 + r;
                const Index beam = cell % 7 - 3 + b;
                const bool isInside = std::abs(range) <= 7 && std::abs(beam) <= 4;
                const Index found = made.inPadded(cell, {r, b});
                QCOMPARE(found, isInside ? (range + 7) * 9 + beam + 4 : Index(-1));
                if (isInside)
                    QCOMPARE(made.paddedCell({20, 4}, found), made.windowCell({20 + r, (4 + b + 9) % 9}, cell));
            }
}

void tst_TrackerModel::tracksAreNumberedInOrder()
{
    std::vector<Track> tracks{detected(7, 3, 90), detected(2, 8, 91), detected(7, 1, 92), detected(7, 3, 93)};
    numberByDetection(tracks);
    const std::vector<std::pair<Index, Index>> expected{{2, 8}, {7, 1}, {7, 3}, {7, 3}};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        QCOMPARE(tracks[i].id, int(i) + 1);
        QCOMPARE(tracks[i].detectFrame, expected[i].first);
        QCOMPARE(tracks[i].points.front().cell, expected[i].second);
    }
    tracks.clear();
    numberByDetection(tracks);
    QVERIFY(tracks.empty());
}

FAINTLINE_TEST(tst_TrackerModel)
#include "tst_TrackerModel.moc"
