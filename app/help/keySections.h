#pragma once

#include <QString>

#include <array>
#include <vector>

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

/// Keys in a view, by its name (currentView); without entries if there are none.
KeySection keysOfView(const QString &view);

/// Keys everywhere, in two columns, without those of the view's own section.
std::array<std::vector<KeySection>, 2> generalKeys(const QString &view);

} // namespace faintline
