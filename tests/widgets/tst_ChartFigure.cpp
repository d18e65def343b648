#include "support/test.h"
#include "widgets/plot/ChartFigure.h"

#include "widgets/base/Theme.h"
#include "widgets/plot/ChartPlot.h"
#include "widgets/plot/ExceedancePlot.h"
#include "widgets/plot/plotCsv.h"

#include <QCheckBox>
#include <QLabel>

using namespace faintline;

/// A chart as it is printed: light whatever the theme, without controls, with a caption.
class tst_ChartFigure : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Dark); }

    void lightWithACaptionAndWhatIsShown()
    {
        ChartPlot chart;
        chart.setChart({"Pd", "SNR (dB)", "Pd", false, false, {curve("one"), curve("two")}});
        chart.setShown(1, false);
        chart.show();
        const QImage before = chart.grab().toImage();
        ChartFigure figure(chart, "night.wav; window = 0.5 s");
        const QImage image = figure.grab().toImage();
        QVERIFY2(image.pixelColor(3, 3).lightness() > 240, qPrintable(image.pixelColor(3, 3).name()));
        QVERIFY(image.pixelColor(image.width() - 4, image.height() - 4).lightness() > 240);
        QCOMPARE(figure.findChildren<QLabel *>().last()->text(), QString("night.wav; window = 0.5 s"));
        QStringList names;
        for (const QCheckBox *box : figure.findChildren<QCheckBox *>())
            if (box->isVisible())
                names << box->text();
        QCOMPARE(names, QStringList{"one"});
        QCOMPARE(chart.grab().toImage(), before); // what is on the screen keeps its looks
    }

    void theKeyIsLegible()
    {
        ChartPlot chart;
        chart.setChart({"Pd", "SNR (dB)", "Pd", false, false, {curve("sequential Markov"), curve("P out of N")}});
        chart.show();
        ChartFigure figure(chart, {});
        const QImage image = figure.grab().toImage();
        for (const QCheckBox *box : figure.findChildren<QCheckBox *>()) {
            const QRect part(box->mapTo(&figure, QPoint()), box->size());
            int light = 0;
            int dark = 0;
            for (int y = part.top(); y <= part.bottom(); ++y)
                for (int x = part.left(); x <= part.right(); ++x) {
                    const int lightness = image.pixelColor(x, y).lightness();
                    light += lightness > 230;
                    dark += lightness < 120;
                }
            QVERIFY2(light > part.width() * part.height() / 2, qPrintable(box->text()));
            QVERIFY2(dark > 40, qPrintable(box->text()));
        }
    }

    void anyPlotIsRecordedLight()
    {
        ExceedancePlot plot;
        plot.resize(400, 260);
        plot.show();
        const QImage before = plot.grab().toImage();
        ChartFigure figure(plot, {});
        QVERIFY(figure.width() >= 760);
        const QImage image = figure.grab().toImage();
        QVERIFY2(image.pixelColor(10, 10).lightness() > 200, qPrintable(image.pixelColor(10, 10).name()));
        QCOMPARE(plot.size(), QSize(400, 260));
        QCOMPARE(plot.grab().toImage(), before);
    }

    void nothingOfAPlotIsClipped()
    {
        ExceedancePlot plot;
        plot.resize(230, 170);
        auto calibration = std::make_shared<Calibration>();
        calibration->anchorNats = 5.0;
        calibration->eventRate = 1e-3;
        calibration->tailSlope = 0.5;
        plot.setCalibration(calibration, 1e6);
        plot.setHistogram({20000.0, 3000.0, 500.0, 80.0, 9.0});
        plot.show();
        ChartFigure figure(plot, {});
        const QImage image = figure.grab().toImage();
        const auto dark = [&](const QRect &part) {
            int count = 0;
            for (int y = part.top(); y <= part.bottom(); ++y)
                for (int x = part.left(); x <= part.right(); ++x)
                    count += image.pixelColor(x, y).lightness() < 160;
            return count;
        };
        const int below = 4 + 240; // the plot
        QVERIFY2(dark({200, below - 20, 350, 20}) > 60, "the title below");
        QVERIFY2(dark({745, 30, 14, 190}) > 60, "the title on the right");
        QVERIFY2(dark({710, 10, 30, 110}) > 60, "the upper labels on the right");
        QVERIFY2(dark({1, 30, 14, 190}) > 60, "the title on the left");
    }

    void numbersOfACurve()
    {
        ExceedancePlot plot;
        auto calibration = std::make_shared<Calibration>();
        calibration->anchorNats = 5.0;
        calibration->eventRate = 1e-3;
        calibration->tailSlope = 0.5;
        calibration->above = {1.0, 0.5};
        plot.setCalibration(calibration, 1e6);
        const QString csv = QString::fromStdString(plotCsv(plot, true));
        QVERIFY2(csv.startsWith("curve,x,y\n\"noise, fitted law\",5,1000"), qPrintable(csv.left(80)));
        plot.setHistogram({20000.0, 0.0, 7.0});
        const QStringList rows = QString::fromStdString(plotCsv(plot, true)).split('\n').filter("\"recorded cells\"");
        QCOMPARE(rows.size(), 2);
        QVERIFY(rows[0].endsWith(",20000") && rows[1].endsWith(",7"));
    }

private:
    static Curve curve(const char *name)
    {
        return {
            name, Curve::Kind::Measured, {{-3.0, 0.1, {0.05, 0.2}}, {0.0, 0.5, {0.4, 0.6}}, {3.0, 0.9, {0.8, 0.95}}}};
    }
};

FAINTLINE_WINDOW_TEST(tst_ChartFigure)
#include "tst_ChartFigure.moc"
