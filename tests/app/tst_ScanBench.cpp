// A radar's scans on four axes in the window: two axes shown, the others by maximum or slice.

#include "app/document/OutputLayers.h"
#include "app/features/pictures/AxesBar.h"
#include "app/features/pictures/PingBench.h"
#include "app/features/pictures/ShownAxes.h"
#include "app/features/pictures/Workbench.h"
#include "app/openWindow.h"
#include "app/ping.h"
#include "exchange/Session.h"
#include "frames/pictureCuts.h"
#include "inspect/outputLayers.h"
#include "support/errors.h"
#include "support/find.h"
#include "support/test.h"
#include "widgets/pings/PingMap.h"
#include "widgets/waterfall/LayerItem.h"

#include <qwt_plot_canvas.h>
#include <qwt_text.h>

#include <QComboBox>
#include <QSpinBox>

#include <algorithm>

using namespace faintline;
using namespace faintline::test;

namespace {

const char *const scene = R"({"kind": "pings", "pings": 20, "priSeconds": 2, "rangeCells": 24, "firstRangeMetres": 5000,
    "rangeStepMetres": 150, "beams": 8, "firstBearingDegrees": -12, "beamStepDegrees": 3, "elevationCells": 4,
    "elevationStepDegrees": 3, "dopplerCells": 6, "firstDopplerMetresPerSecond": -50, "dopplerStepMetresPerSecond": 20,
    "seed": 5, "targets": [{"snrDb": 11, "rangeMetres": 6500, "bearingDegrees": -3, "elevationDegrees": 6,
    "appearPing": 2, "legs": [{"rangeRateMetresPerSecond": 50}]}, {"snrDb": 11, "rangeMetres": 7700,
    "bearingDegrees": 6, "elevationDegrees": 3, "appearPing": 2, "legs": [{"rangeRateMetresPerSecond": -30}]}]})";

} // namespace

class tst_ScanBench : public WindowTest
{
    Q_OBJECT

    PingBench &bench() const { return m_window->pingBench(); }
    const Analysis &analysis() const { return *m_window->document().analysis(); }
    AxesBar &bar() const { return *bench().findChild<AxesBar *>(); }

    /// What the map must show, by loops over all cells of the scan.
    std::vector<std::uint8_t> expectedMap(std::size_t along, std::size_t across,
                                          const std::vector<std::optional<Index>> &cuts = {}) const
    {
        const Grid &grid = analysis().grid();
        const auto row = analysis().statistic->row(0, pingShown(*m_window));
        std::vector<std::uint8_t> map(std::size_t(grid.axes[along].count * grid.axes[across].count), 0);
        for (Index cell = 0; cell < grid.size(); ++cell) {
            const std::vector<Index> at = grid.coordinates(cell);
            bool isIn = true;
            for (std::size_t axis = 0; axis < cuts.size(); ++axis)
                isIn = isIn && (!cuts[axis] || *cuts[axis] == at[axis]);
            std::uint8_t &value = map[std::size_t(at[along] * grid.axes[across].count + at[across])];
            if (isIn)
                value = std::max(value, row[std::size_t(cell)]);
        }
        return map;
    }
    std::vector<std::uint8_t> shownMap() const
    {
        const PeakPyramid &picture = *bench().output()->plane()->picture();
        std::vector<std::uint8_t> map;
        for (Index row = 0; row < picture.rowCount(0); ++row) {
            const auto values = picture.row(0, row);
            map.insert(map.end(), values.begin(), values.end());
        }
        return map;
    }

private slots:
    void initTestCase() { writeFile(m_folder, "scans.json", scene); }

    void init()
    {
        m_window = newWindow({1400, 900});
        QVERIFY(openAndSettle(*m_window, path("scans.json")));
    }

    void opensWithItsOwnSettings()
    {
        QVERIFY(m_window->document().isCurrent());
        QCOMPARE(m_window->document().settings(), preset("radar").settings);
        QCOMPARE(analysis().grid().axes.size(), std::size_t(4));
        QVERIFY(analysis().tracks.size() >= 2);
        QVERIFY(bench().isVisible() && bar().isVisible());
        QCOMPARE(bar().pairs()->count(), 6);
        QCOMPARE(bar().pairs()->itemText(2), QString::fromUtf8("range × Doppler"));
        QVERIFY2(readingOf(bench()).startsWith("scan "), qPrintable(readingOf(bench())));
        QVERIFY2(readingOf(bench()).contains("(elevation "), qPrintable(readingOf(bench())));
        QVERIFY(shownMap() == expectedMap(0, 1));
        QVERIFY(bench().alongHistory()->picture() == analysis().statisticAlong[0]);
    }

