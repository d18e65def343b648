#include "app/commands/Commands.h"

#include <QActionGroup>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>

#include <algorithm>

namespace faintline {

Command onOff(Command command, std::function<bool()> isOn)
{
    command.show = [isOn = std::move(isOn)](QAction &action) {
        action.setCheckable(true);
        action.setChecked(isOn());
    };
    return command;
}

Commands::Commands(QMainWindow &window) : QObject(&window), m_window(window) {}

QMenu *Commands::menu(const QString &way)
{
    if (QMenu *known = m_menus.value(way))
        return known;
    const auto last = way.lastIndexOf(QLatin1Char('/'));
    QMenu *created = last < 0 ? m_window.menuBar()->addMenu(way) : menu(way.left(last))->addMenu(way.mid(last + 1));
    created->setToolTipsVisible(true);
    connect(created, &QMenu::aboutToShow, this, &Commands::refresh);
    return m_menus[way] = created;
}

void Commands::add(const QString &way, std::initializer_list<Command> rows)
{
    QMenu *const parent = menu(way);
    for (const Command &row : rows) {
        if (row.entries) {
            QMenu *const own = menu(way + QLatin1Char('/') + row.text);
            m_updates.emplace_back([own, entries = row.entries] {
                for (QMenu *each : own->findChildren<QMenu *>(QString(), Qt::FindDirectChildrenOnly))
                    each->deleteLater(); // clear() leaves them
                own->clear();
                entries(*own);
            });
            continue;
        }
        const QList<QAction *> own{row.text.isEmpty() ? nullptr : make(row, *parent)};
        for (QAction *action : row.actions.isEmpty() ? own : row.actions) {
            if (!action) {
                parent->addSeparator();
                continue;
            }
            parent->addAction(action);
            m_window.addAction(action); // keys of a hidden menu have no effect
            if (row.when == Command::Shown)
                m_ofShown << action;
        }
    }
}

QAction *Commands::make(const Command &row, QMenu &menu)
{
    auto *action = new QAction(row.text, this);
    action->setShortcut(row.key);
    if (!row.tip.isEmpty())
        action->setToolTip(row.tip);
    if (!row.brief.isEmpty())
        action->setIconText(row.brief);
    m_named[QLatin1String(row.name)] = action;
    if (row.isChoice) {
        auto *group = menu.findChild<QActionGroup *>();
        (group ? group : new QActionGroup(&menu))->addAction(action);
    }
    if (row.run)
        connect(action, &QAction::triggered, this, row.run);
    if (row.show) {
        const auto update = [action, show = row.show] { show(*action); };
        connect(action, &QAction::triggered, this, update);
        m_updates.push_back(update);
        update();
    }
    return action;
}

void Commands::setShown(bool isShown)
{
    for (QAction *action : m_ofShown)
        action->setEnabled(isShown);
    enableMenus();
}

/// Those of which something can be chosen, or that are empty until they are shown.
void Commands::enableMenus()
{
    const auto canBeChosen = [](const QAction *action) { return !action->isSeparator() && action->isEnabled(); };
    for (QMenu *each : m_menus)
        each->menuAction()->setEnabled(each->isEmpty() || std::ranges::any_of(each->actions(), canBeChosen));
}

void Commands::refresh()
{
    for (const auto &update : m_updates)
        update();
    enableMenus();
}

} // namespace faintline
