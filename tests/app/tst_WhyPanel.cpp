// The ladder under the cursor: its terms add up to what the picture shows, and its sentence says which way it went.

#include "app/features/inspect/WhyPanel.h"
#include "app/openWindow.h"
#include "support/find.h"
#include "support/test.h"
#include "widgets/plot/ChartPlot.h"
#include "widgets/table/ColumnTable.h"

#include <QPushButton>
#include <QUndoStack>

#include <memory>

using namespace faintline;
using namespace faintline::test;

static const ColumnTable &ladderOf(const WhyPanel &why)
{
    return childOf<ColumnTable>(why, "The best path, newest step first");
}

class tst_WhyPanel : public WindowTest
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        QVERIFY(open(R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 60, "lines": [
        {"snrDb": 6, "referenceSeconds": 0.5, "startSeconds": 20, "durationSeconds": 30, "frequencyHz": 120}]})"));
        QTest::keyClick(m_window.get(), Qt::Key_W);
        QVERIFY(m_window->panel<WhyPanel>().isVisible());
    }

    void termsAddUp_data()
    {
        QTest::addColumn<double>("seconds");
        QTest::addColumn<double>("hz");
        QTest::addColumn<QString>("begins");
        QTest::newRow("on the line") << 40.0 << 120.0 << "Followed by a track";
        QTest::newRow("beside it") << 40.0 << 300.0 << "Not detected";
        QTest::newRow("before it") << 10.0 << 120.0 << "Not detected";
    }

    void termsAddUp()
    {
        QFETCH(double, seconds);
        QFETCH(double, hz);
        QFETCH(QString, begins);
        askAt(seconds, hz);
        WhyPanel &why = m_window->panel<WhyPanel>();
        QVERIFY2(sentenceOf(why).startsWith(begins), qPrintable(sentenceOf(why)));
        const Explanation &explanation = *why.explanation();
        double sum = 0.0;
        for (const PathStep &step : explanation.steps)
            sum += step.logLikelihoodRatio + step.lnTransition + step.lnK;
        QVERIFY(std::abs(sum - explanation.displayed) < 1e-3 * std::max(1.0, std::abs(sum)));
        QCOMPARE(ladderOf(why).model()->rowCount(), int(explanation.steps.size()));
        QCOMPARE(cellOf(*ladderOf(why).model(), 0, 5).toDouble(),
                 std::round(100.0 * explanation.steps.back().score) / 100.0);
        QCOMPARE(why.plot().chart().curves.size(), std::size_t(2));
    }

    void noNumberIsCutShort()
    {
        askAt(40.0, 120.0);
        const ColumnTable &ladder = ladderOf(m_window->panel<WhyPanel>());
        QCoreApplication::processEvents();
        const QAbstractItemModel &steps = *ladder.model();
        QVERIFY(steps.rowCount() > 20);
        const QFontMetrics metrics(ladder.font());
        for (int row = 0; row < steps.rowCount(); ++row)
            for (int column = 0; column < steps.columnCount(); ++column)
                QVERIFY2(metrics.horizontalAdvance(steps.index(row, column).data().toString())
                             < ladder.columnWidth(column),
                         qPrintable(cellOf(steps, row, column)));
        QCOMPARE(ladder.textElideMode(), Qt::ElideNone);
    }

    void otherDetectorsSayThatTheyHaveNoPath()
    {
        QSignalSpy analysed(&m_window->document(), &Document::analysisChanged);
        m_window->controller().edit("detector.kind", std::string("pOfN"), "detector");
        QVERIFY(analysed.wait(patience));
        QVERIFY(settle(m_window->panel<WhyPanel>()));
        QVERIFY2(sentenceOf(m_window->panel<WhyPanel>()).contains("path"),
                 qPrintable(sentenceOf(m_window->panel<WhyPanel>())));
        QCOMPARE(ladderOf(m_window->panel<WhyPanel>()).model()->rowCount(), 0);
    }

    void theNextRecordingHasNoPathYet()
    {
        m_window->controller().setSettings(AnalysisSettings(), "Defaults");
        QVERIFY(settle(*m_window));
        askAt(40.0, 120.0);
        WhyPanel &why = m_window->panel<WhyPanel>();
        QVERIFY(why.explanation());
        QString sentence;
        int rows = -1;
        const auto connection = QObject::connect(&m_window->document(), &Document::opened, m_window.get(), [&] {
            sentence = sentenceOf(why);
            rows = ladderOf(why).model()->rowCount();
        });
        QVERIFY(
            openAndSettle(*m_window, writeFile(m_folder, "noise.json",
                                               R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 20})")));
        QObject::disconnect(connection);
        QVERIFY2(sentence.startsWith("Click a cell"), qPrintable(sentence));
        QCOMPARE(rows, 0);
    }

    void aCureIsAClickAway()
    {
        QVERIFY(openAndSettle(*m_window,
                              writeFile(m_folder, "fast.json",
                                        R"({"kind": "lines", "sampleRateHz": 400, "durationSeconds": 60, "lines": [
        {"snrDb": 14, "durationSeconds": 3.5, "frequencyHz": 20, "driftHzPerSecond": 48}]})")));
        m_window->controller().edit("spectrogram.windowSeconds", 0.5, "window");
        QVERIFY(settle(*m_window));
        askAt(1.5, 180.0);
        WhyPanel &why = m_window->panel<WhyPanel>();
        QVERIFY(why.remedy()->isHidden());
        askAt(1.5, 92.0);
        QVERIFY(why.remedy()->isVisible());
        QCOMPARE(why.remedy()->text(), QString("Use a window of 0.13 s"));
        why.remedy()->click();
        QVERIFY(settle(*m_window));
        QCOMPARE(m_window->document().settings().spectrogram.windowSeconds, 0.13);
        QCOMPARE(m_window->document().undoStack().undoText(), QString("Use a window of 0.13 s"));
        QVERIFY(!m_window->document().shownEvents().empty());
    }

private:
    void askAt(double seconds, double hz)
    {
        m_window->document().viewport().setCursor({seconds, hz});
        QVERIFY(settle(m_window->panel<WhyPanel>()));
    }
};

FAINTLINE_WINDOW_TEST(tst_WhyPanel)
#include "tst_WhyPanel.moc"
