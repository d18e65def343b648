#include "support/test.h"
#include "widgets/waterfall/waterfallWords.h"

#include "pictures.h"
#include "widgets/base/Theme.h"
#include "widgets/waterfall/WaterfallView.h"

using namespace faintline;

/// What is said of the cursor, of a measured box and of sidebands: numbers and units that are right for the axes.
class tst_waterfallWords : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }
    void init() { show(test::hzAxis(50), ByteScale::Kind::PowerDb); }
    void cleanup() { m_view.reset(); }

    void withoutACursorHowToGetOne()
    {
        QVERIFY(cursorText(*m_view).contains("Arrow keys"));
        QVERIFY(cursorText(WaterfallView("Input")).contains("Arrow keys")); // nor a viewport
    }

    void theCursorHasTimeFrequencyAndLevel()
    {
        m_viewport.setCursor({10.5, 140.0});
        QCOMPARE(cursorText(*m_view), QString("Cursor at 10.50 s, 140.0 Hz, 20.0 dB"));
        m_viewport.setCursor({12.5, 138.0});
        QCOMPARE(cursorText(*m_view), QString("Cursor at 12.50 s, 138.0 Hz, 0.0 dB"));
    }

    void besideThePictureTheCursorHasNoLevel()
    {
        m_viewport.setExtents({0.0, 1000.0}, {0.0, 1000.0});
        m_viewport.setCursor({700.0, 900.0});
        QCOMPARE(cursorText(*m_view), QString("Cursor at 0:11:40.00, 900.0 Hz"));
    }

    void theCursorIsHeard()
    {
        QVERIFY(!m_view->accessibleDescription().isEmpty());
        m_viewport.setCursor({10.5, 140.0});
        QCOMPARE(m_view->accessibleDescription(), cursorText(*m_view));
        m_viewport.clearCursor();
        QVERIFY(m_view->accessibleDescription().contains("Arrow keys"));
    }

    void ofPingsTheCursorHasRangeAndBearing()
    {
        const Axis bearings{"bearing", "°", 0.0, 7.2, 50, true};
        auto picture = std::make_shared<PeakPyramid>(Axis{"range", "m", 1000.0, 10.0, 2, false}, 50,
                                                     ByteScale(ByteScale::Kind::ScoreNats));
        picture->append(std::vector<float>(100, 3.0f));
        picture->finish();
        m_viewport.setExtents({995.0, 1015.0}, {-3.6, 356.4});
        m_view->setPicture(picture, bearings);
        m_viewport.setCursor({1010.0, 90.0});
        QCOMPARE(cursorText(*m_view), QString("Cursor at 1010.0 m, 90.0 °, 3.0 nat"));
    }

    void aBoxHasItsExtentsAndItsSlope()
    {
        const QStringList lines = boxText(*m_view, {{10.0, 20.0}, {120.0, 140.0}}).split('\n');
        QCOMPARE(lines.size(), 2);
        QCOMPARE(lines[0], QString("Δt 10.0 s · Δf 20.0 Hz · 2 Hz/s"));
    }

    void aBoxHasPeakAndMeanOfItsCells()
    {
        // Frames 10 … 13 and cells 19 … 21: eleven cells of 1 and one of 100, 9.25 in the mean.
        const QString text = boxText(*m_view, {{10.2, 13.8}, {138.5, 141.5}});
        QVERIFY2(text.endsWith("peak 20.0 dB · mean 9.7 dB"), qPrintable(text));
        const QString quiet = boxText(*m_view, {{15.2, 18.8}, {138.5, 141.5}});
        QVERIFY2(quiet.endsWith("peak 0.0 dB · mean 0.0 dB"), qPrintable(quiet));
    }

    void ofAStatisticThereIsNoMean()
    {
        show(test::hzAxis(50), ByteScale::Kind::ScoreNats);
        const QString text = boxText(*m_view, {{0.0, 5.0}, {100.0, 110.0}});
        QVERIFY2(text.endsWith("\npeak 1.0 nat"), qPrintable(text));
        m_view->setStatisticUnit("× noise", "Ratio");
        QVERIFY(boxText(*m_view, {{0.0, 5.0}, {100.0, 110.0}}).endsWith("\npeak 1.0 × noise"));
    }

    void aBoxOfNoWidthHasOneCell()
    {
        const QString text = boxText(*m_view, {{10.5, 10.5}, {140.0, 140.0}});
        QVERIFY2(text.contains("peak 20.0 dB"), qPrintable(text));
        QVERIFY2(text.startsWith(QString("Δt 0 s · Δf 0 Hz")), qPrintable(text));
    }

    void aBoxWithoutDurationHasNoSlope()
    {
        QVERIFY(!boxText(*m_view, {{10.5, 10.5}, {120.0, 140.0}}).contains("Hz/s"));
        QVERIFY(boxText(*m_view, {{10.0, 20.0}, {140.0, 140.0}}).contains("0 Hz/s"));
    }

    void aBoxReachesNoFurtherThanThePicture()
    {
        const QString text = boxText(*m_view, {{-1e6, 1e6}, {-1e9, 1e9}});
        QVERIFY2(text.contains("peak 20.0 dB"), qPrintable(text));
        QVERIFY2(text.contains("kHz") || text.contains("MHz"), qPrintable(text));
        m_view->setPicture(nullptr, {});
        QVERIFY(!boxText(*m_view, {{0.0, 5.0}, {100.0, 110.0}}).contains("peak"));
    }

    void ofPingsABoxHasItsAxesUnits()
    {
        auto picture = std::make_shared<PeakPyramid>(Axis{"range", "m", 1000.0, 10.0, 2, false}, 50,
                                                     ByteScale(ByteScale::Kind::ScoreNats));
        picture->append(std::vector<float>(100, 3.0f));
        picture->finish();
        m_view->setPicture(picture, {"bearing", "°", 0.0, 7.2, 50, true});
        const QStringList lines =
            boxText(*m_view, {{1000.0, 1010.0}, {90.0, 110.0}}).split(QRegularExpression(" · |\n"));
        QCOMPARE(lines[0], QString("Δ 10.0 m"));
        QCOMPARE(lines[1], QString("Δ 20.0 °"));
        QVERIFY(!lines[2].contains("/s")); // there is no time
    }

    void sidebandsHaveTheLevelsOfTheirLines()
    {
        // The carrier at 132 Hz, the one strong cell four bins above: the second line at a spacing of 4 Hz.
        const QStringList rows = sidebandText(*m_view, {132.0, 4.0}, 10.5).split('\n');
        QCOMPARE(rows.size(), 3 + Sidebands::orders);
        QVERIFY2(rows[0].startsWith("carrier 132 Hz") && rows[0].endsWith("0.0 dB"), qPrintable(rows[0]));
        QVERIFY2(rows[1].startsWith("spacing 4.0 Hz"), qPrintable(rows[1]));
        QCOMPARE(rows[4].simplified(), QString("2 0.0 20.0"));
        QCOMPARE(rows[3].simplified(), QString("1 0.0 0.0"));
        for (int order = 2; order <= Sidebands::orders; ++order) // columns stand below each other
            QCOMPARE(rows[2 + order].size(), rows[3].size());
    }

    void sidebandsBesideThePictureHaveNone()
    {
        const QStringList rows = sidebandText(*m_view, {102.0, 8.0}, 10.5).split('\n');
        QCOMPARE(rows[3].simplified(), QString("1 – 0.0"));
        QCOMPARE(sidebandText(*m_view, {132.0, 4.0}, 99.0).count(QStringLiteral("–")), 2 * Sidebands::orders + 1);
    }

private:
    /// 40 frames of 1 s and 50 cells: 1 in all of them but for 100 (20 dB) in frame 10, cell 20.
    void show(const Axis &across, ByteScale::Kind kind)
    {
        const auto picture = test::picture(
            40, 50, [](Index f, Index c) { return f == 10 && c == 20 ? 100.0f : 1.0f; }, kind);
        const Viewport::Box full = WaterfallView::extents(picture->time(), across);
        m_viewport.setExtents(full.time, full.frequency);
        m_view = std::make_unique<WaterfallView>("Input");
        m_view->setViewport(&m_viewport);
        m_view->setPicture(picture, across);
    }

    Viewport m_viewport;
    std::unique_ptr<WaterfallView> m_view;
};

FAINTLINE_WINDOW_TEST(tst_waterfallWords)
#include "tst_waterfallWords.moc"
