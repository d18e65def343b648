#include "app/window/FileDrop.h"

#include "app/base/filePath.h"

#include <QDropEvent>
#include <QMimeData>
#include <QUrl>
#include <QWidget>

namespace faintline {

namespace {

    /// The dragged files; empty if anything else is dragged.
    QStringList filesOf(const QMimeData &data)
    {
        QStringList files;
        for (const QUrl &url : data.urls())
            if (const QString path = pathOf(url); !path.isEmpty())
                files << path;
        return files;
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
    const QStringList files = filesOf(*drag->mimeData());
    if (files.isEmpty())
        return QObject::eventFilter(watched, event);
    drag->acceptProposedAction();
    if (isDrop)
        emit dropped(files);
    return true;
}

} // namespace faintline
