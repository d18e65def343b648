#pragma once

#include <QObject>
#include <QStringList>

class QWidget;

namespace faintline {

/// Takes files that are dropped anywhere on a window, also on its text fields, which would only take their names.
class FileDrop : public QObject
{
    Q_OBJECT

public:
    /// Call when the window has all its children.
    explicit FileDrop(QWidget *window);

signals:
    void dropped(const QStringList &files);

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;
};

} // namespace faintline
