#include "app/features/events/ComparePanel.h"
#include "app/features/events/Comparer.h"
#include "app/openWindow.h"
#include "support/find.h"
#include "support/test.h"
#include "widgets/table/ColumnTable.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QPushButton>

using namespace faintline;
using namespace faintline::test;

/// A kept, B changed: what the window shows of the two.
class tst_Comparer : public QObject
{
    Q_OBJECT

    QTemporaryDir m_folder;

    QString scene(const QString &name, double hz)
    {
        const QString text = QStringLiteral(R"({"kind": "lines", "sampleRateHz": 400, "durationSeconds": 60, "seed": 8,
            "lines": [{"snrDb": 0, "referenceSeconds": 0.25, "frequencyHz": %1, "startSeconds": 10,
            "durationSeconds": 45}]})");
        return writeFile(m_folder, name, text.arg(hz).toUtf8());
    }

    static void settle(MainWindow &window, QSignalSpy &settled)
    {
        if (settled.isEmpty())
            QVERIFY(settled.wait(patience));
        settled.clear();
        QTRY_VERIFY(!isBusy(window.comparer()));
    }

private slots:
    void keepChangeSwapGoBack()
    {
        const auto own = newWindow({1200, 800});
        MainWindow &window = *own;
        QSignalSpy settled(&window.controller(), &AnalysisController::settled);
        window.open(scene("a.json", 90.0), {}, [](AnalysisSettings &settings) {
            settings = preset("billon").settings;
            settings.spectrogram.windowSeconds = 0.25;
        });
        settle(window, settled);
        const AnalysisSettings first = window.document().settings();
        ComparePanel &panel = window.panel<ComparePanel>();
        QVERIFY(!buttonOf(panel, "Swap")->isEnabled());

        QTest::keyClick(&window, Qt::Key_B, Qt::ControlModifier);
        QVERIFY(panel.isVisible());
        QTRY_VERIFY(window.comparer().result().has_value());
        QCOMPARE(window.comparer().result()->comparison.count(ComparedEvent::In::Both), std::ptrdiff_t(1));
        QVERIFY(childOf<QLabel>(panel, "Settings in which A and B differ").text().contains("same settings"));

        // One frame's power alone does not find the line.
        window.controller().edit("detector.kind", FieldValue(std::string("energy")), "Choose a detector");
        settle(window, settled);
        QTRY_COMPARE(window.comparer().result()->b, window.document().analysis());
        const Comparison &comparison = window.comparer().result()->comparison;
        QCOMPARE(comparison.count(ComparedEvent::In::A), std::ptrdiff_t(1));
        QVERIFY(childOf<QLabel>(panel, "Settings in which A and B differ")
                    .text()
                    .contains(QString::fromUtf8("sequential Markov → single-frame energy")));
        QVERIFY(panel.picture()->picture() == window.comparer().result()->difference);
        QTRY_VERIFY(window.comparer().cost().has_value());
        QVERIFY(sentenceOf(panel).contains("processor"));

        // A click on what only A has found puts the cursor there.
        const ColumnTable &table = childOf<ColumnTable>(panel);
        const QModelIndexList found = table.model()->match(table.model()->index(0, 0), Qt::DisplayRole, "A");
        QCOMPARE(found.size(), 1);
        const QPoint cell = table.visualRect(found.front().siblingAtColumn(1)).center();
        QTest::mouseClick(table.viewport(), Qt::LeftButton, {}, cell);
        QVERIFY2(std::abs(window.document().viewport().cursor()->hz - 90.0) < 4.0,
                 qPrintable(QString::number(window.document().viewport().cursor()->hz)));

        buttonOf(panel, "Swap")->click();
        settle(window, settled);
        QCOMPARE(window.document().settings(), first);
        QVERIFY(std::holds_alternative<EnergySettings>(window.comparer().kept()->settings.detector));
        QTRY_COMPARE(window.comparer().result()->b, window.document().analysis());
        QCOMPARE(window.comparer().result()->comparison.count(ComparedEvent::In::B), std::ptrdiff_t(1));

        buttonOf(panel, "Go to A")->click();
        settle(window, settled);
        QVERIFY(std::holds_alternative<EnergySettings>(window.document().settings().detector));
        window.document().undoStack().undo();
        settle(window, settled);
        QCOMPARE(window.document().settings(), first);

        // Something else: A stays, and is computed there only when asked for.
        const auto kept = window.comparer().kept();
        window.open(scene("b.json", 150.0));
        settle(window, settled);
        QCOMPARE(window.comparer().kept(), kept);
        QVERIFY(!window.comparer().isOfWhatIsOpen());
        QVERIFY(!window.comparer().result().has_value());
        QVERIFY(buttonOf(panel, "Compute A here")->isVisible());
        QVERIFY(sentenceOf(panel).contains("another source"));
        buttonOf(panel, "Compute A here")->click();
        QTRY_VERIFY_WITH_TIMEOUT(window.comparer().result().has_value(), patience);
        QVERIFY(!buttonOf(panel, "Compute A here")->isVisible());
        QCOMPARE(window.comparer().kept()->settings, kept->settings);
    }
};

FAINTLINE_WINDOW_TEST(tst_Comparer)
#include "tst_Comparer.moc"
