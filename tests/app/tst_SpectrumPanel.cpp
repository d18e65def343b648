#include "app/features/inspect/SpectrumPanel.h"
#include "app/features/pictures/Workbench.h"
#include "app/openWindow.h"
#include "support/test.h"
#include "widgets/plot/ChartPlot.h"
#include "widgets/waterfall/WaterfallView.h"

#include <qwt_text.h>

#include <QComboBox>
#include <QDoubleSpinBox>

#include <algorithm>

using namespace faintline;
using namespace faintline::test;

/// The spectrum follows cursor, zoom and level.
class tst_SpectrumPanel : public QObject
{
    Q_OBJECT

private slots:
    void followsCursorZoomAndLevel()
    {
        QTemporaryDir folder;
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window,
                              writeFile(folder, "line.json",
                                        R"({"sampleRateHz": 500, "durationSeconds": 60, "noise": {"deviation": 0.1},
            "lines": [{"snrDb": 20, "referenceSeconds": 0.5, "startSeconds": 30, "frequencyHz": 120}]})"),
                              [](AnalysisSettings &settings) { settings.spectrogram.windowSeconds = 0.5; }));
        Viewport &viewport = window->document().viewport();
        SpectrumPanel &panel = window->panel<SpectrumPanel>();
        viewport.setCursor({45.0, 120.0});
        QVERIFY(panel.plot().chart().curves.empty()); // the panel is hidden
        QTest::keyClick(window.get(), Qt::Key_S, Qt::ShiftModifier);
        QVERIFY(settle(panel));
        QCOMPARE(panel.plot().chart().curves.size(), std::size_t(2));
        QVERIFY(std::abs(peakOf(panel, 0).x - 120.0) < 2.0);
        QVERIFY(peakOf(panel, 0).y > 15.0);
        const double whole = peakOf(panel, 1).y;

        viewport.setCursor({10.0, 120.0}); // before it begins
        QVERIFY(settle(panel));
        QVERIFY(peakOf(panel, 0).y < 13.0);

        viewport.zoomTo({35.0, 55.0}, {100.0, 140.0});
        QVERIFY(settle(panel));
        QVERIFY(std::abs(peakOf(panel, 1).y - whole - 3.0) < 1.0); // half of the time was noise
        for (const Curve::Point &point : panel.plot().chart().curves[1].points)
            QVERIFY(point.x >= 100.0 && point.x <= 140.0);

        const double overNoise = peakOf(panel, 1).y;
        auto *level = panel.findChild<QComboBox *>();
        level->setCurrentIndex(1);
        emit level->activated(1);
        QVERIFY(settle(panel));
        QVERIFY(std::abs(peakOf(panel, 1).y - overNoise - 10.0 * std::log10(2.0 * 0.01 / 500.0)) < 1.0);
        const double uncalibrated = peakOf(panel, 1).y;
        panel.findChild<QDoubleSpinBox *>()->setValue(160.0);
        QVERIFY(settle(panel));
        QVERIFY(std::abs(peakOf(panel, 1).y - uncalibrated - 160.0) < 1e-9);
    }

    /// Of what is left the curves and the picture say so, and the strong line is not in them.
    void saysWhatWasSubtracted()
    {
        QTemporaryDir folder;
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window,
                              writeFile(folder, "strong.json",
                                        R"({"sampleRateHz": 500, "durationSeconds": 60, "noise": {"deviation": 0.1},
            "lines": [{"snrDb": 40, "referenceSeconds": 0.5, "frequencyHz": 120}]})"),
                              [](AnalysisSettings &settings) {
                                  settings.spectrogram.windowSeconds = 0.5;
                                  settings.subtract.lines = true;
                              }));
        SpectrumPanel &panel = window->panel<SpectrumPanel>();
        window->document().viewport().setCursor({45.0, 120.0});
        QTest::keyClick(window.get(), Qt::Key_S, Qt::ShiftModifier);
        QVERIFY(settle(panel));
        QCOMPARE(panel.plot().chart().curves.size(), std::size_t(2));
        for (const Curve &curve : panel.plot().chart().curves)
            QVERIFY2(curve.name.find("strong lines subtracted") != std::string::npos, curve.name.c_str());
        QVERIFY(peakOf(panel, 1).y < 10.0);
        QCOMPARE(window->workbench().input()->title().text(),
                 QString("Input, strong lines subtracted (dB over noise)"));
    }

private:
    static Curve::Point peakOf(SpectrumPanel &panel, std::size_t curve)
    {
        const auto &points = panel.plot().chart().curves[curve].points;
        return *std::max_element(points.begin(), points.end(),
                                 [](const Curve::Point &a, const Curve::Point &b) { return a.y < b.y; });
    }
};

FAINTLINE_WINDOW_TEST(tst_SpectrumPanel)
#include "tst_SpectrumPanel.moc"
