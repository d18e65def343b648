#pragma once

#include <QObject>

class QWidget;

namespace faintline {

/// Whether any part of a widget is in sight: visible, and within all its ancestors. QWidget::visibleRegion() leaves out
/// what opaque children cover, so a panel filled by a scroll area has none.
bool isInSight(const QWidget &widget);

/// Whether a panel is visible, with a signal when it becomes visible.
///
/// Qt regards a panel behind another tab as visible and keeps it outside the window; its contents should not be
/// computed.
class VisibilityWatcher : public QObject
{
    Q_OBJECT

public:
    explicit VisibilityWatcher(QWidget &panel);

    bool isOn() const;

signals:
    void came();

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    void watch();
    void look();

    QWidget &m_panel;
    QList<QWidget *> m_watched; ///< the panel and all its ancestors
    bool m_wasOn = false;
};

} // namespace faintline
