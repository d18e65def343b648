#include "walks/Walk.h"

#include "app/window/programWindows.h"
#include "support/slowdown.h"
#include "widgets/base/Theme.h"
#include "widgets/waterfall/WaterfallPicture.h"

#include <qwt_plot_canvas.h>

#include <QAbstractButton>
#include <QAccessible>
#include <QApplication>
#include <QDir>
#include <QElapsedTimer>
#include <QFileInfo>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QTabBar>
#include <QThread>
#include <QWindow>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>

namespace faintline::test {

namespace {

    constexpr int patience = 180'000 * slowdown; // ms
    constexpr int glance = 50;                   // ms between two looks
    const QPoint nowhere(-1, -1);

    QString plain(QString text)
    {
        return text.remove(u'&').remove(u'…');
    }

    /// The name that a user reads or hears.
    QString nameOf(QWidget *widget)
    {
        QAccessibleInterface *spoken = QAccessible::queryAccessibleInterface(widget);
        return plain(spoken ? spoken->text(QAccessible::Name) : widget->accessibleName());
    }

    bool isReachable(QWidget *widget)
    {
        QWidget *modal = QApplication::activeModalWidget();
        return widget->isVisible() && widget->isEnabled() && (!modal || widget->window() == modal)
               && widget->window()->windowHandle() && widget->window()->windowHandle()->isExposed();
    }

    /// Where the pointer hits the widget or a part of it; nowhere if something lies above.
    QPoint hit(QWidget *widget, const QPoint &local)
    {
        const QPoint global = widget->mapToGlobal(local);
        QWidget *top = QApplication::widgetAt(global);
        return top && (top == widget || widget->isAncestorOf(top)) ? global : nowhere;
    }

    QPoint placeNamed(const QString &name, const char *kind)
    {
        for (QWidget *widget : QApplication::allWidgets()) {
            if (!widget->inherits(kind) || !isReachable(widget) || nameOf(widget) != name)
                continue;
            if (const QPoint at = hit(widget, widget->visibleRegion().boundingRect().center()); at != nowhere)
                return at;
        }
        return nowhere;
    }

    QPoint placeOfTab(const QString &title)
    {
        for (QWidget *widget : QApplication::allWidgets())
            if (auto *bar = qobject_cast<QTabBar *>(widget); bar && isReachable(bar))
                for (int tab = 0; tab < bar->count(); ++tab)
                    if (plain(bar->tabText(tab)) == title)
                        if (const QPoint at = hit(bar, bar->tabRect(tab).center()); at != nowhere)
                            return at;
        return nowhere;
    }

    QPoint placeOfEntry(QWidget &menu, const QString &entry, const std::function<QRect(QAction *)> &place)
    {
        for (QAction *action : menu.actions())
            if (action->isVisible() && action->isEnabled() && plain(action->text()) == entry && isReachable(&menu))
                return hit(&menu, place(action).center());
        return nowhere;
    }

    bool reads(const QString &part)
    {
        for (QWidget *widget : QApplication::allWidgets()) {
            if (!widget->isVisible())
                continue;
            auto *label = qobject_cast<QLabel *>(widget);
            auto *button = qobject_cast<QAbstractButton *>(widget);
            const QString text = label ? label->text() : button ? button->text() : QString();
            if (text.contains(part) || (widget->isWindow() && widget->windowTitle().contains(part)))
                return true;
        }
        return false;
    }

