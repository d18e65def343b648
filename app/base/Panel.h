#pragma once

#include "base/Error.h"

#include <QWidget>

namespace faintline {

/// A panel that tells what it wrote, and why it could not.
class Panel : public QWidget
{
    Q_OBJECT

public:
    using QWidget::QWidget;

    /// Called when it becomes visible, and when it no longer is: also behind another panel's tab.
    virtual void setSeen(bool) {}

signals:
    void failed(const faintline::Error &error);
    void written(const QString &path);
};

} // namespace faintline
