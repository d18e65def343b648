#include "app/Panels.h"

#include <QAction>
#include <QDockWidget>
#include <QMainWindow>
#include <QMenuBar>
#include <QStatusBar>
#include <QToolBar>

namespace faintline {

namespace {

    Qt::DockWidgetArea areaOf(Panels::Place place)
    {
        switch (place) {
        case Panels::Place::Left:
            return Qt::LeftDockWidgetArea;
        case Panels::Place::Bottom:
            return Qt::BottomDockWidgetArea;
        case Panels::Place::RightTop:
        case Panels::Place::RightBottom:
            break;
        }
        return Qt::RightDockWidgetArea;
    }

} // namespace

Panels::Panels(QMainWindow &window) : QObject(&window), m_window(window)
{
    window.setDockNestingEnabled(true);
    window.setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
    window.setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
    window.setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
}

void Panels::add(const QString &name, const QString &title, QWidget *panel, Place place)
{
    auto *dock = new QDockWidget(title);
    dock->setObjectName(name);
    dock->setWidget(panel);
    m_window.addDockWidget(areaOf(place), dock);
    if (QDockWidget *before = last(place)) {
        m_window.tabifyDockWidget(before, dock);
        first(place)->raise();
    } else if (QDockWidget *above = place == Place::RightBottom ? last(Place::RightTop) : nullptr) {
        m_window.splitDockWidget(above, dock, Qt::Vertical);
    }
    dock->setHidden(place == Place::Bottom);
    m_entries.push_back({dock, place});
}

void Panels::rememberDefault()
{
    m_default = m_window.saveState();
}

void Panels::takeDefault()
{
    m_window.restoreState(m_default);
    const int width = m_window.width();
    m_window.resizeDocks({first(Place::Left), first(Place::RightTop)}, {width * 17 / 100, width * 22 / 100}, Qt::Horizontal);
    m_window.resizeDocks({first(Place::RightTop), first(Place::RightBottom)}, {1, 1}, Qt::Vertical);
}

void Panels::show(QWidget *panel)
{
    auto *dock = static_cast<QDockWidget *>(panel->parentWidget());
    const bool wasHidden = dock->isHidden();
    dock->show();
    dock->raise();
    if (wasHidden && m_window.dockWidgetArea(dock) == Qt::BottomDockWidgetArea)
        m_window.resizeDocks({dock}, {m_window.height() * 36 / 100}, Qt::Vertical);
}

void Panels::hide()
{
    for (const Entry &entry : m_entries)
        entry.dock->hide();
}

QList<QAction *> Panels::toggleActions() const
{
    QList<QAction *> result;
    for (const Entry &entry : m_entries)
        result.append(entry.dock->toggleViewAction());
    return result;
}

void Panels::setPresenting(bool isPresenting)
{
    if (isPresenting)
        m_beforePresenting = m_window.saveState();
    for (QToolBar *bar : m_window.findChildren<QToolBar *>())
        bar->setVisible(!isPresenting);
    for (const Entry &entry : m_entries)
        entry.dock->setVisible(!isPresenting);
    m_window.menuBar()->setVisible(!isPresenting);
    m_window.statusBar()->setVisible(!isPresenting);
    m_window.setWindowState(m_window.windowState().setFlag(Qt::WindowFullScreen, isPresenting));
    if (!isPresenting)
        m_window.restoreState(m_beforePresenting);
}

QDockWidget *Panels::first(Place place) const
{
    for (const Entry &entry : m_entries)
        if (entry.place == place)
            return entry.dock;
    return nullptr;
}

QDockWidget *Panels::last(Place place) const
{
    QDockWidget *result = nullptr;
    for (const Entry &entry : m_entries)
        if (entry.place == place)
            result = entry.dock;
    return result;
}

} // namespace faintline
