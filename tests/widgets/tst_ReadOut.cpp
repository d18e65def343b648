#include "support/test.h"
#include "widgets/base/ReadOut.h"

#include "pixels.h"
#include "widgets/base/Theme.h"

#include <QApplication>
#include <QClipboard>
#include <QContextMenuEvent>
#include <QLabel>
#include <QMenu>

using namespace faintline;

/// The line of figures: its digits, what it says of what is unknown, and that no figure moves.
class tst_ReadOut : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    void init()
    {
        m_line = std::make_unique<ReadOut>();
        m_line->setResolution(0.5, 0.5);
        test::show(*m_line, {1000, 26});
    }

    void theLineIsItsFigures()
    {
        m_line->setReading({83.5, 1065.5, -1.5, 14.0, {}});
        QCOMPARE(m_line->text(), QString("83.5 s · 1065.5 Hz · −1.5 dB · 14.0 nat"));
        m_line->setStartUnixSeconds(1721952000.0);
        QCOMPARE(m_line->text(), QString("83.5 s · 2024-07-26 00:01:23.5 · 1065.5 Hz · −1.5 dB · 14.0 nat"));
        m_line->clear();
        QCOMPARE(m_line->text(), QString());
    }

    void timesInALongRecordingAreThoseOfItsAxis()
    {
        m_line->setResolution(0.5, 0.5, 3600.0);
        m_line->setReading({83.5, {}, {}, {}, {}});
        QCOMPARE(m_line->text(), QString("0:01:23.5"));
    }

    void whatIsUnknownIsADash()
    {
        m_line->setReading({{}, 440.0, {}, {}, -0.25});
        for (const char *name : {"Time", "Level", "Statistic"})
            QCOMPARE(shown(name), QString("–"));
        QCOMPARE(shown("Frequency"), QString("440.0 Hz"));
        QCOMPARE(shown("Drift"), QString("−0.25 Hz/s"));
        QCOMPARE(m_line->text(), QString("440.0 Hz · −0.25 Hz/s"));
    }

    void neighbouringCellsDiffer_data()
    {
        QTest::addColumn<double>("frameSeconds");
        QTest::addColumn<double>("binHz");
        QTest::newRow("clicks") << 0.0001 << 100.0;
        QTest::newRow("speech") << 0.0125 << 7.8125;
        QTest::newRow("carriers") << 30.0 << 0.004;
        QTest::newRow("one of each") << 1.0 << 1.0;
    }

    void neighbouringCellsDiffer()
    {
        QFETCH(double, frameSeconds);
        QFETCH(double, binHz);
        m_line->setResolution(frameSeconds, binHz);
        for (const double seconds : {0.0, 12.0, 4000.0})
            for (const double hz : {100.0, 14000.0, 2.0e7}) {
                m_line->setReading({seconds, hz, {}, {}, {}});
                const QString time = shown("Time"), frequency = shown("Frequency");
                m_line->setReading({seconds + frameSeconds, hz + binHz, {}, {}, {}});
                QVERIFY2(shown("Time") != time, qPrintable(time));
                QVERIFY2(shown("Frequency") != frequency, qPrintable(frequency));
            }
    }

    void longTimesAndHighFrequenciesChangeTheirUnit()
    {
        m_line->setReading({3723.5, 14095600.0, {}, {}, {}});
        QCOMPARE(shown("Time"), QString("1:02:03.5"));
        QCOMPARE(shown("Frequency"), QString("14.0956000 MHz"));
        m_line->setReading({-2.5, -12000.0, {}, {}, {}});
        QCOMPARE(shown("Time"), QString("−2.5 s"));
        QCOMPARE(shown("Frequency"), QString("−12.0000 kHz"));
    }

    void aCentreFrequencyGivesTheRadioFrequency()
    {
        QVERIFY(figure("Radio")->parentWidget()->isHidden());
        m_line->setResolution(0.1, 0.02);
        m_line->setCentreHz(2.5e6);
        m_line->setReading({1.0, -2.91, {}, {}, {}});
        QVERIFY(!figure("Radio")->parentWidget()->isHidden());
        QCOMPARE(figure("Radio")->text(), QString("2499.99709 kHz"));
        QVERIFY(m_line->text().contains("2499.99709 kHz"));
        m_line->setCentreHz(0.0);
        QVERIFY(figure("Radio")->parentWidget()->isHidden());
    }

    void theDayEndsAtMidnight()
    {
        m_line->setStartUnixSeconds(1709164799.0); // 2024-02-28 23:59:59
        m_line->setReading({1.0, {}, {}, {}, {}});
        QCOMPARE(shown("UTC"), QString("2024-02-29 00:00:00"));
        m_line->setReading({86401.5, {}, {}, {}, {}});
        QCOMPARE(shown("UTC"), QString("2024-03-01 00:00:00.5"));
    }

    void noSecondHasSixty()
    {
        m_line->setStartUnixSeconds(1721952000.0);
        m_line->setReading({59.99, {}, {}, {}, {}}); // half a second is the resolution: one decimal
        QCOMPARE(shown("UTC").left(19), QString("2024-07-26 00:01:00"));
    }

    void theStatisticHasItsUnit()
    {
        m_line->setReading({{}, {}, {}, 2.345, {}});
        QCOMPARE(shown("Statistic"), QString("2.3 nat"));
        m_line->setStatisticUnit("× noise");
        QCOMPARE(shown("Statistic"), QString("2.35 × noise")); // what was read is not forgotten
    }

    void figuresKeepTheirPlaces()
    {
        const QHash<QString, int> empty = places();
        m_line->setReading({3723.5, 9999.5, -33.3, 123.4, -12.345, 600.0});
        QCOMPARE(places(), empty);
        m_line->setReading({0.0, 1.0, 0.0, 0.0, 0.0});
        QCOMPARE(places(), empty);
    }

    void theAgeIsShownWhereItIsKnown()
    {
        m_line->setReading({1.0, 2.0, 3.0, 4.0, 5.0});
        QVERIFY(!figure("Path")->isVisible());
        m_line->setReading({1.0, 2.0, 3.0, 4.0, 5.0, 12.5});
        QVERIFY(figure("Path")->isVisible());
        QVERIFY(m_line->text().endsWith("12.5 s"));
        m_line->setReading({});
        QVERIFY(!figure("Path")->isVisible());
    }

    void theNarrowestLineCutsNoFigureBeforeTheSlope()
    {
        m_line->resize(100, 26);
        QVERIFY(m_line->width() >= 600);
        m_line->setReading({3723.5, 9999.5, -33.3, 123.4, -12.345});
        QCoreApplication::processEvents();
        for (const char *name : {"Time", "Frequency", "Level", "Statistic"}) {
            const QLabel *label = figure(name);
            QVERIFY2(label->width() >= label->fontMetrics().horizontalAdvance(label->text()), name);
            QVERIFY2(label->mapTo(m_line.get(), QPoint(label->width(), 0)).x() <= m_line->width(), name);
        }
    }

    /// Names become symbols, and the last figures give way; what is shown is whole.
    void inANarrowLineNothingIsCut()
    {
        m_line->setStartUnixSeconds(1709164799.0);
        m_line->setReading({3723.5, 9999.5, -33.3, 123.4, -12.345, 61.5});
        for (const int width : {1280, 800, 640, 600, 1280}) {
            m_line->resize(width, 26);
            QCoreApplication::processEvents();
            int shown = 0;
            for (const QLabel *label : m_line->findChildren<QLabel *>()) {
                if (!label->isVisible())
                    continue;
                ++shown;
                QVERIFY2(label->width() >= label->fontMetrics().horizontalAdvance(label->text()),
                         qPrintable(QString("%1 at %2: %3 of %4")
                                        .arg(label->text())
                                        .arg(width)
                                        .arg(label->width())
                                        .arg(label->fontMetrics().horizontalAdvance(label->text()))));
                QVERIFY2(label->mapTo(m_line.get(), QPoint(label->width(), 0)).x() <= m_line->width(),
                         qPrintable(label->text()));
            }
            QCOMPARE(shown == 14, width == 1280); // seven figures with their names
            QVERIFY(shown >= 8);
        }
        QVERIFY(m_line->text().contains("61.5 s")); // copied though it is not seen
    }

    void aLineForThoseWhoCannotSeeIt()
    {
        QCOMPARE(m_line->accessibleName(), QString("Read-out"));
        QCOMPARE(m_line->accessibleDescription(), QString());
        m_line->setReading({83.5, 1065.5, {}, {}, {}});
        QCOMPARE(m_line->accessibleDescription(), QString("83.5 s · 1065.5 Hz"));
    }

    void itIsCopied()
    {
        QApplication::clipboard()->setText("before");
        m_line->setReading({83.5, 1065.5, -1.5, {}, {}});
        chooseCopy();
        QCOMPARE(QApplication::clipboard()->text(), QString("83.5 s · 1065.5 Hz · −1.5 dB"));
    }

    void anEmptyLineIsNotCopied()
    {
        QApplication::clipboard()->setText("before");
        chooseCopy();
        QCOMPARE(QApplication::clipboard()->text(), QString("before"));
    }

