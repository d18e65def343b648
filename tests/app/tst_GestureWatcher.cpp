#include "app/base/GestureWatcher.h"
#include "support/test.h"

#include <QSpinBox>
#include <QWheelEvent>

using namespace faintline;

/// Where one gesture of keys, buttons and wheel ends, and the next begins.
class tst_GestureWatcher : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_box = std::make_unique<QSpinBox>();
        m_box->show();
        m_watcher = std::make_unique<GestureWatcher>();
        m_began = std::make_unique<QSignalSpy>(m_watcher.get(), &GestureWatcher::began);
        m_ended = std::make_unique<QSignalSpy>(m_watcher.get(), &GestureWatcher::ended);
    }

    void eachKeyIsOne()
    {
        sendKey(QEvent::KeyPress, false);
        QCOMPARE(beginnings(), 1);
        sendKey(QEvent::KeyRelease, false);
        QCOMPARE(m_ended->count(), 0); // who handles the release still belongs to it
        QCOMPARE(endings(), 1);
        sendKey(QEvent::KeyPress, false);
        sendKey(QEvent::KeyRelease, false);
        QCOMPARE(beginnings(), 2);
        QCOMPARE(endings(), 2);
    }

    void aHeldKeyIsOne()
    {
        sendKey(QEvent::KeyPress, false);
        for (int i = 0; i < 5; ++i) {
            sendKey(QEvent::KeyRelease, true);
            sendKey(QEvent::KeyPress, true);
        }
        QCOMPARE(beginnings(), 1);
        QCOMPARE(endings(), 0);
        sendKey(QEvent::KeyRelease, false);
        QCOMPARE(endings(), 1);
        // A press before the end has come is the next gesture's, which that end does not cut short.
        sendKey(QEvent::KeyPress, false);
        sendKey(QEvent::KeyRelease, false);
        sendKey(QEvent::KeyPress, false);
        QCOMPARE(beginnings(), 3);
        QCOMPARE(endings(), 1);
    }

    void theReleaseOfAnotherKeyDoesNotEndIt()
    {
        sendKey(QEvent::KeyPress, false, Qt::Key_Up);
        sendKey(QEvent::KeyPress, false, Qt::Key_Down);
        QCOMPARE(beginnings(), 2);
        sendKey(QEvent::KeyRelease, false, Qt::Key_Up);
        QCOMPARE(endings(), 0);
        sendKey(QEvent::KeyRelease, false, Qt::Key_Down);
        QCOMPARE(endings(), 1);
        QCOMPARE(beginnings(), 2);
    }

    void aKeyIsTheSameWithAndWithoutShift()
    {
        constexpr int place = 10;
        for (int i = 1; i <= 2; ++i) {
            sendKeyAt(place, QEvent::ShortcutOverride, Qt::Key_Exclam); // Qt makes one without a place of a KeyPress
            QCOMPARE(beginnings(), i);
            sendKeyAt(place, QEvent::KeyRelease, Qt::Key_1);
            QCOMPARE(endings(), i);
        }
    }

    void aDragIsOne()
    {
        QTest::mousePress(line(), Qt::LeftButton);
        const int begun = beginnings();
        QVERIFY(begun >= 1);
        QTest::mouseMove(line(), {3, 3});
        QCOMPARE(beginnings(), begun);
        QCOMPARE(endings(), 0);
        QTest::mouseRelease(line(), Qt::LeftButton);
        QCOMPARE(endings(), 1);
        QCOMPARE(beginnings(), begun);
    }

    void aModifierIsPartOfTheDrag()
    {
        for (const Qt::Key key : {Qt::Key_Shift, Qt::Key_Control, Qt::Key_Alt, Qt::Key_Meta, Qt::Key_AltGr}) {
            QTest::mousePress(line(), Qt::LeftButton);
            const int begun = beginnings();
            const int ended = endings();
            sendKey(QEvent::KeyPress, false, key);
            sendKey(QEvent::KeyRelease, false, key);
            QCOMPARE(beginnings(), begun);
            QCOMPARE(endings(), ended);
            QTest::mouseRelease(line(), Qt::LeftButton);
            QCOMPARE(endings(), ended + 1);
        }
    }

    void leavingTheApplicationEndsIt()
    {
        QEvent leave(QEvent::ApplicationDeactivate);
        sendKey(QEvent::KeyPress, false);
        QCoreApplication::sendEvent(qApp, &leave);
        QCOMPARE(endings(), 1);
        sendKey(QEvent::KeyPress, false); // its release went elsewhere
        QCOMPARE(beginnings(), 2);
        sendKey(QEvent::KeyRelease, false);
        QCOMPARE(endings(), 2);
    }

    void aWheelIsOneUntilThePress()
    {
        for (int i = 0; i < 4; ++i)
            turnWheel();
        QCOMPARE(beginnings(), 1);
        sendKey(QEvent::KeyPress, false);
        sendKey(QEvent::KeyRelease, false);
        QCOMPARE(beginnings(), 2);
        turnWheel();
        QCOMPARE(beginnings(), 3);
    }

private:
    /// A key's press or release, of its repetition where `isRepeated`.
    void sendKey(QEvent::Type type, bool isRepeated, Qt::Key key = Qt::Key_Up)
    {
        QKeyEvent event(type, key, Qt::NoModifier, QString(), isRepeated);
        QCoreApplication::sendEvent(m_box.get(), &event);
    }
    void sendKeyAt(int scanCode, QEvent::Type type, Qt::Key key)
    {
        QKeyEvent event(type, key, Qt::NoModifier, quint32(scanCode), 0, 0);
        QCoreApplication::sendEvent(m_box.get(), &event);
    }
    QWidget *line() const { return m_box->findChild<QWidget *>(QStringLiteral("qt_spinbox_lineedit")); }
    void turnWheel()
    {
        const QPointF middle(5.0, 5.0);
        QWheelEvent event(middle, m_box->mapToGlobal(middle), {}, {0, 120}, Qt::NoButton, Qt::NoModifier,
                          Qt::NoScrollPhase, false);
        QCoreApplication::sendEvent(m_box.get(), &event);
    }
    int beginnings() const { return int(m_began->count()); }
    int endings() const
    {
        QCoreApplication::processEvents();
        return int(m_ended->count());
    }

    std::unique_ptr<QSpinBox> m_box;
    std::unique_ptr<GestureWatcher> m_watcher;
    std::unique_ptr<QSignalSpy> m_began;
    std::unique_ptr<QSignalSpy> m_ended;
};

FAINTLINE_WINDOW_TEST(tst_GestureWatcher)
#include "tst_GestureWatcher.moc"
