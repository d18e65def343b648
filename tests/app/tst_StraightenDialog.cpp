#include "app/features/events/StraightenDialog.h"
#include "app/openWindow.h"
#include "base/json.h"
#include "inspect/straighten.h"
#include "scene/SimulatedRecording.h"
#include "signal/formats/writeRecording.h"
#include "support/recordings.h"
#include "support/test.h"
#include "widgets/plot/ChartPlot.h"

#include <QAction>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>

#include <algorithm>
#include <cmath>

using namespace faintline;
using namespace faintline::test;

/// A recording straightened from the window: the spectra before and after, and the command line's file.
class tst_StraightenDialog : public WindowTest
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        LineScene scene;
        scene.sampleRateHz = 500.0;
        scene.durationSeconds = 60.0;
        scene.lines = {{.snrDb = 12.0,
                        .referenceSeconds = 0.5,
                        .startSeconds = 5.0,
                        .durationSeconds = 50.0,
                        .frequencyHz = 100.0,
                        .driftHzPerSecond = 0.2}};
        m_path = m_folder.filePath("line.wav");
        writeRecording(SimulatedRecording(scene), m_path.toStdString());
        m_window = newWindow();
        QVERIFY(openAndSettle(*m_window, m_path,
                              [](AnalysisSettings &settings) { settings.spectrogram.windowSeconds = 0.5; }));
        QCOMPARE(m_window->document().shownEvents().size(), std::size_t(1));
    }

    void showsTheLineBeforeAndAfter()
    {
        QTest::keyClick(m_window.get(), Qt::Key_T);
        QVERIFY(dialog());
        QVERIFY(dialog()->isVisible());
        QVERIFY(!dialog()->target()->isEnabled()); // the track's mean frequency comes with the spectra
        QVERIFY(settle(*dialog()));
        QVERIFY(dialog()->target()->isEnabled());
        QVERIFY(std::abs(dialog()->target()->value() - 105.0) < 0.5);
        const auto peakOf = [](ChartPlot &chart) {
            const auto &points = chart.chart().curves.at(0).points;
            return *std::max_element(points.begin(), points.end(),
                                     [](const auto &a, const auto &b) { return a.y < b.y; });
        };
        const Curve::Point before = peakOf(dialog()->before()), after = peakOf(dialog()->after());
        // 10 Hz in 50 s: 500 cells against one.
        QVERIFY2(after.y > before.y + 8.0, qPrintable(QStringLiteral("%1 %2").arg(before.y).arg(after.y)));
        QVERIFY(std::abs(after.x - dialog()->target()->value()) < 0.1);
        QVERIFY2(sentenceOf(*dialog()).contains("dB over its surroundings before"), qPrintable(sentenceOf(*dialog())));
    }

    void writesTheCommandLinesFile()
    {
        const QString path = m_folder.filePath("straight.wav");
        QSignalSpy written(dialog(), &StraightenDialog::written);
        dialog()->writeTo(path);
        QVERIFY(isBusy(*dialog()));
        QVERIFY(!dialog()->target()->isEnabled());
        QVERIFY(!written.isEmpty() || written.wait(patience));
        QTRY_VERIFY(dialog()->target()->isEnabled());
        const Analysis &analysis = *m_window->document().analysis();
        const std::string expected = m_folder.filePath("expected.wav").toStdString();
        writeRecording(*straightened(analysis, chosenEvent(analysis, 0)).recording, expected);
        QVERIFY(readBytes(path.toStdString()) == readBytes(expected));
        const Json provenance =
            parseJson(readBytes(path.toStdString() + ".provenance.json").toStdString(), "provenance");
        QCOMPARE(provenance["straighten"]["event"].get<int>(), chosenEvent(analysis, 0).id);
    }

    void theTargetMovesTheLine()
    {
        dialog()->target()->setValue(50.0);
        QVERIFY(settle(*dialog()));
        const auto &points = dialog()->after().chart().curves.at(0).points;
        const auto peak =
            std::max_element(points.begin(), points.end(), [](const auto &a, const auto &b) { return a.y < b.y; });
        QVERIFY2(std::abs(peak->x - 50.0) < 0.1, qPrintable(QString::number(peak->x)));
    }

    /// The same file as the library's; the line stands out as with a shift.
    void resamplesInstead()
    {
        QCOMPARE(dialog()->findChild<QComboBox *>()->currentIndex(), int(Straightening::Shift));
        dialog()->target()->setValue(106.0);
        dialog()->findChild<QComboBox *>()->setCurrentIndex(int(Straightening::Resample));
        QVERIFY(settle(*dialog()));
        const auto &points = dialog()->after().chart().curves.at(0).points;
        const auto peak =
            std::max_element(points.begin(), points.end(), [](const auto &a, const auto &b) { return a.y < b.y; });
        QVERIFY2(std::abs(peak->x - 106.0) < 0.1, qPrintable(QString::number(peak->x)));
        const QString path = m_folder.filePath("resampled.wav");
        QSignalSpy written(dialog(), &StraightenDialog::written);
        dialog()->writeTo(path);
        QVERIFY(!written.isEmpty() || written.wait(patience));
        const Analysis &analysis = *m_window->document().analysis();
        const std::string expected = m_folder.filePath("expected2.wav").toStdString();
        writeRecording(
            *straightened(analysis, chosenEvent(analysis, 0), {0.0, 106.0, Straightening::Resample}).recording,
            expected);
        QVERIFY(readBytes(path.toStdString()) == readBytes(expected));
        const Json provenance =
            parseJson(readBytes(path.toStdString() + ".provenance.json").toStdString(), "provenance");
        QCOMPARE(provenance["straighten"]["method"].get<std::string>(), std::string("resample"));
        dialog()->findChild<QComboBox *>()->setCurrentIndex(int(Straightening::Shift));
        QVERIFY(settle(*dialog()));
    }

    void saysWhatCannotBeDone()
    {
        const QByteArray original = readBytes(m_path.toStdString());
        dialog()->writeTo(m_path);
        QVERIFY2(sentenceOf(*dialog()).contains("is an input and would be replaced"),
                 qPrintable(sentenceOf(*dialog())));
        QCOMPARE(readBytes(m_path.toStdString()), original);
        dialog()->writeTo(m_folder.filePath("straight.txt"));
        QVERIFY(settle(*dialog()));
        QVERIFY2(sentenceOf(*dialog()).contains("straight.txt"), qPrintable(sentenceOf(*dialog())));
        QVERIFY(!QFile::exists(m_folder.filePath("straight.txt")));
        QTest::keyClick(dialog(), Qt::Key_Escape);
        QTRY_VERIFY(!dialog());
    }

    void withoutAnEventThereIsNoDialog()
    {
        m_window->document().setShownThreshold(1e6);
        QTest::keyClick(m_window.get(), Qt::Key_T);
        QVERIFY(!dialog());
    }

private:
    StraightenDialog *dialog() const { return m_window->findChild<StraightenDialog *>(); }

    QString m_path;
};

FAINTLINE_WINDOW_TEST(tst_StraightenDialog)
#include "tst_StraightenDialog.moc"
