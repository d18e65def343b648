#include "app/base/VisibilityWatcher.h"
#include "support/test.h"

#include <QDockWidget>
#include <QMainWindow>
#include <QScrollArea>

using namespace faintline;

/// What lies behind another tab is out of sight, and comes into it when its tab is chosen.
class tst_VisibilityWatcher : public QObject
{
    Q_OBJECT

private slots:
    void aTabChosenComesIntoSight()
    {
        QMainWindow window;
        window.setCentralWidget(new QWidget);
        QWidget *panels[2];
        QDockWidget *docks[2];
        VisibilityWatcher *sights[2];
        for (int i = 0; i < 2; ++i) {
            panels[i] = new QWidget;
            sights[i] = new VisibilityWatcher(*panels[i]); // before it has a place
            docks[i] = new QDockWidget(QString::number(i));
            docks[i]->setWidget(panels[i]);
            window.addDockWidget(Qt::RightDockWidgetArea, docks[i]);
        }
        window.tabifyDockWidget(docks[0], docks[1]);
        docks[0]->raise();
        QVERIFY(!sights[0]->isOn());
        QSignalSpy first(sights[0], &VisibilityWatcher::came);
        QSignalSpy second(sights[1], &VisibilityWatcher::came);
        window.resize(600, 400);
        window.show();
        QVERIFY(QTest::qWaitForWindowExposed(&window));
        QTRY_COMPARE(first.size(), 1);
        QVERIFY(sights[0]->isOn() && !sights[1]->isOn());
        QVERIFY(panels[1]->isVisible()); // as Qt has it
        QCOMPARE(second.size(), 0);

        docks[1]->raise();
        QTRY_COMPARE(second.size(), 1);
        QVERIFY(sights[1]->isOn() && !sights[0]->isOn());
        docks[0]->raise();
        QTRY_COMPARE(first.size(), 2);
        docks[0]->hide();
        QTRY_COMPARE(second.size(), 2); // what was behind it
        QVERIFY(!sights[0]->isOn());
    }

    void whatChildrenCoverIsInSight()
    {
        QWidget window;
        auto *panel = new QWidget(&window);
        auto *area = new QScrollArea(panel);
        area->setAutoFillBackground(true);
        window.resize(300, 200);
        panel->setGeometry(window.rect());
        area->setGeometry(panel->rect());
        QVERIFY(!isInSight(*panel)); // not shown yet
        window.show();
        QVERIFY(isInSight(*panel));
        panel->move(300, 0);
        QVERIFY(!isInSight(*panel));
        QVERIFY(!isInSight(*area));
    }
};

FAINTLINE_WINDOW_TEST(tst_VisibilityWatcher)
#include "tst_VisibilityWatcher.moc"
