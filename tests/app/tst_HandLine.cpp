// A line drawn by hand: points by mouse and by key, its evidence beside the detector's, and nothing given away before
// it is revealed.

#include "app/features/events/HandLinePanel.h"
#include "app/features/pictures/Workbench.h"
#include "app/openWindow.h"
#include "support/find.h"
#include "support/test.h"
#include "widgets/base/quantities.h"
#include "widgets/plot/StripPlot.h"
#include "widgets/table/ColumnTable.h"
#include "widgets/waterfall/HandLine.h"

#include <QPushButton>

#include <memory>

using namespace faintline;
using namespace faintline::test;

class tst_HandLine : public WindowTest
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        QVERIFY(open(R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 60, "lines": [
        {"snrDb": 9, "referenceSeconds": 0.5, "startSeconds": 5, "durationSeconds": 50, "frequencyHz": 120,
        "driftHzPerSecond": 2}]})"));
        QVERIFY(!m_window->document().analysis()->tracks.empty());
        QTest::keyClick(m_window.get(), Qt::Key_D, Qt::ControlModifier);
        QVERIFY(panel().isVisible());
    }

    void init()
    {
        panel().line().clear();
        buttonOf(panel(), "Draw")->setChecked(true);
    }

    void pointsAreMadeMovedAndTakenAway()
    {
        QWidget *canvas = input().canvas();
        HandLine &line = panel().line();
        QTest::mouseClick(canvas, Qt::LeftButton, {}, at(40.0, 300.0));
        QTest::mouseClick(canvas, Qt::LeftButton, {}, at(10.0, 200.0));
        QCOMPARE(line.points().size(), std::size_t(2));
        QVERIFY(line.points()[0].seconds < line.points()[1].seconds); // in order of time, however they were made
        QVERIFY(std::abs(line.points()[0].hz - 200.0) < 5.0);
        QTRY_VERIFY_WITH_TIMEOUT(isSettled(), patience);
        const QString before = evidence();

        // A point is dragged past the other one: the order stays that of time.
        QTest::mousePress(canvas, Qt::LeftButton, {}, at(10.0, 200.0));
        QTest::mouseMove(canvas, at(50.0, 400.0));
        QTest::mouseRelease(canvas, Qt::LeftButton, {}, at(50.0, 400.0));
        QCOMPARE(line.points().size(), std::size_t(2));
        QVERIFY(std::abs(line.points()[1].seconds - 50.0) < 1.0 && std::abs(line.points()[1].hz - 400.0) < 5.0);
        QTRY_VERIFY_WITH_TIMEOUT(isSettled() && evidence() != before, patience);

        QTest::mouseClick(canvas, Qt::RightButton, {}, at(50.0, 400.0));
        QCOMPARE(line.points().size(), std::size_t(1));

        // The keyboard's way.
        m_window->document().viewport().setCursor({20.0, 150.0});
        buttonOf(panel(), "Point at cursor")->setFocus();
        QTest::keyClick(buttonOf(panel(), "Point at cursor"), Qt::Key_Space);
        QCOMPARE(line.points().size(), std::size_t(2));
        QCOMPARE(line.points()[0], (Viewport::Point{20.0, 150.0}));
        buttonOf(panel(), "Clear")->setFocus();
        QTest::keyClick(buttonOf(panel(), "Clear"), Qt::Key_Space);
        QVERIFY(line.points().empty() && rows().rowCount() == 0);
    }

    void withoutDrawingTheCursorIsPlaced()
    {
        buttonOf(panel(), "Draw")->setChecked(false);
        QTest::mouseClick(input().canvas(), Qt::LeftButton, {}, at(30.0, 400.0));
        QVERIFY(panel().line().points().empty());
        QVERIFY(std::abs(m_window->document().viewport().cursor()->hz - 400.0) < 5.0);
    }

    void theDetectorsPathDrawnByHandHasItsEvidence()
    {
        const Analysis &analysis = *m_window->document().analysis();
        const Track &track = analysis.tracks.front();
        std::vector<Viewport::Point> points;
        for (const TrackPoint &point : track.points)
            points.push_back(
                {analysis.time().value(double(point.frame)), analysis.grid().axes.back().value(double(point.cell))});
        panel().line().setPoints(points);
        QTRY_VERIFY_WITH_TIMEOUT(isSettled(), patience);
        const HandLinePanel::Comparison comparison = this->comparison();
        QCOMPARE(comparison.track, track.id);
        QCOMPARE(comparison.frames, Index(std::ssize(track.points)));
        QCOMPARE(comparison.ownThere, comparison.detector);
        QCOMPARE(comparison.own, comparison.detector);
        QCOMPARE(comparison.meanHz, 0.0);
        QCOMPARE(evidence(), numberText(comparison.own.logLikelihoodRatio, 1).replace(QChar(0x2212), '-'));
        for (int column = 1; column <= 3; ++column)
            QVERIFY(cellOf(rows(), 1, column) == cellOf(rows(), 2, column) && !cellOf(rows(), 2, column).isEmpty());
        // 9 dB in half a second, the window; Hann loses a third of that.
        QVERIFY(comparison.detector.snr() > 3.0 && comparison.detector.snr() < 10.0);
    }

    void besideTheLineThereIsNothing()
    {
        panel().line().setPoints({{10.0, 400.0}, {50.0, 400.0}});
        QTRY_VERIFY_WITH_TIMEOUT(isSettled(), patience);
        const HandLinePanel::Comparison comparison = this->comparison();
        // Noise: mean 1 within five standard errors, and evidence against a signal.
        const double error = 5.0 * std::sqrt(2.0 / double(comparison.own.frames)); // frames overlap by half
        QVERIFY(std::abs(comparison.own.meanPower - 1.0) < error);
        QVERIFY(comparison.own.logLikelihoodRatio < 0.0);
        QVERIFY(comparison.detector.logLikelihoodRatio > 50.0);
        QVERIFY(sentenceOf(panel()).contains("behind"));
    }

    void coveredNothingIsGivenAway()
    {
        QTest::mouseClick(buttonOf(panel(), "Cover the statistic"), Qt::LeftButton);
        for (const auto layer : {PictureDisplay::EventLayer, PictureDisplay::TrackLayer, PictureDisplay::TruthLayer})
            QVERIFY(!input().display().shows(layer));
        QWidget *pane = m_window->workbench().outputView();
        QVERIFY(pane->childAt(pane->rect().center()) != m_window->workbench().output()->canvas());
        panel().line().setPoints({{10.0, 130.0}, {50.0, 210.0}});
        QTRY_VERIFY_WITH_TIMEOUT(isSettled(), patience);
        QVERIFY(!sentenceOf(panel()).contains("track"));

        QTest::mouseClick(buttonOf(panel(), "Reveal the statistic"), Qt::LeftButton);
        QVERIFY(input().display().shows(PictureDisplay::TruthLayer));
        QVERIFY(sentenceOf(panel()).contains("track"));
        QVERIFY(comparison().meanHz < 5.0);
    }

private:
    QPoint at(double seconds, double hz) const { return input().positionOf({seconds, hz}).toPoint(); }
    HandLinePanel &panel() const { return m_window->panel<HandLinePanel>(); }
    bool isSettled() const { return !isBusy(panel()) && rows().rowCount() == 3; }
    const QAbstractItemModel &rows() const { return *childOf<ColumnTable>(panel()).model(); }
    QString evidence() const { return cellOf(rows(), 0, 2); } ///< of the own line
    /// What the panel's table and sentence tell of.
    HandLinePanel::Comparison comparison() const
    {
        std::vector<PolylinePoint> line;
        for (const Viewport::Point &point : panel().line().points())
            line.push_back({point.seconds, point.hz});
        return HandLinePanel::compare(m_window->document().analysis(), line);
    }
};

FAINTLINE_WINDOW_TEST(tst_HandLine)
#include "tst_HandLine.moc"