    void savePicture(const QString &path)
    {
        QDir().mkpath(QFileInfo(path).path());
        QGuiApplication::primaryScreen()->grabWindow(0).save(path);
    }

} // namespace

int Walk::run(const char *name, int argc, char **argv, void (*way)(Walk &))
{
    Theme::prepareForPictures();
    QApplication application(argc, argv);
    QApplication::setApplicationName(QStringLiteral("faintline"));
    QApplication::setQuitOnLastWindowClosed(false);
    Walk walk;
    std::unique_ptr<QThread> user(QThread::create([&] {
        try {
            way(walk);
        } catch (const std::exception &error) {
            const QString picture = QDir::current().filePath(QStringLiteral("walk-%1.png").arg(QLatin1String(name)));
            walk.see([&] { return savePicture(picture), true; });
            std::fprintf(stderr, "walk %s: %s; the screen: %s\n", name, error.what(), qPrintable(picture));
            std::fflush(stderr);
            std::_Exit(1); // a menu or a dialog may still be waiting
        }
        walk.see([] { return QCoreApplication::exit(), true; }); // quit() would ask whether to save
    }));
    user->start();
    QApplication::exec();
    user->wait();
    walk.m_windows.clear();
    return 0;
}

void Walk::start(const std::vector<std::string> &files)
{
    see([&] {
        m_windows.clear();
        m_windows = programWindows(files, {});
        return true;
    });
    waitUntil("the window is in front", [&] { return window().isActiveWindow() && isReachable(&window()); });
}

void Walk::waitUntil(const QString &what, const std::function<bool()> &isSo)
{
    QElapsedTimer timer;
    timer.start();
    while (!see(isSo)) {
        if (timer.elapsed() > patience)
            throw std::runtime_error("not seen: " + what.toStdString());
        QThread::msleep(glance);
    }
    std::printf("%s\n", qPrintable(what));
    std::fflush(stdout);
}

void Walk::waitForResults()
{
    waitUntil("results", [&] {
        return !window().controller().isBusy() && !window().sequentialTests().isBusy()
               && (window().document().isEmpty() || window().document().isCurrent());
    });
}

void Walk::takePicture(const QString &name)
{
    if (const QString folder = qEnvironmentVariable("FAINTLINE_WALK_PICTURES"); !folder.isEmpty())
        see([&] { return savePicture(QDir(folder).filePath(name + QStringLiteral(".png"))), true; });
}

QPoint Walk::waitForPlace(const QString &what, const std::function<QPoint()> &place)
{
    QPoint found = nowhere;
    waitUntil(what, [&] {
        const QPoint before = std::exchange(found, place());
        return found != nowhere && found == before; // what is still moving is not yet clicked
    });
    return found;
}

QPoint Walk::placeOf(const QString &name, const char *kind)
{
    return waitForPlace(name, [&] { return placeNamed(name, kind); });
}

QPoint Walk::placeIn(const std::function<QWidget *()> &widget, const std::function<QPointF()> &part)
{
    return waitForPlace("a place in a picture", [&] {
        QWidget *where = widget();
        return where && isReachable(where) ? hit(where, part().toPoint()) : nowhere;
    });
}

QPoint Walk::placeIn(WaterfallPicture &picture, double seconds, double hz)
{
    return placeIn([&] { return picture.canvas(); }, [&] { return picture.positionOf({seconds, hz}); });
}

void Walk::waitForText(const QString &part)
{
    waitUntil(part, [&] { return reads(part); });
}

void Walk::clickTab(const QString &title)
{
    hand.click(waitForPlace("tab " + title, [&] { return placeOfTab(title); }));
}

void Walk::choose(const QStringList &way)
{
    hand.click(waitForPlace("menu " + way.front(), [&] {
        QMenuBar *bar = window().menuBar();
        return placeOfEntry(*bar, way.front(), [bar](QAction *action) { return bar->actionGeometry(action); });
    }));
    for (const QString &entry : way.mid(1))
        pick(entry);
}

void Walk::pick(const QString &entry)
{
    hand.click(waitForPlace("entry " + entry, [&] {
        auto *menu = qobject_cast<QMenu *>(QApplication::activePopupWidget());
        return menu ? placeOfEntry(*menu, entry, [menu](QAction *action) { return menu->actionGeometry(action); })
                    : nowhere;
    }));
}

void Walk::fillIn(const QString &name, const QString &text)
{
    click(name);
    hand.press("ctrl+a");
    hand.type(text);
    hand.press("Return");
}

void Walk::answerFileDialog(const QString &title, const QString &file)
{
    const auto isOpen = [&] {
        QWidget *dialog = QApplication::activeModalWidget();
        return dialog && dialog->windowTitle() == title && dialog->isActiveWindow();
    };
    waitUntil("dialog " + title, isOpen);
    fillIn("File name:", file);
    waitUntil("no dialog", [] { return !QApplication::activeModalWidget(); });
}

} // namespace faintline::test
