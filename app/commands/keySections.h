#pragma once

#include <QList>
#include <QString>

#include <vector>

class QAction;

namespace faintline {

/// Keys and mouse in one context.
struct KeySection {
    struct Entry {
        QString keys;
        QString does;
    };
    QString title;
    std::vector<Entry> entries;
};

/// Keys and mouse in a view that are no commands of the window, by its name (currentView); without entries if there are
/// none.
KeySection keysOfView(const QString &view);

/// A command's text without its mark of a key, and without the dots that announce a dialog.
QString plainText(const QAction &action);

/// Keys everywhere, without those of the view's own section: of the pictures, and the commands of the menus.
std::vector<KeySection> generalKeys(const QString &view, const QList<QAction *> &menus);

} // namespace faintline