    void everyPairOfAxesIsShown()
    {
        const std::vector<AxesBar::Pair> pairs = pairsOfAxes(analysis().grid());
        for (int i = 0; i < int(pairs.size()); ++i) {
            bar().pairs()->setCurrentIndex(i);
            emit bar().pairs()->activated(i);
            const auto [along, across] = pairs[std::size_t(i)];
            QVERIFY(shownMap() == expectedMap(along, across));
            QVERIFY(bench().alongHistory()->picture() == analysis().statisticAlong[along]);
            QVERIFY(bench().acrossHistory()->picture() == analysis().statisticAlong[across]);
            QCOMPARE(bench().viewports().map().time().low, analysis().grid().axes[along].value(-0.5));
            QCOMPARE(bar().pairs()->currentIndex(), i);
            QVERIFY(bench().alongHistory()->title().text().contains(
                QString::fromStdString(analysis().grid().axes[along].name)));
        }
    }

    /// The cursor stays on the signal whatever is shown, and so do its marks.
    void theCursorIsOnAllAxes()
    {
        const Event event = m_window->document().shownEvents().front();
        bench().selectEvent(event.id);
        bench().axes().set(0, 3);
        QCOMPARE(bench().viewports().place().position, event.position);
        QCOMPARE(*bench().viewports().map().cursor(), (Viewport::Point{event.position[0], event.position[3]}));
        const auto place = cursorOf(m_window->document(), bench().viewports());
        QCOMPARE(place->position, event.position);
        QCOMPARE(bench().output()->trackAt({event.position[0], event.position[3]}), event.id);
    }

    /// A click where maxima are shown goes to the strongest cell behind the place.
    void aClickFindsTheCellBehind()
    {
        bench().axes().set(1, 2);
        const Event event = m_window->document().shownEvents().front();
        bench().showPing(analysis().time().nearest(event.detectSeconds));
        WaterfallView &plane = *bench().output()->plane();
        const QPointF at = plane.positionOf({event.position[1], event.position[2]});
        QTest::mouseClick(plane.canvas(), Qt::LeftButton, {}, at.toPoint());
        const std::vector<double> &position = bench().viewports().place().position;
        QCOMPARE(analysis().grid().axes[0].nearest(position[0]), analysis().grid().axes[0].nearest(event.position[0]));
        QCOMPARE(analysis().grid().axes[3].nearest(position[3]), analysis().grid().axes[3].nearest(event.position[3]));
    }

    void hiddenAxesAreCutAtTheCursor()
    {
        const Event event = m_window->document().shownEvents().front();
        bench().selectEvent(event.id);
        const auto boxes = [&] { return bar().findChildren<QSpinBox *>(); };
        QVERIFY(std::ranges::none_of(boxes(), &QWidget::isVisible));
        bar().others()->setCurrentIndex(1);
        emit bar().others()->activated(1);
        QVERIFY(bench().axes().isSliced());
        const std::vector<Axis> &axes = analysis().grid().axes;
        const Index elevation = axes[2].nearest(event.position[2]);
        const Index doppler = axes[3].nearest(event.position[3]);
        QVERIFY(shownMap() == expectedMap(0, 1, {{}, {}, elevation, doppler}));
        QVERIFY(boxes()[2]->isVisible() && boxes()[3]->isVisible() && !boxes()[0]->isVisible());
        QCOMPARE(boxes()[2]->text(), QString::fromUtf8("%1°").arg(axes[2].value(double(elevation))));
        // Stepping the slice moves the cursor; far from the track there is no mark of it.
        const Index other = elevation == 0 ? 3 : 0;
        boxes()[2]->setValue(int(other));
        QCOMPARE(bench().viewports().place().position[2], axes[2].value(double(other)));
        QVERIFY(shownMap() == expectedMap(0, 1, {{}, {}, other, doppler}));
        QVERIFY2(readingOf(bench()).contains(QString::fromUtf8("(elevation %1°").arg(axes[2].value(double(other)))),
                 qPrintable(readingOf(bench())));
        // A click within the slice stays in it.
        WaterfallView &plane = *bench().output()->plane();
        QTest::mouseClick(plane.canvas(), Qt::LeftButton, {}, plane.canvas()->rect().center());
        QCOMPARE(bench().viewports().place().position[2], axes[2].value(double(other)));
        bench().axes().setSliced(false);
        QVERIFY(shownMap() == expectedMap(0, 1));
    }

