#pragma once

#include "app/views/panelList.h"
#include "base/Error.h"

#include <QObject>
#include <QPixmap>
#include <QStringList>

#include <string>
#include <vector>

class QWidget;

namespace faintline {

class WindowParts;

/// Part of the window that can be shown on its own: in a picture, in a lesson, on the sheets of keys and equations.
struct WindowView {
    using Of = PanelRow::Of;

    QString name;  ///< in `render`, lessons and sessions
    QString title; ///< in menus
    Of of;
    std::function<QWidget *(const WindowParts &parts)> widget; ///< null: the whole window
};

/// The views that are no panels, and those of the list of panels; used by menus, `render`, lessons and reports.
const std::vector<WindowView> &windowViews();

/// Views of a window by name, and their pictures as files that contain a description of their source.
class WindowViews : public QObject
{
    Q_OBJECT

public:
    WindowViews(WindowParts &parts, QWidget *window); ///< child of the window

    /// Names of all views.
    static const QStringList &names();
    /// Null if there is no such view.
    QWidget *named(const QString &name) const;

    /// The view as it is displayed, with axes of its own.
    QPixmap grab(const QString &name) const;
    /// Asks for a path and saves the view there.
    void exportPicture(const QString &name);
    /// Saves the view as it is displayed now, with axes of its own; the extension selects the format.
    void saveTo(const QString &name, const QString &path);

signals:
    void written(const QString &path);
    void failed(const faintline::Error &error);

private:
    std::string withView(const QString &name, const std::string &provenance) const;

    WindowParts &m_parts;
    QWidget *m_window;
};

} // namespace faintline
