// A panel costs one row of the list: a toy is in the menu, is shown by its name, rendered, and on the sheet of keys.

#include "app/commands/keySections.h"
#include "app/headless/RenderOptions.h"
#include "app/headless/renderCommand.h"
#include "app/openWindow.h"
#include "app/views/WindowViews.h"
#include "app/views/panelList.h"
#include "support/test.h"

#include <QDockWidget>
#include <QMenuBar>
#include <QPainter>

using namespace faintline;
using namespace faintline::test;

namespace {

/// Green once the document is analysed.
class Toy : public QWidget
{
public:
    explicit Toy(const Document &document)
    {
        connect(&document, &Document::analysisChanged, this, [this] {
            m_colour = Qt::green;
            update();
        });
    }

protected:
    void paintEvent(QPaintEvent *) override { QPainter(this).fillRect(rect(), m_colour); }

private:
    QColor m_colour = Qt::red;
};

const QString scene = ":/lessons/scenes/two-near-lines.json";

} // namespace

class tst_panelList : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        panelList().push_back({"toyDock", "Toy", PanelRow::Place::Bottom,
                               [](WindowParts &parts) { return new Toy(parts.document()); }, "toy",
                               PanelRow::Of::Recording, Qt::Key_F9});
    }

    void rowIsAMenuEntryWithItsKey()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, scene));
        auto *dock = window->findChild<QDockWidget *>("toyDock");
        QVERIFY(dock->isHidden());
        QTest::keyClick(window.get(), Qt::Key_F9);
        QVERIFY(!dock->isHidden());
        QStringList panels;
        for (const QAction *menu : window->menuBar()->actions())
            for (const QAction *entry : menu->menu()->actions())
                for (const QAction *panel : entry->menu() ? entry->menu()->actions() : QList<QAction *>())
                    panels << entry->text().remove('&') + "/" + panel->text();
        QVERIFY2(panels.contains("Panels/Toy"), qPrintable(panels.join(' ')));
        bool isOnTheSheet = false;
        for (const KeySection &section : generalKeys({}, window->menuBar()->actions()))
            for (const auto &[keys, does] : section.entries)
                isOnTheSheet |= keys == "F9" && does == "Toy";
        QVERIFY(isOnTheSheet);
    }

    void rowIsShownByTheNameOfItsView()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, scene));
        window->showView("toy");
        QVERIFY(window->docked("toyDock")->isVisible());
        QCOMPARE(window->views().named("toy"), window->docked("toyDock"));
    }

    void rowIsRendered()
    {
        const QTemporaryDir folder;
        RenderOptions options;
        options.source = scene.toStdString();
        options.out = folder.filePath("toy.png").toStdString();
        options.views = {"toy"};
        options.size = {320, 200};
        render(options);
        const QImage picture(folder.filePath("toy.png"));
        QCOMPARE(picture.size(), QSize(320, 200));
        QCOMPARE(picture.pixelColor(160, 100), QColor(Qt::green));
    }
};

FAINTLINE_WINDOW_TEST(tst_panelList)
#include "tst_panelList.moc"