    void layersAreOfTheAxesShown()
    {
        const Event event = m_window->document().shownEvents().front();
        bench().selectEvent(event.id);
        bench().axes().set(3, 2);
        OutputLayers &layers = m_window->workbench().layers();
        layers.setLayer(OutputLayer::Rate);
        QVERIFY(settle(layers));
        QVERIFY2(bench().output()->plane()->title().text().contains("elevation rate"),
                 qPrintable(bench().output()->plane()->title().text())); // along: the first of the pair
        const auto picture = itemOf<LayerItem>(*bench().output()->plane()).picture();
        QVERIFY(picture);
        QCOMPARE(picture->rows, Index(4));
        QCOMPARE(picture->columns, Index(6));
        const auto shared = m_window->document().analysis();
        LayerReplay replay(shared);
        const CellLayers &exact = replay.at(pingShown(*m_window));
        const CellsBehind cells(analysis().grid(), bench().viewports().plane());
        for (Index row = 0; row < cells.rows(); ++row)
            for (Index column = 0; column < cells.columns(); ++column) {
                const CellReading expected = readCell(analysis(), exact, cells.largest(exact.statistic, row, column),
                                                      bench().viewports().plane());
                const CellReading there = readPixel(*picture, picture->pixelAt(row, column));
                QVERIFY(std::abs(there.statistic - expected.statistic) < 1e-6);
                QVERIFY(std::abs(there.ratePerSecond - expected.ratePerSecond) < 1e-5);
                QVERIFY(std::abs(there.secondRatePerSecond - expected.secondRatePerSecond) < 1e-5);
            }
        layers.setLayer(OutputLayer::Statistic);
    }

    void aSessionKeepsTheAxes()
    {
        const Event event = m_window->document().shownEvents().front();
        bench().selectEvent(event.id);
        bench().axes().set(0, 3);
        bench().axes().setSliced(true);
        Session session;
        session.source = m_window->document().source();
        session.settings = m_window->document().settings();
        session.view = toJson(bench().viewState());
        writeSession(pathBytes(path("s.faintline")), session);
        bench().axes().setSliced(false);
        bench().axes().set(0, 1);
        QVERIFY(openAndSettle(*m_window, path("s.faintline")));
        QCOMPARE(bench().viewports().plane().along, std::size_t(0));
        QCOMPARE(bench().viewports().plane().across, std::size_t(3));
        QVERIFY(bench().axes().isSliced());
        QCOMPARE(bench().viewports().place().position, event.position);
        // Another source begins on its first two axes, by maximum.
        QVERIFY(openAndSettle(*m_window, path("scans.json")));
        QCOMPARE(bench().viewports().plane(), FramePlane());
        QVERIFY(!bench().axes().isSliced());
    }

    void axesByName()
    {
        bench().axes().set({"Doppler", "range"});
        QVERIFY(shownMap() == expectedMap(0, 3)); // in the order of the list of pairs
        const auto refusal = [&](std::vector<std::string> names) {
            return QString::fromStdString(errorOf([&] { bench().axes().set(names); }));
        };
        QVERIFY2(refusal({"range", "azimuth"}).contains("must be one of range, bearing, elevation, Doppler"),
                 qPrintable(refusal({"range", "azimuth"})));
        QVERIFY(refusal({"range", "range"}).contains("two different axes"));
        bench().setPolar(true); // a Doppler axis has no directions
        QVERIFY(!bench().output()->isPolar());
        QTest::keyClick(bench().output()->plane(), Qt::Key_P);
        QVERIFY(!bench().output()->isPolar() && !bench().input()->isPolar());
    }

    /// Two axes after four, and spectra after that.
    void otherSourcesAfterwards()
    {
        bench().axes().set(2, 3);
        bench().axes().setSliced(true);
        writeFile(m_folder, "flat.json",
                  R"({"kind": "pings", "pings": 8, "rangeCells": 60, "beams": 8, "targets": []})");
        QVERIFY(openAndSettle(*m_window, path("flat.json"), [](AnalysisSettings &settings) {
            settings = preset("radar").settings; // few states
        }));
        QVERIFY(!bar().isVisible());
        QVERIFY(readingOf(bench()).startsWith("ping "));
        QVERIFY(!readingOf(bench()).contains("("));
        QCOMPARE(bench().viewports().plane(), FramePlane());
        writeFile(m_folder, "line.json",
                  R"({"kind": "lines", "sampleRateHz": 500, "durationSeconds": 10, "lines": []})");
        QVERIFY(openAndSettle(*m_window, path("line.json")));
        QVERIFY(!bench().isVisible());
        QVERIFY(openAndSettle(*m_window, path("scans.json")));
        QVERIFY(bar().isVisible());
    }
};

FAINTLINE_WINDOW_TEST(tst_ScanBench)
#include "tst_ScanBench.moc"
