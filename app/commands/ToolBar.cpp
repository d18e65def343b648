#include "app/commands/ToolBar.h"

#include "widgets/base/icon.h"

#include <QAction>
#include <QToolButton>

namespace faintline {

ToolBar::ToolBar(const QString &title, QWidget *parent) : QToolBar(title, parent)
{
    setMovable(false);
    setIconSize({18, 18});
    setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
}

void ToolBar::addAction(QAction *action, const QString &iconName, bool keepsText)
{
    action->setIcon(icon(iconName));
    action->setIconVisibleInMenu(false);
    if (!action->shortcut().isEmpty())
        action->setToolTip(tr("%1 (%2)").arg(action->toolTip(), action->shortcut().toString(QKeySequence::NativeText)));
    QToolBar::addAction(action);
    auto *button = qobject_cast<QToolButton *>(widgetForAction(action));
    button->setPopupMode(QToolButton::InstantPopup);
    if (!keepsText)
        m_shortable.push_back(button);
    chooseStyle();
}

void ToolBar::resizeEvent(QResizeEvent *event)
{
    QToolBar::resizeEvent(event);
    chooseStyle();
}

void ToolBar::chooseStyle()
{
    constexpr int enoughForText = 1500;
    const auto style = width() >= enoughForText ? Qt::ToolButtonTextBesideIcon : Qt::ToolButtonIconOnly;
    for (QToolButton *button : m_shortable)
        button->setToolButtonStyle(style);
}

} // namespace faintline
