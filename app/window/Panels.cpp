#include "app/window/Panels.h"

#include "app/base/Panel.h"
#include "app/base/VisibilityWatcher.h"
#include "app/base/screenSizes.h"

#include <QAction>
#include <QApplication>
#include <QChildEvent>
#include <QDockWidget>
#include <QLayout>
#include <QMainWindow>
#include <QMenuBar>
#include <QScopedValueRollback>
#include <QScreen>
#include <QTabBar>
#include <QToolBar>

#include <algorithm>
#include <cmath>
#include <utility>

namespace faintline {

namespace {

    constexpr int narrowestColumn = 280;
    /// Height to which panels below the threshold can be reduced, also those whose content wishes for more.
    constexpr int leastPanel = 165;
    /// Size to which sheets at the bottom can be reduced, so that a window with them fits small screens.
    constexpr QSize leastSheet(420, 90);
    /// Size of a panel's text in presentations; on smaller screens the pictures need the room.
    constexpr double presentedText = 1.4;

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

    struct Layout {
        const char *name;
        QStringList docks; ///< visible docks, the front tab last; empty: as they were added
    };

    const std::vector<Layout> &layouts()
    {
        static const std::vector<Layout> all{
            {QT_TRANSLATE_NOOP("faintline::Panels", "Analyse"),
             {"thresholdDock", "settingsDock", "whyDock", "eventsDock"}},
            {QT_TRANSLATE_NOOP("faintline::Panels", "Researcher"), {}},
            {QT_TRANSLATE_NOOP("faintline::Panels", "Active sonar"), {"thresholdDock", "eventsDock", "statesDock"}},
            {QT_TRANSLATE_NOOP("faintline::Panels", "Sequential test"), {"sequentialDock"}},
            {QT_TRANSLATE_NOOP("faintline::Panels", "Evaluate"),
             {"experimentsDock", "reproductionDock", "evaluateDock"}},
        };
        return all;
    }

    constexpr const char *usualSize = "usualTextSize";

    bool isInPlot(const QWidget &widget)
    {
        for (const QWidget *each = &widget; each; each = each->parentWidget())
            if (each->inherits("QwtPlot") || each->inherits("faintline::ChartPlot"))
                return true;
        return false;
    }

    void scaleOwnFont(QWidget &widget, double scale)
    {
        if (!widget.property(usualSize).isValid())
            widget.setProperty(usualSize, widget.font().pixelSize());
        QFont font = widget.font();
        font.setPixelSize(int(std::lround(widget.property(usualSize).toInt() * scale)));
        widget.setFont(font);
    }

