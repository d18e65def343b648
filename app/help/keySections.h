#pragma once

#include <QString>

#include <array>
#include <vector>

namespace faintline {

/// What keys and mouse do in one place.
struct KeySection {
    struct Entry {
        QString keys;
        QString does;
    };
    QString title;
    std::vector<Entry> entries;
};

/// What they do in a view, by its name (currentView); without entries where there is nothing to say.
KeySection keysOfView(const QString &view);

/// What they do everywhere, in two columns, without what the view's own section has said.
std::array<std::vector<KeySection>, 2> generalKeys(const QString &view);

} // namespace faintline
