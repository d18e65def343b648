#include "support/test.h"
#include "widgets/plot/ChartPlot.h"

#include "pixels.h"
#include "widgets/base/Theme.h"

#include <qwt_plot.h>
#include <qwt_plot_curve.h>
#include <qwt_symbol.h>
#include <qwt_text.h>

#include <QCheckBox>
#include <QPainter>

#include <memory>

using namespace faintline;

/// A chart one can look into: it draws, its key toggles, a point can be read and clicked.
class tst_ChartPlot : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    void init()
    {
        m_view = std::make_unique<ChartPlot>();
        m_view->setInvitation("click to open a trial");
        m_view->setChart(chart());
        test::show(*m_view);
    }

    void cleanup() { m_view.reset(); }

    void drawsEveryCurve()
    {
        QCOMPARE(m_view->plot()->itemList(QwtPlotItem::Rtti_PlotCurve).size(), 4);
        QCOMPARE(m_view->plot()->itemList(QwtPlotItem::Rtti_PlotIntervalCurve).size(), 1);
        // The curve's colour is on the canvas; theory has its detector's colour, another detector another.
        const QSet<QRgb> colours = test::coloursOf(*m_view->plot());
        const Theme::Colours &theme = Theme::colours(Theme::Kind::Light);
        QVERIFY(colours.contains(theme.curves[0].rgb()));
        QVERIFY(colours.contains(theme.curves[1].rgb()));
        QVERIFY(!colours.contains(theme.curves[2].rgb()));
    }

    /// Symbols of eight curves, without their colours.
    void symbolsAreToldApart()
    {
        Chart all{"Detection", "SNR (dB)", "Pd", false, false, {}};
        for (int i = 0; i < 8; ++i)
            all.curves.push_back({"curve " + std::to_string(i), Curve::Kind::Measured, {{1, 0.1 * i, {}}}});
        m_view->setChart(all);
        std::vector<QImage> pictures;
        for (const Curve &curve : all.curves) {
            const QwtSymbol &own = *item(QString::fromStdString(curve.name))->symbol();
            const QwtSymbol black(own.style(), Qt::black, own.pen().widthF() > 0 ? QPen(Qt::black, 1.4) : QPen(),
                                  own.size());
            QImage picture(15, 15, QImage::Format_Grayscale8);
            picture.fill(Qt::white);
            QPainter painter(&picture);
            painter.setRenderHint(QPainter::Antialiasing);
            black.drawSymbol(&painter, QPointF(7.5, 7.5));
            painter.end();
            for (const QImage &other : pictures) {
                int different = 0;
                for (int y = 0; y < 15; ++y)
                    for (int x = 0; x < 15; ++x)
                        different += std::abs(picture.constScanLine(y)[x] - other.constScanLine(y)[x]) > 100 ? 1 : 0;
                QVERIFY2(different >= 12, // a hexagon differs from a circle by 9
                         qPrintable(QString("%1: %2").arg(QString::fromStdString(curve.name)).arg(different)));
            }
            pictures.push_back(picture);
        }
    }

    void theKeyTogglesAndRemembers()
    {
        const QList<QCheckBox *> boxes = m_view->findChildren<QCheckBox *>();
        QCOMPARE(boxes.size(), 4);
        QCOMPARE(boxes[1]->text(), QString("3 of 4"));
        QTest::mouseClick(boxes[1], Qt::LeftButton, {}, QPoint(8, boxes[1]->height() / 2));
        QVERIFY(!m_view->isShown(1));
        QVERIFY(m_view->isShown(0));
        m_view->setChart(chart());
        QVERIFY(!m_view->isShown(1));
        hover(m_view->canvasPosition(1, 2));
        QVERIFY2(!m_view->readOut().startsWith("3 of 4:"), qPrintable(m_view->readOut()));
    }

    void hoverReadsAndClickAsks()
    {
        hover(m_view->canvasPosition(0, 1) + QPointF(3, -2));
        QVERIFY2(m_view->readOut().startsWith("integrator:"), qPrintable(m_view->readOut()));
        QVERIFY(m_view->readOut().contains("0.6"));
        QVERIFY(m_view->readOut().contains(QString::fromUtf8("0.5 … 0.7")));
        QVERIFY(m_view->readOut().contains("click to open a trial"));
        QSignalSpy activated(m_view.get(), &ChartPlot::pointActivated);
        QTest::mouseClick(m_view->plot()->canvas(), Qt::LeftButton, {}, m_view->canvasPosition(1, 2).toPoint());
        QCOMPARE(activated.count(), 1);
        QCOMPARE(activated[0][0].value<std::size_t>(), std::size_t(1));
        QCOMPARE(activated[0][1].value<std::size_t>(), std::size_t(2));
    }

    void theoryCannotBeClicked()
    {
        QSignalSpy activated(m_view.get(), &ChartPlot::pointActivated);
        Chart theory = chart();
        theory.curves = {theory.curves[2], theory.curves[3]};
        m_view->setChart(theory);
        QTest::mouseClick(m_view->plot()->canvas(), Qt::LeftButton, {}, m_view->canvasPosition(0, 0).toPoint());
        QTest::mouseClick(m_view->plot()->canvas(), Qt::LeftButton, {}, m_view->canvasPosition(1, 0).toPoint());
        QCOMPARE(activated.count(), 0);
        QVERIFY(m_view->readOut().startsWith("3 of 4, paper:")); // but read
    }

    void keysWalkFromPointToPoint()
    {
        QSignalSpy activated(m_view.get(), &ChartPlot::pointActivated);
        QTest::keyClick(m_view.get(), Qt::Key_Right);
        QTest::keyClick(m_view.get(), Qt::Key_Right);
        QTest::keyClick(m_view.get(), Qt::Key_Down);
        QTest::keyClick(m_view.get(), Qt::Key_Return);
        QCOMPARE(activated.count(), 1);
        QCOMPARE(activated[0][0].value<std::size_t>(), std::size_t(1));
        QCOMPARE(activated[0][1].value<std::size_t>(), std::size_t(1));
    }

    void logarithmicAxesPlaceDecadesEvenly()
    {
        m_view->setChart(chart(true));
        const double first = m_view->canvasPosition(0, 0).x(), second = m_view->canvasPosition(0, 1).x(),
                     third = m_view->canvasPosition(0, 2).x();
        QVERIFY(second > first + 20.0);
        QVERIFY(std::abs((third - second) - (second - first)) < 1.5);
    }

    void growsWithoutLosingItsKey()
    {
        QPointer<QCheckBox> box = m_view->findChildren<QCheckBox *>().first();
        Chart grown = chart();
        grown.curves[0].points.push_back({200, 0.95, {0.9, 1.0}});
        m_view->setChart(grown);
        QVERIFY(box);
        QCOMPARE(item("integrator")->dataSize(), std::size_t(4));
        QVERIFY(m_view->canvasPosition(0, 3).x() > m_view->canvasPosition(0, 2).x());
    }

    void inANarrowPanelCurvesComeBeforeTheirNames()
    {
        m_view->resize(280, 130);
        QCoreApplication::processEvents();
        QVERIFY(!m_view->findChild<QCheckBox *>()->isVisible());
        QVERIFY(m_view->plot()->width() > 260);
        m_view->resize(280, 400); // the names below
        QCoreApplication::processEvents();
        QVERIFY(m_view->findChild<QCheckBox *>()->isVisible());
        QVERIFY(m_view->plot()->width() > 260);
        m_view->resize(640, 360);
        QCoreApplication::processEvents();
        QVERIFY(m_view->findChild<QCheckBox *>()->isVisible());
    }

    void emptySaysWhatToDo()
    {
        const QImage before = m_view->grab().toImage();
        m_view->setChart({});
        m_view->setEmptySentence("Press Start.");
        QVERIFY(m_view->grab().toImage() != before);
        QCOMPARE(m_view->findChildren<QCheckBox *>().size(), 0);
        hover({10, 10});
        QTest::keyClick(m_view.get(), Qt::Key_Right);
    }

    /// Fewer ticks have narrower labels, which leave room for more ticks, which …
    void anyWidthSettles()
    {
        m_view->setChart({"Where both disagree",
                          "x",
                          "y",
                          false,
                          false,
                          {{"one", Curve::Kind::Measured, {{-99, 0.2, {}}, {99, 13, {}}}}}});
        for (int width = 300; width < 360; ++width) {
            m_view->resize(width, 300);
            QCoreApplication::processEvents();
            QVERIFY2(m_view->plot()->canvas()->width() > 2 * width / 5, // key and labels take the rest
                     qPrintable(QString("%1 of %2").arg(m_view->plot()->canvas()->width()).arg(width)));
        }
    }

