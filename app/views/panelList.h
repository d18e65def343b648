#pragma once

#include <QKeySequence>
#include <QString>

#include <functional>
#include <vector>

class QWidget;

namespace faintline {

class WindowParts;

/// A panel of the window: a row of the one list from which docks, *View > Panels*, the sheet of keys, views by name,
/// pictures and `render` are made.
struct PanelRow {
    /// Panels in the same place are tabs, the first one in front. Those at the bottom are hidden until they are requested,
    /// because the pictures need the space.
    enum class Place { Left, RightTop, RightBottom, Bottom };
    /// Kind of source it shows; with any other kind open it is empty.
    enum class Of { Recording, Pings, Scans, Survey };

    QString dock; ///< its name in kept layouts
    QString title;
    Place place;
    /// Makes it and connects it with what it shows and changes.
    std::function<QWidget *(WindowParts &parts)> make;
    QString view{}; ///< its name in `render`, lessons and sessions; empty: it is none
    Of of = Of::Recording;
    QKeySequence key{};    ///< shows and hides it
    bool isHidden = false; ///< until it is requested
};

/// All panels. To add one, add a row; a program of its own may do so before its first window.
std::vector<PanelRow> &panelList();

} // namespace faintline
