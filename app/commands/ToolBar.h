#pragma once

#include <QToolBar>

#include <vector>

class QToolButton;

namespace faintline {

/// Buttons with icons. In a narrow window only those added with `keepsText` show their text; the others have a tooltip.
class ToolBar : public QToolBar
{
    Q_OBJECT

public:
    explicit ToolBar(const QString &title, QWidget *parent = nullptr);

    /// Appends an action with an icon of resources/icons; its tooltip names its key.
    void addAction(QAction *action, const QString &iconName, bool keepsText);

protected:
    void resizeEvent(QResizeEvent *event) override;

private:
    void chooseStyle();

    std::vector<QToolButton *> m_shortable;
};

} // namespace faintline