private:
    QLabel *figure(const QString &name) const
    {
        for (QLabel *label : m_line->findChildren<QLabel *>())
            if (label->accessibleName() == name)
                return label;
        return nullptr;
    }
    QString shown(const QString &name) const { return figure(name)->text(); }
    /// Left edges of the figures in the line.
    QHash<QString, int> places() const
    {
        QCoreApplication::processEvents();
        QHash<QString, int> result;
        for (const char *name : {"Time", "Frequency", "Level", "Statistic", "Drift"})
            result[name] = figure(name)->mapTo(m_line.get(), QPoint()).x();
        return result;
    }
    /// Opens the context menu, and triggers its only entry.
    void chooseCopy() const
    {
        QTimer::singleShot(0, [] {
            auto *menu = qobject_cast<QMenu *>(QApplication::activePopupWidget());
            QVERIFY(menu);
            QCOMPARE(menu->actions().size(), 1);
            menu->actions().front()->trigger();
            menu->close();
        });
        QContextMenuEvent event(QContextMenuEvent::Mouse, {20, 8}, m_line->mapToGlobal(QPoint(20, 8)));
        QCoreApplication::sendEvent(m_line.get(), &event);
    }

    std::unique_ptr<ReadOut> m_line;
};

FAINTLINE_WINDOW_TEST(tst_ReadOut)
#include "tst_ReadOut.moc"