private:
    static Chart chart(bool isLogarithmicX = false)
    {
        const Curve measured{
            "integrator", Curve::Kind::Measured, {{1, 0.2, {0.1, 0.3}}, {10, 0.6, {0.5, 0.7}}, {100, 0.9, {0.8, 1.0}}}};
        const Curve other{"3 of 4", Curve::Kind::Measured, {{1, 0.1, {}}, {10, 0.3, {}}, {100, 0.5, {}}}};
        const Curve theory{"integrator, Marcum Q", Curve::Kind::Theory, {{1, 0.25, {}}, {100, 0.95, {}}}};
        const Curve paper{"3 of 4, paper", Curve::Kind::Paper, {{10, 0.35, {}}}};
        return {"Detection", "SNR (dB)", "Pd", isLogarithmicX, false, {measured, other, theory, paper}};
    }

    QwtPlotCurve *item(const QString &name) const
    {
        for (QwtPlotItem *one : m_view->plot()->itemList(QwtPlotItem::Rtti_PlotCurve))
            if (one->title().text() == name)
                return static_cast<QwtPlotCurve *>(one);
        return nullptr;
    }

    void hover(const QPointF &at)
    {
        QMouseEvent move(QEvent::MouseMove, at, at, Qt::NoButton, Qt::NoButton, {});
        QCoreApplication::sendEvent(m_view->plot()->canvas(), &move);
    }

    std::unique_ptr<ChartPlot> m_view;
};

FAINTLINE_WINDOW_TEST(tst_ChartPlot)
#include "tst_ChartPlot.moc"
