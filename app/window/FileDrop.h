#pragma once

#include <QObject>
#include <QStringList>

class QWidget;

namespace faintline {

/// Accepts files dropped anywhere on a window, even on text fields, which would otherwise only insert their names.
class FileDrop : public QObject
{
    Q_OBJECT

public:
    /// Call after the window has created all its children.
    explicit FileDrop(QWidget *window);

signals:
    void dropped(const QStringList &files);

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;
};

} // namespace faintline
