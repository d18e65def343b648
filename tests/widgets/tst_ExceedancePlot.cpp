#include "support/test.h"
#include "widgets/plot/ExceedancePlot.h"

#include "pixels.h"
#include "widgets/base/Theme.h"

#include <qwt_scale_div.h>

#include <cmath>
#include <memory>

using namespace faintline;

/// Tuning the threshold: dragging asks, releasing commits, the words are those of the chosen unit.
class tst_ExceedancePlot : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Dark); }

    void init()
    {
        m_plot = std::make_unique<ExceedancePlot>();
        m_plot->setCalibration(calibration(), 1e6);
        m_plot->setHistogram({0, 0, 10, 100, 500, 1000, 800, 400, 100, 20, 5, 1});
        m_plot->setThreshold(12.0);
        test::show(*m_plot, {420, 300});
    }

    void cleanup() { m_plot.reset(); }

    void draggingRequestsLiveAndCommitsOnce()
    {
        QSignalSpy requested(m_plot.get(), &ExceedancePlot::thresholdRequested),
            committed(m_plot.get(), &ExceedancePlot::thresholdCommitted);
        QWidget *canvas = m_plot->canvas();
        const auto at = [&](double nats) { return QPoint(qRound(m_plot->transform(QwtAxis::XBottom, nats)), 60); };
        const QPoint start = at(12.0), middle = at(15.0), end = at(18.0);
        QTest::mousePress(canvas, Qt::LeftButton, {}, start);
        for (const QPoint &position : {middle, end}) {
            QMouseEvent move(QEvent::MouseMove, position, canvas->mapToGlobal(position), Qt::NoButton, Qt::LeftButton,
                             {});
            QCoreApplication::sendEvent(canvas, &move);
        }
        QCOMPARE(requested.count(), 3);
        QCOMPARE(committed.count(), 0);
        QTest::mouseRelease(canvas, Qt::LeftButton, {}, end);
        QCOMPARE(committed.count(), 1);
        QVERIFY(std::abs(requested[1][0].toDouble() - 15.0) < 0.2);
        QVERIFY(std::abs(committed[0][0].toDouble() - 18.0) < 0.2);
        QCOMPARE(committed[0][0].toDouble(), m_plot->threshold());
    }

    void keysStepByAQuarterNat()
    {
        QSignalSpy requested(m_plot.get(), &ExceedancePlot::thresholdRequested),
            committed(m_plot.get(), &ExceedancePlot::thresholdCommitted);
        QTest::keyClick(m_plot.get(), Qt::Key_Period);
        QCOMPARE(m_plot->threshold(), 12.25);
        QTest::keyClick(m_plot.get(), Qt::Key_Comma);
        QTest::keyClick(m_plot.get(), Qt::Key_Comma);
        QCOMPARE(m_plot->threshold(), 11.75);
        QCOMPARE(requested.count(), 3);
        QCOMPARE(committed.count(), 3);
    }

    void wordsOfEachUnit()
    {
        m_plot->setThreshold(5.0);
        m_plot->setUnit(ExceedancePlot::Unit::Nats);
        QCOMPARE(m_plot->accessibleDescription(), QString("Threshold at 5.00 nat"));
        m_plot->setUnit(ExceedancePlot::Unit::PfaPerCell);
        QCOMPARE(m_plot->accessibleDescription(), QString("Threshold at Pfa 0.025 per cell")); // 0.3 e^{-2.5}
        m_plot->setUnit(ExceedancePlot::Unit::FalseAlarmsPerHour);
        QCOMPARE(
            m_plot->accessibleDescription(),
            QString("Threshold at 1000 false alarms/h")); // 1e-3 events per cell and frame, 1e6 of these in an hour
    }

    void theLabelTellsOfThisNoise()
    {
        // At 5 nat 1000 events an hour, e-fold in 2 nat.
        m_plot->setThreshold(5.0 + 2.0 * std::log(1000.0));
        const QString plain = m_plot->labelText();
        QCOMPARE(plain, QString("1 false alarm/h\n18.82 nat"));
        m_plot->setOwnNoise({{}, "more"});
        QCOMPARE(m_plot->labelText(), QString("1 false alarm/h on noise\nthis noise: more\n18.82 nat"));
        m_plot->setOwnNoise({40.0, "more"});
        QCOMPARE(m_plot->labelText(), QString("1 false alarm/h on noise\nthis noise: about 40/h\n18.82 nat"));
        m_plot->setThreshold(5.0); // it is dragged with the line
        QVERIFY2(m_plot->labelText().contains("this noise: about 40000/h"), qPrintable(m_plot->labelText()));
        m_plot->setUnit(ExceedancePlot::Unit::Nats); // no rate, nothing to say of it
        QCOMPARE(m_plot->labelText(), QString("5.00 nat"));
        m_plot->setUnit(ExceedancePlot::Unit::FalseAlarmsPerHour);
        m_plot->setOwnNoise({});
        m_plot->setThreshold(5.0 + 2.0 * std::log(1000.0));
        QCOMPARE(m_plot->labelText(), plain);
    }

    void thresholdFromOutsideIsSilent()
    {
        QSignalSpy requested(m_plot.get(), &ExceedancePlot::thresholdRequested),
            committed(m_plot.get(), &ExceedancePlot::thresholdCommitted);
        m_plot->setThreshold(200.0); // beyond the scale, which makes room
        QVERIFY(m_plot->axisScaleDiv(QwtAxis::XBottom).contains(200.0));
        QCOMPARE(requested.count() + committed.count(), 0);
    }

    void withoutCalibrationNothingHappens()
    {
        m_plot->setCalibration(nullptr, 0.0);
        QSignalSpy requested(m_plot.get(), &ExceedancePlot::thresholdRequested);
        QTest::mouseClick(m_plot->canvas(), Qt::LeftButton);
        QTest::keyClick(m_plot.get(), Qt::Key_Period);
        QCOMPARE(requested.count(), 0);
        m_plot->grab();
    }

    void samePixelsTwice()
    {
        const QImage first = m_plot->grab().toImage();
        m_plot->setThreshold(3.0);
        m_plot->setUnit(ExceedancePlot::Unit::Nats);
        m_plot->setUnit(ExceedancePlot::Unit::FalseAlarmsPerHour);
        m_plot->setThreshold(12.0);
        QCOMPARE(m_plot->grab().toImage(), first);
    }

private:
    /// P(D > T) = 0.3 e^{-T/2} of a cell, 1e-3 events per cell and frame at 5 nat.
    static std::shared_ptr<const Calibration> calibration()
    {
        auto result = std::make_shared<Calibration>();
        result->anchorNats = 5.0;
        result->eventRate = 1e-3;
        result->tailSlope = 0.5;
        result->lowestLevel = -2.0;
        result->levelStep = 0.25;
        for (std::size_t i = 0; i <= 100; ++i)
            result->above.push_back(std::min(1.0, 0.3 * std::exp(-0.5 * result->level(i))));
        return result;
    }

    std::unique_ptr<ExceedancePlot> m_plot;
};

FAINTLINE_WINDOW_TEST(tst_ExceedancePlot)
#include "tst_ExceedancePlot.moc"