    /// Relative to the usual size. Plots are left alone: they follow Theme::setPlotScale.
    void scaleText(QWidget &panel, double scale)
    {
        QFont inherited = QApplication::font();
        inherited.setPixelSize(int(std::lround(inherited.pixelSize() * scale)));
        panel.setFont(scale == 1.0 ? QFont() : inherited);
        for (QWidget *widget : panel.findChildren<QWidget *>())
            if (widget->testAttribute(Qt::WA_SetFont) && !isInPlot(*widget))
                scaleOwnFont(*widget, scale);
    }

} // namespace

Panels::Panels(QMainWindow &window) : QObject(&window), m_window(window)
{
    window.setDockNestingEnabled(true);
    window.setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
    window.setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
    window.setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
    window.installEventFilter(this);
}

void Panels::add(const PanelRow &row, QWidget &panel)
{
    auto *dock = new QDockWidget(row.title);
    dock->setObjectName(row.dock);
    dock->setWidget(&panel);
    if (row.place == Place::RightBottom)
        panel.setMinimumHeight(std::min(leastPanel, panel.minimumSizeHint().height()));
    if (row.place == Place::Bottom)
        panel.setMinimumSize(panel.minimumSizeHint().boundedTo(leastSheet));
    m_window.addDockWidget(areaOf(row.place), dock);
    if (QDockWidget *before = last(row.place)) {
        m_window.tabifyDockWidget(before, dock);
        first(row.place)->raise();
    } else if (QDockWidget *above = row.place == Place::RightBottom ? last(Place::RightTop) : nullptr) {
        m_window.splitDockWidget(above, dock, Qt::Vertical);
    }
    dock->setHidden(row.isHidden || row.place == Place::Bottom);
    dock->toggleViewAction()->setShortcut(row.key);
    connect(dock->toggleViewAction(), &QAction::triggered, dock, [this, dock](bool isShown) {
        if (isShown)
            bringForward(*dock, true);
    });
    connect(dock, &QDockWidget::topLevelChanged, dock, [dock](bool isFloating) {
        if (!isFloating)
            dock->raise(); // it returns behind the panel that took its place
    });
    if (auto *own = qobject_cast<Panel *>(&panel))
        connect(dock, &QDockWidget::visibilityChanged, own, &Panel::setSeen);
    m_entries.push_back({dock, row.place});
}

bool Panels::eventFilter(QObject *watched, QEvent *event)
{
    if (event->type() == QEvent::ChildPolished)
        if (auto *bar = qobject_cast<QTabBar *>(static_cast<QChildEvent *>(event)->child()))
            bar->setAutoHide(true);
    return QObject::eventFilter(watched, event);
}

void Panels::nameHolders()
{
    for (QWidget *widget : m_window.findChildren<QWidget *>()) {
        const bool isHolder = widget->inherits("QScrollArea") || widget->inherits("QTabWidget");
        if (!isHolder || !widget->accessibleName().isEmpty())
            continue;
        QWidget *panel = widget->parentWidget();
        while (panel && panel->windowTitle().isEmpty() && panel != &m_window)
            panel = panel->parentWidget();
        widget->setAccessibleName(panel && panel != &m_window ? panel->windowTitle() : tr("Welcome"));
    }
}

void Panels::rememberDefault()
{
    nameHolders();
    m_default = m_window.saveState();
}

void Panels::takeDefault()
{
    std::vector<QToolBar *> hidden; // their visibility depends on the open document, not on the layout
    for (QToolBar *bar : m_window.findChildren<QToolBar *>())
        if (bar->isHidden())
            hidden.push_back(bar);
    const QSize size = m_window.size();
    m_window.layout()->setSizeConstraint(QLayout::SetNoConstraint); // the default may need more than a small screen
    m_window.restoreState(m_default);
    for (QToolBar *bar : hidden)
        bar->hide();
    arrangeColumns(size);
    m_window.layout()->setSizeConstraint(QLayout::SetDefaultConstraint);
}

/// In a window of that size: two columns, one, or none beside the pictures.
void Panels::arrangeColumns(const QSize &size)
{
    QDockWidget *left = first(Place::Left), *right = first(Place::RightTop);
    const bool isNarrow = size.width() < twoColumnsFrom;
    if (isNarrow) {
        for (const Entry &entry : m_entries)
            if (entry.place == Place::Left)
                m_window.tabifyDockWidget(right, entry.dock);
        right->raise();
    }
    m_window.resizeDocks({left, right}, {size.width() * 16 / 100, std::max(narrowestColumn, size.width() * 18 / 100)},
                         Qt::Horizontal);
    if (size.height() >= twoRowsFrom) {
        const int height = size.height() * 3 / 4; // of the column; sizes below the panels' minimum would not count
        const int top = isNarrow ? height * 2 / 3 : height * 4 / 9;
        m_window.resizeDocks({right, first(Place::RightBottom)}, {top, height - top}, Qt::Vertical);
        return;
    }
    for (const Entry &entry : m_entries)
        if (entry.place == Place::RightBottom)
            m_window.tabifyDockWidget(right, entry.dock);
    right->raise();
    if (size.width() < oneColumnFrom)
        hide();
}

void Panels::show(QWidget &panel)
{
    auto *dock = static_cast<QDockWidget *>(panel.parentWidget());
    const bool wasHidden = dock->isHidden();
    dock->show();
    bringForward(*dock, wasHidden);
}

/// From behind other tabs; a sheet that was hidden gets a usable height.
void Panels::bringForward(QDockWidget &dock, bool wasHidden)
{
    m_latest = &dock;
    dock.raise();
    m_window.layout()->activate(); // so that it has its place at once
    if (wasHidden && !dock.isFloating() && m_window.dockWidgetArea(&dock) == Qt::BottomDockWidgetArea)
        raiseFromBottom(&dock, 36);
}

/// Gives a dock at the bottom `percent` of the window's height, or what the pictures leave.
void Panels::raiseFromBottom(QDockWidget *dock, int percent)
{
    for (int pass = 0; pass < 2; ++pass) { // a dock that was hidden has its place among the tabs after the first
        m_window.layout()->activate();
        const int room = m_window.centralWidget()->height() + dock->height() + tabHeight(*dock) - m_leastPictures;
        m_window.resizeDocks({dock}, {std::min(m_window.height() * percent / 100, room)}, Qt::Vertical);
    }
}

/// Of the tabs directly above a dock, which resizeDocks counts as part of it.
int Panels::tabHeight(const QDockWidget &dock) const
{
    const QRect above(dock.x(), dock.y() - 8, dock.width(), 8);
    for (const QTabBar *bar : m_window.findChildren<QTabBar *>(Qt::FindDirectChildrenOnly))
        if (bar->isVisible() && bar->geometry().intersects(above))
            return bar->height();
    return 0;
}

QStringList Panels::layoutNames()
{
    QStringList names;
    for (const Layout &layout : layouts())
        names.append(tr(layout.name));
    return names;
}

QString Panels::analyse()
{
    return layoutNames()[0];
}

QString Panels::researcher()
{
    return layoutNames()[1];
}

/// In a high column, why an event was found is below the list of events; the list has room for the card of the
/// selected one.
void Panels::stackEvents()
{
    QDockWidget *events = dock("eventsDock"), *why = dock("whyDock");
    if (m_window.height() < threeRowsFrom) {
        const int column = m_window.height() * 3 / 4;
        m_window.resizeDocks({first(Place::RightTop), events}, {column * 2 / 5, column * 3 / 5}, Qt::Vertical);
        return;
    }
    m_window.addDockWidget(Qt::RightDockWidgetArea, why, Qt::Vertical); // out of their common tabs
    events->raise();
    const int height = m_window.height() * 3 / 4;
    m_window.resizeDocks({first(Place::RightTop), events, why}, {height / 3, height * 5 / 12, height / 4},
                         Qt::Vertical);
}

void Panels::takeLayout(const QString &name)
{
    const auto index = layoutNames().indexOf(name);
    if (index < 0)
        return;
    takeDefault();
    const Layout &layout = layouts()[std::size_t(index)];
    const bool isTooSmall = name == analyse() && first(Place::RightTop)->isHidden();
    if (layout.docks.isEmpty() || isTooSmall)
        return;
    for (const Entry &entry : m_entries)
        entry.dock->setVisible(layout.docks.contains(entry.dock->objectName()));
    if (name == analyse())
        stackEvents();
    for (const QString &shown : layout.docks)
        if (QDockWidget *own = dock(shown))
            own->raise();
    for (const QString &shown : layout.docks)
        if (QDockWidget *own = dock(shown); own && m_window.dockWidgetArea(own) == Qt::BottomDockWidgetArea)
            raiseFromBottom(own, m_window.height() < threeRowsFrom ? 38 : 48); // the pictures keep 200 each
}

void Panels::toggleMaximised()
{
    if (restoreMaximised())
        return;
    QDockWidget *chosen = nullptr;
    for (QWidget *widget = QApplication::focusWidget(); widget && !chosen; widget = widget->parentWidget())
        chosen = qobject_cast<QDockWidget *>(widget);
    if (!chosen && m_latest && isInSight(*m_latest))
        chosen = m_latest;
    for (const Entry &entry : m_entries)
        if (!chosen && entry.place == Place::Bottom && isInSight(*entry.dock))
            chosen = entry.dock;
    if (!chosen)
        return;
    m_before = chosen->isFloating() ? chosen->geometry() : QRect();
    m_maximised = chosen;
    chosen->setFloating(true);
    chosen->setGeometry(QRect(m_window.mapToGlobal(QPoint()), m_window.size()));
    chosen->activateWindow();
}

bool Panels::restoreMaximised()
{
    QDockWidget *dock = std::exchange(m_maximised, nullptr);
    if (!dock || !dock->isFloating() || dock->isHidden())
        return false;
    if (m_before.isValid())
        dock->setGeometry(m_before);
    else
        dock->setFloating(false);
    dock->raise();
    return true;
}

QDockWidget *Panels::dock(const QString &name) const
{
    for (const Entry &entry : m_entries)
        if (entry.dock->objectName() == name)
            return entry.dock;
    return nullptr;
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
    const QScopedValueRollback rearranging(m_isRearranging, true);
    if (isPresenting)
        m_beforePresenting = m_window.saveState();
    for (QToolBar *bar : m_window.findChildren<QToolBar *>())
        if (bar->objectName() != QLatin1String("readOutBar")) // what is clicked on is read there
            bar->setVisible(!isPresenting);
    constexpr int leastPicture = 100; // pixels; below, a panel has taken the pictures' place and is what is presented
    if (!isPresenting || m_window.centralWidget()->height() >= leastPicture)
        for (const Entry &entry : m_entries)
            entry.dock->setVisible(!isPresenting);
    m_window.menuBar()->setVisible(!isPresenting);
    m_window.setWindowState(m_window.windowState().setFlag(Qt::WindowFullScreen, isPresenting));
    const int width = std::max(m_window.width(), m_window.screen()->size().width()); // full screen comes later
    for (const Entry &entry : m_entries)
        scaleText(*entry.dock, isPresenting && width >= twoColumnsFrom ? presentedText : 1.0);
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
