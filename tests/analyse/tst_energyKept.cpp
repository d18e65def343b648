#include "analyse/chooseWindow.h"
#include "support/test.h"

#include <cmath>
#include <functional>

using namespace faintline;

namespace {

Axis axis(const char *name, const char *unit, double step, Index count)
{
    return {name, unit, 0.0, step, count, false};
}

const Axis shortTime = axis("time", "s", 0.5, 400);
const Axis longTime = axis("time", "s", 2.0, 100);
const Axis shortCells = axis("frequency", "Hz", 0.5, 1000);
const Axis longCells = axis("frequency", "Hz", 0.125, 4000);

/// A track along hz(t) whose level is r(t).
Track track(const Axis &time, const Axis &cells, double from, double to, const std::function<double(double)> &hz,
            double level, double statistic = 50.0)
{
    Track result;
    result.peakStatistic = statistic;
    for (Index frame = Index(from / time.step); double(frame) * time.step < to; ++frame) {
        const double position = cells.position(hz(time.value(double(frame))));
        result.points.push_back({frame, Index(std::lround(position)), 0, 0.0});
        result.smoothed.push_back({position, 0.0f, 0.0f, 1.0f, float(level)});
    }
    result.takeEndsOfPoints();
    return result;
}

double kept(const std::vector<Track> &ofShort, const std::vector<Track> &ofLong, double least = 10.0)
{
    return energyKept({ofShort, shortTime, shortCells, 1.0}, {ofLong, longTime, longCells, 0.25}, least);
}

} // namespace

/// The share of tracks' energy that another window follows, on tracks made by hand.
class tst_energyKept : public QObject
{
    Q_OBJECT

private slots:
    void steadyLineIsKept();
    void whatMovesIsNot();
    void severalTracksAddUp();
    void otherPlacesAndTimesDoNotCount();
    void medianIsWeightedByDuration();
    void nothingToCompare();
};

void tst_energyKept::steadyLineIsKept()
{
    const auto line = [](double) { return 100.0; };
    // Four times the power in a fourth of the frames.
    QVERIFY(std::abs(kept({track(shortTime, shortCells, 10.0, 90.0, line, 2.0)},
                          {track(longTime, longCells, 10.0, 90.0, line, 8.0)})
                     - 1.0)
            < 1e-6);
}

void tst_energyKept::whatMovesIsNot()
{
    const auto sweep = [](double t) { return 50.0 + 2.0 * t; };
    const double share = kept({track(shortTime, shortCells, 10.0, 90.0, sweep, 8.0)},
                              {track(longTime, longCells, 10.0, 90.0, sweep, 2.0)});
    QVERIFY(std::abs(share - 1.0 / 16.0) < 0.01);
}

void tst_energyKept::severalTracksAddUp()
{
    const auto line = [](double) { return 100.0; };
    const auto beside = [](double) { return 100.5; };
    const std::vector<Track> halves{track(longTime, longCells, 10.0, 50.0, line, 4.0),
                                    track(longTime, longCells, 50.0, 90.0, line, 4.0),
                                    track(longTime, longCells, 10.0, 90.0, beside, 4.0)};
    QVERIFY(std::abs(kept({track(shortTime, shortCells, 10.0, 90.0, line, 2.0)}, halves) - 1.0) < 0.02);
}

void tst_energyKept::otherPlacesAndTimesDoNotCount()
{
    const auto line = [](double) { return 100.0; };
    const auto other = [](double) { return 110.0; };
    const std::vector<Track> found{track(longTime, longCells, 10.0, 90.0, line, 4.0),
                                   track(longTime, longCells, 10.0, 90.0, other, 40.0),
                                   track(longTime, longCells, 100.0, 180.0, line, 40.0)};
    QVERIFY(std::abs(kept({track(shortTime, shortCells, 10.0, 90.0, line, 2.0)}, found) - 0.5) < 0.02);
}

void tst_energyKept::medianIsWeightedByDuration()
{
    const auto a = [](double) { return 100.0; };
    const auto b = [](double) { return 200.0; };
    const auto c = [](double) { return 300.0; };
    const std::vector<Track> ofShort{track(shortTime, shortCells, 0.0, 180.0, a, 1.0),
                                     track(shortTime, shortCells, 0.0, 20.0, b, 1.0),
                                     track(shortTime, shortCells, 0.0, 20.0, c, 1.0)};
    const std::vector<Track> ofLong{track(longTime, longCells, 0.0, 180.0, a, 1.0),
                                    track(longTime, longCells, 0.0, 20.0, b, 4.0),
                                    track(longTime, longCells, 0.0, 20.0, c, 4.0)};
    QVERIFY(std::abs(kept(ofShort, ofLong) - 0.25) < 0.01);
}

void tst_energyKept::nothingToCompare()
{
    const auto line = [](double) { return 100.0; };
    const auto other = [](double) { return 200.0; };
    const std::vector<Track> one{track(shortTime, shortCells, 10.0, 90.0, line, 2.0)};
    QVERIFY(std::isnan(kept({}, {})));
    QVERIFY(
        std::isnan(kept(one, {track(longTime, longCells, 10.0, 90.0, other, 8.0)}))); // never seen by the longer window
    QVERIFY(std::isnan(kept(one, {track(longTime, longCells, 10.0, 90.0, line, 8.0)}, 51.0))); // not sure enough
}

FAINTLINE_TEST(tst_energyKept)
#include "tst_energyKept.moc"
