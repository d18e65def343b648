#include "support/test.h"
#include "widgets/base/fittingTitle.h"

#include "pictures.h"
#include "widgets/base/Theme.h"
#include "widgets/base/Viewport.h"
#include "widgets/waterfall/WaterfallView.h"

#include <qwt_plot_canvas.h>
#include <qwt_scale_widget.h>

#include <QFontMetrics>

using namespace faintline;

/// Titles in little room lose words, never halves of letters.
class tst_fittingTitle : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    void theUnitIsLeft()
    {
        const QFont font = Theme::plotTitleFont();
        const auto width = [&](const QString &text) { return QFontMetrics(font).horizontalAdvance(text) + 4; };
        QCOMPARE(fittingTitle("Frequency (Hz)", font, 500), QString("Frequency (Hz)"));
        QCOMPARE(fittingTitle("Frequency (Hz)", font, width("Frequency (Hz)") - 1), QString("Hz"));
        QCOMPARE(fittingTitle("Bearing", font, width("Bearing") - 1).right(1), QString("…"));
        QCOMPARE(fittingTitle("", font, 10), QString());
    }

    void theNameIsLeft()
    {
        const QFont font = Theme::plotHeadingFont();
        const int whole = QFontMetrics(font).horizontalAdvance("Input (dB over noise)") + 4;
        QCOMPARE(fittingHeading("Input (dB over noise)", font, whole), QString("Input (dB over noise)"));
        QCOMPARE(fittingHeading("Input (dB over noise)", font, whole - 1), QString("Input"));
        QCOMPARE(fittingHeading("Statistic D (nat)", font, 30).right(1), QString("…"));
    }

    /// A picture of any width, there and back.
    void aNarrowPictureCutsNothing()
    {
        WaterfallView view("Input (dB over noise)");
        Viewport viewport;
        viewport.setExtents({0.0, 100.0}, {0.0, 200.0}, 1.0, 1.0);
        view.setViewport(&viewport);
        view.setPicture(test::picture(100, 200, [](Index f, Index c) { return float((f + c) % 7); }),
                        test::hzAxis(200));
        view.show();
        for (const int width : {700, 150, 110, 700}) {
            view.resize(width, 300);
            QCoreApplication::processEvents();
            const int room = view.canvas()->width();
            const auto needed = [](const QwtText &text) { return int(text.textSize().width()); };
            const QwtText heading = view.title(), axis = view.axisTitle(view.hzAxis());
            QVERIFY2(needed(heading) <= room, qPrintable(heading.text()));
            QVERIFY2(needed(axis) <= room, qPrintable(axis.text()));
            QCOMPARE(heading.text() == "Input (dB over noise)", width == 700);
        }
    }
};

FAINTLINE_WINDOW_TEST(tst_fittingTitle)
#include "tst_fittingTitle.moc"
