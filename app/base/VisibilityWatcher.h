#pragma once

#include <QObject>

class QWidget;

namespace faintline {

/// Whether a panel can be seen, and when it comes into sight.
///
/// Qt calls a panel behind another tab visible and keeps it somewhere outside of the window; what it would show is not
/// to be worked out.
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
    QList<QWidget *> m_watched; ///< the panel and all it lies in
    bool m_wasOn = false;
};

} // namespace faintline
