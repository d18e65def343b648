#pragma once

#include <QToolBar>

#include <vector>

class QToolButton;

namespace faintline {

/// Buttons with icons: in a narrow window only those added with `keepsText` say their name, the others by a tool tip.
class ToolBar : public QToolBar
{
    Q_OBJECT

public:
    explicit ToolBar(const QString &title, QWidget *parent = nullptr);

    /// Gives an action its icon of resources/icons and puts it at the end.
    void addAction(QAction *action, const QString &iconName, bool keepsText);
    /// The same of a button, such as one with a menu.
    void addButton(QToolButton *button, const QString &iconName, bool keepsText);

protected:
    void resizeEvent(QResizeEvent *event) override;

private:
    void chooseStyle();

    std::vector<QToolButton *> m_shortable;
};

} // namespace faintline
