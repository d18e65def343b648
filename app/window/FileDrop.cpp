#include "app/window/FileDrop.h"

#include "app/base/filePath.h"

#include <QDropEvent>
#include <QMimeData>
#include <QUrl>
#include <QWidget>

namespace faintline {

namespace {

    /// The first of the dragged files; empty where something else is dragged.
    QString fileOf(const QMimeData &data)
    {
        for (const QUrl &url : data.urls())
            if (const QString path = pathOf(url); !path.isEmpty())
                return path;
        return {};
    }

} // namespace

FileDrop::FileDrop(QWidget *window) : QObject(window)
{
    window->setAcceptDrops(true);
    window->installEventFilter(this);
    for (QWidget *child : window->findChildren<QWidget *>())
        if (child->acceptDrops())
            child->installEventFilter(this);
}

bool FileDrop::eventFilter(QObject *watched, QEvent *event)
{
    const bool isDrop = event->type() == QEvent::Drop;
    if (!isDrop && event->type() != QEvent::DragEnter && event->type() != QEvent::DragMove)
        return QObject::eventFilter(watched, event);
    auto *drag = static_cast<QDropEvent *>(event);
    const QString path = fileOf(*drag->mimeData());
    if (path.isEmpty())
        return QObject::eventFilter(watched, event);
    drag->acceptProposedAction();
    if (isDrop)
        emit dropped(path);
    return true;
}

} // namespace faintline
