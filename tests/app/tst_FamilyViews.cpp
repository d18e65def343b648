#include "app/features/inspect/SpectrumPanel.h"
#include "app/features/inspect/WhyPanel.h"
#include "app/features/pictures/Workbench.h"
#include "app/openWindow.h"
#include "support/find.h"
#include "support/test.h"
#include "widgets/base/ReadOut.h"
#include "widgets/plot/ChartPlot.h"
#include "widgets/table/ColumnTable.h"
#include "widgets/waterfall/OverlayItem.h"
#include "widgets/waterfall/WaterfallView.h"

#include <qwt_text.h>

#include <QLabel>

#include <algorithm>
#include <cmath>

using namespace faintline;
using namespace faintline::test;

/// A family of lines in the window: its teeth at the cursor, in the spectrum, and one by one in *Why*. The third of
/// five multiples is missing.
static QString noteOf(const WaterfallView &view)
{
    return itemOf<OverlayItem>(view).cursorNote;
}

class tst_FamilyViews : public WindowTest
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        QVERIFY(open(R"({"kind": "lines", "sampleRateHz": 800, "durationSeconds": 40, "lines": [
        {"snrDb": 8, "referenceSeconds": 1, "frequencyHz": 57.3},
        {"snrDb": 8, "referenceSeconds": 1, "frequencyHz": 114.6},
        {"snrDb": 8, "referenceSeconds": 1, "frequencyHz": 229.2},
        {"snrDb": 8, "referenceSeconds": 1, "frequencyHz": 286.5}]})",
                     [](AnalysisSettings &settings) {
                         settings.spectrogram.windowSeconds = 1.0;
                         settings.family = {FamilySettings::Relation::Harmonics, {1.0, 2.0, 3.0, 4.0, 5.0}};
                     }));
        QCOMPARE(m_window->document().shownEvents().size(), std::size_t(1));
        QVERIFY(std::abs(m_window->document().viewport().cursor().value().hz - fundamental) < 0.3);
    }

    void theAxisIsTheFundamentals()
    {
        const WaterfallView &input = *m_window->workbench().input();
        QVERIFY2(input.axisTitle(input.hzAxis()).text().startsWith("Fundamental"),
                 qPrintable(input.axisTitle(input.hzAxis()).text()));
        const auto labels = m_window->readOut().findChildren<QLabel *>();
        QVERIFY(std::any_of(labels.begin(), labels.end(),
                            [](const QLabel *label) { return label->text() == "Fundamental"; }));
    }

    void theInputTellsTheMembersAtTheCursor()
    {
        Viewport &viewport = m_window->document().viewport();
        WaterfallView &input = *m_window->workbench().input();
        viewport.setCursor({20.0, 50.0});
        const QStringList lines = noteOf(input).split('\n');
        QCOMPARE(lines.size(), qsizetype(5));
        for (int k = 1; k <= 5; ++k) {
            QVERIFY2(lines[k - 1].startsWith(QStringLiteral("%1×").arg(k)), qPrintable(lines[k - 1]));
            QVERIFY2(lines[k - 1].contains(QString::number(50 * k)), qPrintable(lines[k - 1]));
        }
        input.setFocus();
        QTest::keyClick(&input, Qt::Key_Right); // one cell
        QVERIFY(noteOf(input) != lines.join('\n'));
        QCOMPARE(noteOf(*m_window->workbench().output()), QString());
    }

    void theSpectrumIsTheRecordingsWithTheTeethMarked()
    {
        Viewport &viewport = m_window->document().viewport();
        SpectrumPanel &panel = m_window->panel<SpectrumPanel>();
        viewport.setCursor({20.0, fundamental});
        QTest::keyClick(m_window.get(), Qt::Key_S, Qt::ShiftModifier);
        QVERIFY(settle(panel));
        const std::vector<ChartMark> &marks = panel.plot().marks();
        QCOMPARE(marks.size(), std::size_t(5));
        const std::vector<Curve::Point> &mean = panel.plot().chart().curves[1].points;
        QVERIFY(mean.back().x > viewport.full().frequency.high); // all that the members reach
        for (std::size_t k = 0; k < marks.size(); ++k) {
            QCOMPARE(marks[k].name, QStringLiteral("%1×").arg(k + 1));
            QVERIFY(std::abs(marks[k].x - double(k + 1) * fundamental) < 1e-9);
            const auto tooth = std::min_element(mean.begin(), mean.end(), [&](const auto &a, const auto &b) {
                return std::abs(a.x - marks[k].x) < std::abs(b.x - marks[k].x);
            });
            QVERIFY2(k == 2 ? tooth->y < 3.0 : tooth->y > 4.0, qPrintable(QString::number(tooth->y)));
        }
        viewport.zoomTo({10.0, 30.0}, {55.0, 60.0});
        QVERIFY(settle(panel));
        QVERIFY(panel.plot().chart().curves[0].points.front().x < 56.0);
        QVERIFY(panel.plot().chart().curves[0].points.back().x > 299.0);
        viewport.showAll();
        viewport.setCursor({20.0, 40.0});
        QVERIFY(settle(panel));
        QCOMPARE(panel.plot().marks().back().x, 200.0);
    }

    void whyTellsWhatEachMemberBrought()
    {
        WhyPanel &why = m_window->panel<WhyPanel>();
        m_window->document().viewport().setCursor({30.0, fundamental});
        QTest::keyClick(m_window.get(), Qt::Key_W);
        QVERIFY(settle(why));
        const auto &teeth = childOf<ColumnTable>(why, "The members of the family along the path");
        QVERIFY(teeth.isVisible());
        const QAbstractItemModel &rows = *teeth.model();
        QCOMPARE(rows.rowCount(), 5);
        for (int row = 0; row < 5; ++row) {
            const bool isMissing = row == 2;
            QCOMPARE(cellOf(rows, row, 0), QStringLiteral("%1×").arg(row + 1));
            QCOMPARE(rows.index(row, 0).data(Qt::ForegroundRole).isValid(), isMissing); // grey
            const double db = cellOf(rows, row, 2).toDouble();
            QVERIFY2(isMissing ? std::abs(db) < 2.0 : db > 4.0, qPrintable(cellOf(rows, row, 2)));
            QCOMPARE(cellOf(rows, row, 3).startsWith('+'), !isMissing);
        }
        QVERIFY2(sentenceOf(why).endsWith("4 of 5 members raise the evidence; it is no smaller without 3×."),
                 qPrintable(sentenceOf(why)));
    }

    void singleLinesHaveNoTeeth()
    {
        AnalysisSettings settings = m_window->document().settings();
        settings.family = {};
        m_window->controller().setSettings(settings, "No family");
        QVERIFY(settle(*m_window));
        QCOMPARE(noteOf(*m_window->workbench().input()), QString());
        QVERIFY(settle(m_window->panel<WhyPanel>()));
        QVERIFY(
            childOf<ColumnTable>(m_window->panel<WhyPanel>(), "The members of the family along the path").isHidden());
        QTest::keyClick(m_window.get(), Qt::Key_S, Qt::ShiftModifier);
        QVERIFY(settle(m_window->panel<SpectrumPanel>()));
        QVERIFY(m_window->panel<SpectrumPanel>().plot().marks().empty());
        const WaterfallView &input = *m_window->workbench().input();
        QVERIFY(input.axisTitle(input.hzAxis()).text().startsWith("Frequency"));
    }

private:
    static constexpr double fundamental = 57.3;
};

FAINTLINE_WINDOW_TEST(tst_FamilyViews)
#include "tst_FamilyViews.moc"
