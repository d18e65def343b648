#include "app/window/ToolBar.h"

#include "widgets/base/icon.h"

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
    QToolBar::addAction(action);
    if (!keepsText)
        m_shortable.push_back(qobject_cast<QToolButton *>(widgetForAction(action)));
    chooseStyle();
}

void ToolBar::addButton(QToolButton *button, const QString &iconName, bool keepsText)
{
    button->setIcon(icon(iconName));
    addWidget(button);
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
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
