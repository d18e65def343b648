#include "app/lessons/LessonLayout.h"

#include "app/base/screenSizes.h"
#include "app/features/evaluate/EvaluatePanel.h"
#include "app/features/sequential/SequentialControls.h"
#include "app/features/sequential/SequentialPanel.h"
#include "app/lessons/LessonPanel.h"
#include "app/views/WindowParts.h"

#include <QDockWidget>
#include <QMainWindow>
#include <QScreen>
#include <QTabWidget>

#include <qwt_plot.h>

#include <algorithm>
#include <utility>

namespace faintline {

namespace {

    /// Words a shown lesson's panel has room for, as a share of the window.
    constexpr int panelPercent = 22;

    QList<QDockWidget *> docksOf(const QMainWindow &window)
    {
        return window.findChildren<QDockWidget *>(Qt::FindDirectChildrenOnly);
    }

} // namespace

LessonLayout::LessonLayout(QMainWindow &window, WindowParts &parts, LessonPanel &panel)
    : m_window(window), m_parts(parts), m_panel(panel), m_dock(new QDockWidget(QObject::tr("Lesson"), &window))
{
    m_dock->setObjectName(QStringLiteral("lessonDock"));
    m_dock->setWidget(&panel);
    m_dock->setFeatures(QDockWidget::DockWidgetMovable
                        | QDockWidget::DockWidgetFloatable); // a lesson is left with its button
    m_dock->hide();
}

void LessonLayout::setPresenting(bool isPresenting)
{
    m_panel.setLarge(isPresenting);
    m_isPresenting = isPresenting;
    if (!isPresenting)
        setFormsVisible(true);
}

void LessonLayout::showDock(bool isOfScans)
{
    const bool isAlone = isOfScans && !m_parts.bench().isVisible();
    if (std::exchange(m_isAlone, isAlone) == isAlone && !m_dock->isHidden())
        return;
    m_window.addDockWidget(isAlone ? Qt::BottomDockWidgetArea : Qt::LeftDockWidgetArea, m_dock,
                           isAlone ? Qt::Horizontal : Qt::Vertical);
    auto *below = m_window.findChild<QDockWidget *>(QStringLiteral("pipelineDock"));
    if (below && !isAlone && m_window.dockWidgetArea(below) == Qt::LeftDockWidgetArea) {
        m_window.splitDockWidget(m_dock, below, Qt::Vertical);
        m_dock->show();
        if (!below->isHidden())
            m_window.resizeDocks({m_dock, below}, {7, 3}, Qt::Vertical);
    }
    m_dock->show();
    m_window.resizeDocks({m_dock}, {m_window.width() * panelPercent / 100}, Qt::Horizontal);
}

void LessonLayout::reveal(QWidget *widget)
{
    for (QWidget *each = widget; each; each = each->parentWidget()) {
        auto *above = each->parentWidget() ? qobject_cast<QTabWidget *>(each->parentWidget()->parentWidget()) : nullptr;
        if (above && above->indexOf(each) >= 0)
            above->setCurrentWidget(each);
        if (auto *dock = qobject_cast<QDockWidget *>(each)) {
            dock->show();
            dock->raise();
        }
    }
}

void LessonLayout::pointOut(QWidget *target, const QList<QWidget *> &others, bool isForInput)
{
    for (QWidget *other : others)
        reveal(other);
    putAway(target, others);
    setFormsVisible(!m_isPresenting || (isForInput && !qobject_cast<const QwtPlot *>(target)));
    reveal(target);
    takeOneColumn();
    reveal(target);
    fit(target);
}

void LessonLayout::fit(QWidget *target)
{
    widenChart(target);
    shareColumn();
}

/// In a presentation, a chart in a column beside the lesson's gets the same width.
void LessonLayout::widenChart(QWidget *target)
{
    for (auto *dock : docksOf(m_window))
        if (m_isPresenting && target && dock->isAncestorOf(target) && dock->findChild<QwtPlot *>()
            && m_window.dockWidgetArea(dock) == Qt::RightDockWidgetArea
            && m_window.dockWidgetArea(m_dock) == Qt::LeftDockWidgetArea)
            m_window.resizeDocks({dock}, {m_window.width() * panelPercent / 100}, Qt::Horizontal);
}

/// In a presentation: half of the height for a sheet below the pictures; of the column, two thirds for the lesson, half
/// above a chart, and more if its step needs that, as long as the other panel can be used.
void LessonLayout::shareColumn()
{
    constexpr int leastBelow = 200;
    const auto docks = docksOf(m_window);
    for (QDockWidget *dock : docks)
        if (m_isPresenting && m_parts.bench().isVisible() && !dock->isHidden() && !dock->isFloating()
            && m_window.dockWidgetArea(dock) == Qt::BottomDockWidgetArea)
            m_window.resizeDocks({dock}, {m_window.height() / 2}, Qt::Vertical);
    const auto below = std::ranges::find_if(docks, [this](QDockWidget *dock) {
        return dock != m_dock && !dock->isHidden() && !dock->isFloating()
               && m_window.dockWidgetArea(m_dock) == m_window.dockWidgetArea(dock);
    });
    if (!m_isPresenting || below == docks.end())
        return;
    const int height = m_dock->height() + (*below)->height();
    const int least = (*below)->findChild<QwtPlot *>() ? height / 2 : height * 2 / 3;
    const int titleBar = m_dock->height() - m_panel.height();
    const int lesson = std::clamp(m_panel.presentedHeight() + titleBar, least, std::max(least, height - leastBelow));
    m_window.resizeDocks({m_dock, *below}, {lesson, height - lesson}, Qt::Vertical);
}

/// In a presentation: panels of earlier steps.
void LessonLayout::putAway(const QWidget *target, const QList<QWidget *> &others)
{
    for (auto *dock : docksOf(m_window)) {
        const auto isIn = [dock](const QWidget *widget) { return dock->isAncestorOf(widget); };
        if (m_isPresenting && m_parts.bench().isVisible() && dock != m_dock && !dock->isFloating() && !isIn(target)
            && std::ranges::none_of(others, isIn))
            dock->hide();
    }
}

/// On a small screen a presented lesson stands at the right, above the panels of the step, which leaves the pictures
/// their width. The end of the presentation restores the layout.
void LessonLayout::takeOneColumn()
{
    const int width = std::max(m_window.width(), m_window.screen()->size().width()); // full screen comes later
    if (!m_isPresenting || width >= twoColumnsFrom || !m_parts.bench().isVisible())
        return;
    QDockWidget *below = nullptr;
    if (m_window.dockWidgetArea(m_dock) != Qt::RightDockWidgetArea)
        m_window.addDockWidget(Qt::RightDockWidgetArea, m_dock, Qt::Vertical);
    for (auto *dock : docksOf(m_window)) {
        if (dock == m_dock || dock->isHidden() || dock->isFloating()
            || m_window.dockWidgetArea(dock) == Qt::BottomDockWidgetArea)
            continue;
        below ? m_window.tabifyDockWidget(below, dock) : m_window.splitDockWidget(m_dock, dock, Qt::Vertical);
        below = below ? below : dock;
    }
    m_window.resizeDocks({m_dock}, {width * panelPercent / 100}, Qt::Horizontal);
}

void LessonLayout::setFormsVisible(bool isVisible)
{
    m_parts.panel<EvaluatePanel>().column().setVisible(isVisible);
    m_parts.panel<SequentialPanel>().controls().setVisible(isVisible);
}

} // namespace faintline
