#include "widgets/base/TimeStack.h"

#include "widgets/base/ThemedPlot.h"

#include <QEvent>
#include <QScopedValueRollback>

#include <algorithm>

namespace faintline {

namespace {

    /// Pixels between a pane's edges and the canvas, without the rooms made by this class.
    struct Sides {
        int left;
        int right;
    };

    Sides ownSides(const ThemedPlot &plot, const QWidget &pane)
    {
        const QMargins &rooms = plot.sideRooms();
        const int left = plot.canvas()->mapTo(&pane, QPoint()).x();
        return {left - rooms.left(), pane.width() - left - plot.canvas()->width() - rooms.right()};
    }

} // namespace

TimeStack::TimeStack(QObject *parent) : QObject(parent) {}

void TimeStack::add(ThemedPlot &plot, QWidget &pane)
{
    m_members.push_back({&plot, &pane});
    plot.canvas()->installEventFilter(this);
    pane.installEventFilter(this);
    schedule();
}

void TimeStack::setOn(bool isOn)
{
    if (isOn == m_isOn)
        return;
    m_isOn = isOn;
    isOn ? schedule() : release();
}

bool TimeStack::eventFilter(QObject *watched, QEvent *event)
{
    switch (event->type()) {
    case QEvent::Resize:
    case QEvent::Move:
    case QEvent::Show:
    case QEvent::Hide:
    case QEvent::ParentChange:
        schedule();
        break;
    default:
        break;
    }
    return QObject::eventFilter(watched, event);
}

void TimeStack::schedule()
{
    if (!m_isOn || m_isAligning || m_isScheduled)
        return;
    m_isScheduled = true;
    QMetaObject::invokeMethod(this, &TimeStack::align, Qt::QueuedConnection); // once all parts have their places
}

void TimeStack::align()
{
    m_isScheduled = false;
    if (!m_isOn || m_isAligning)
        return;
    const QScopedValueRollback aligning(m_isAligning, true);
    for (const Members &members : groups())
        alignGroup(members);
}

/// The visible plots of each window, from top to bottom.
std::vector<TimeStack::Members> TimeStack::groups() const
{
    std::vector<Members> groups;
    for (const Member &member : m_members) {
        if (!member.plot || !member.pane || !member.plot->isVisibleTo(member.plot->window())
            || (m_part && m_part != member.plot && !m_part->isAncestorOf(member.plot)))
            continue;
        const auto same = std::find_if(groups.begin(), groups.end(), [&](const Members &group) {
            return group.front()->plot->window() == member.plot->window();
        });
        if (same == groups.end())
            groups.push_back({&member});
        else
            same->push_back(&member);
    }
    return groups;
}

void TimeStack::alignGroup(const Members &members)
{
    for (const Member *member : members)
        member->plot->setTimeLabels(member == members.back());
    constexpr int mostRounds = 3; // another width may need labels of another width
    for (int round = 0; round < mostRounds; ++round) {
        Sides widest{0, 0};
        std::vector<Sides> own;
        for (const Member *member : members) {
            own.push_back(ownSides(*member->plot, *member->pane));
            widest = {std::max(widest.left, own.back().left), std::max(widest.right, own.back().right)};
        }
        bool isAligned = true;
        for (std::size_t i = 0; i < members.size(); ++i) {
            const QMargins rooms(widest.left - own[i].left, 0, widest.right - own[i].right, 0);
            isAligned = isAligned && rooms == members[i]->plot->sideRooms();
            members[i]->plot->setSideRooms(rooms.left(), rooms.right());
        }
        if (isAligned)
            return;
    }
}

void TimeStack::release()
{
    for (const Member &member : m_members)
        if (member.plot) {
            member.plot->setTimeLabels(true);
            member.plot->setSideRooms(0, 0);
        }
}

TimeStack::Part::Part(TimeStack &stack, const QWidget &widget) : m_stack(stack)
{
    stack.m_part = &widget;
    stack.align();
}

TimeStack::Part::~Part()
{
    m_stack.m_part.clear();
    m_stack.align();
}

} // namespace faintline
