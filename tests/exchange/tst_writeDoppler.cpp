#include "exchange/writeDoppler.h"
#include "support/test.h"

#include "base/json.h"

#include <array>
#include <cmath>
#include <limits>

using namespace faintline;

namespace {

/// A pass that was heard at four times; the third point was left out.
DopplerReport report()
{
    DopplerReport made;
    made.events.resize(2);
    made.events[0].id = 3;
    made.events[1].id = 5;
    made.centreHz = 1000.0;
    made.fit.propagation = 343.0;
    made.fit.pass = {500.0, 34.3, 100.0, 12.0};
    made.fit.restHz = {499.5, 500.5};
    made.fit.metresPerSecond = {30.0, std::nullopt};
    made.fit.residualHz = {0.5, -0.25, 4.0, 0.0};
    made.fit.isLeftOut = {0, 0, 1, 0};
    made.fit.rmsHz = 0.75;
    made.fit.sentences = {"One sensor does not tell the side."};
    for (int i = 0; i < 4; ++i)
        made.track.points.push_back({10.0 + i, 520.0 - 10.0 * i, 0.5});
    return made;
}

} // namespace

/// A Doppler fit in words, numbers and curves.
class tst_writeDoppler : public QObject
{
    Q_OBJECT

private slots:
    void boundsHaveTwoDigitsOfTheirWidth_data()
    {
        QTest::addColumn<double>("low");
        QTest::addColumn<double>("high");
        QTest::addColumn<QString>("words");
        constexpr double unbounded = std::numeric_limits<double>::infinity();
        QTest::newRow("a width of ones") << 12.3456 << 14.0 << "12.3 … 14.0";
        QTest::newRow("a width of hundredths") << 499.98765 << 500.00432 << "499.988 … 500.004";
        QTest::newRow("a width of tens") << -17.4 << 22.6 << "-17 … 23";
        QTest::newRow("a width of thousands") << 1234.5 << 8765.4 << "1234 … 8765";
        QTest::newRow("no width") << 5.0 << 5.0 << "5 … 5";
        QTest::newRow("open above") << 12.3456 << unbounded << "above 12.35";
        QTest::newRow("open below") << -unbounded << 14.0 << "below 14";
        QTest::newRow("open") << -unbounded << unbounded << "open";
    }

    void boundsHaveTwoDigitsOfTheirWidth()
    {
        QFETCH(double, low);
        QFETCH(double, high);
        QFETCH(QString, words);
        DopplerBounds bounds;
        if (std::isfinite(low))
            bounds.low = low;
        if (std::isfinite(high))
            bounds.high = high;
        QCOMPARE(QString::fromStdString(boundsText(bounds)), words);
    }

    void valuesHaveTheDigitsOfTheirBounds()
    {
        QCOMPARE(valueText(13.14159, {12.3, 14.0}), std::string("13.1"));
        QCOMPARE(valueText(499.99876, {499.98, 500.0}), std::string("499.999"));
        QCOMPARE(valueText(13.14159, {12.3, std::nullopt}), std::string("13.14"));
        QCOMPARE(valueText(1e20, {0.0, 1.0}), std::string("1e+20"));
    }

    void rowsAreInOrder()
    {
        const std::vector<DopplerRow> rows = dopplerRows(report().fit);
        QCOMPARE(rows.size(), std::size_t(4));
        const std::array<const char *, 4> names{"rest frequency", "speed", "closest range", "closest approach"};
        const std::array<const char *, 4> units{"Hz", "m/s", "m", "s"};
        const std::array<double, 4> values{500.0, 34.3, 100.0, 12.0};
        for (std::size_t i = 0; i < 4; ++i) {
            QCOMPARE(rows[i].name, std::string(names[i]));
            QCOMPARE(rows[i].unit, std::string(units[i]));
            QCOMPARE(rows[i].value, values[i]);
        }
        QVERIFY(rows[0].bounds.isBounded() && !rows[1].bounds.isBounded() && rows[1].bounds.low);
    }

    void tableOfPoints()
    {
        QCOMPARE(dopplerCsv(report()), std::string("t,f,deviation,fitted,residual,left_out\n"
                                                   "10,520,0.5,519.5,0.5,0\n"
                                                   "11,510,0.5,510.25,-0.25,0\n"
                                                   "12,500,0.5,496,4,1\n"
                                                   "13,490,0.5,490,0,0\n"));
    }

    void jsonHoldsAll()
    {
        const Json json = parseJson(dopplerJson(report()), "report");
        QVERIFY(json["events"] == Json::array({3, 5}));
        QVERIFY(json["rest_frequency"] == Json({{"unit", "Hz"}, {"estimate", 500.0}, {"low", 499.5}, {"high", 500.5}}));
        QVERIFY(json["speed"]["low"] == 30.0 && json["speed"]["high"].is_null());
        QVERIFY(json["closest_range"]["low"].is_null());
        QCOMPARE(json["centre_hz"].get<double>(), 1000.0);
        QCOMPARE(json["heard_s"].get<double>(), 12.0 + 100.0 / 343.0);
        QCOMPARE(json["slope_hz_per_s"].get<double>(), -500.0 * 34.3 * 34.3 / (343.0 * 100.0));
        QCOMPARE(json["points"].size(), std::size_t(4));
        QVERIFY(json["points"][2]["left_out"] == true && json["points"][1]["left_out"] == false);
        QCOMPARE(json["points"][1]["fitted"].get<double>(), 510.25);
        QVERIFY(json["notes"] == Json::array({"One sensor does not tell the side."}));
    }

    void notesBeginWithWhatWasLeftOut()
    {
        DopplerReport made = report();
        QCOMPARE(eventNumbers(made), std::string("3, 5"));
        made.events.pop_back();
        QCOMPARE(eventNumbers(made), std::string("3"));
        made.track.steepCount = 7;
        made.track.steepestHzPerSecond = 2.5;
        const std::vector<std::string> notes = dopplerNotes(made);
        QCOMPARE(notes.size(), std::size_t(2));
        QVERIFY2(notes[0].starts_with("Points left out where the path is as steep as the model allows: 7; it falls at "
                                      "most by 2.5 Hz/s"),
                 notes[0].c_str());
    }

    // The fitted curve is the pass's frequency by bisection for the time it was sent at.
    void chartsOfPointsAndFit()
    {
        const DopplerReport made = report();
        const std::vector<Chart> charts = dopplerCharts(made);
        QCOMPARE(charts.size(), std::size_t(2));
        QCOMPARE(charts[0].title, std::string("Doppler fit, events 3, 5"));
        QCOMPARE(charts[0].curves.size(), std::size_t(3));
        QCOMPARE(charts[0].curves[0].points.size(), std::size_t(3));
        QCOMPARE(charts[0].curves[1].name, std::string("left out"));
        QCOMPARE(charts[0].curves[1].points[0].y, 500.0);
        const Interval bar = charts[0].curves[0].points[0].interval;
        QVERIFY(std::abs(bar.high - bar.low - 2.0 * 1.645 * 0.5) < 1e-12);
        const auto distance = [](double sent) { return std::hypot(100.0, 34.3 * (sent - 12.0)); };
        const auto sentAt = [&](double heard) {
            double low = heard - 10.0;
            double high = heard;
            for (int i = 0; i < 200; ++i) {
                const double middle = 0.5 * (low + high);
                (middle + distance(middle) / 343.0 < heard ? low : high) = middle;
            }
            return low;
        };
        const std::vector<Curve::Point> &fitted = charts[0].curves[2].points;
        QCOMPARE(fitted.front().x, 10.0);
        QCOMPARE(fitted.back().x, 13.0);
        for (const Curve::Point &point : fitted) {
            constexpr double step = 1e-4;
            const double expected = 500.0 * (sentAt(point.x + step) - sentAt(point.x - step)) / (2.0 * step);
            QVERIFY(std::abs(point.y - expected) < 1e-4);
        }
        QCOMPARE(charts[1].curves[0].points[1].y, -0.25);
        QCOMPARE(charts[1].curves[1].points[0].y, 4.0);
        QCOMPARE(charts[1].curves[2].points[0].y, 0.0);
        DopplerReport allTookPart = made;
        allTookPart.fit.isLeftOut = {0, 0, 0, 0};
        QCOMPARE(dopplerCharts(allTookPart)[0].curves.size(), std::size_t(2));
    }
};

FAINTLINE_TEST(tst_writeDoppler)
#include "tst_writeDoppler.moc"
