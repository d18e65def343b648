#pragma once

#include "widgets/base/Theme.h"

#include <QByteArray>
#include <QSettings>
#include <QStringList>

#include <memory>

namespace faintline {

/// What a window remembers from run to run: recent files, its layout, its look. Without a store it remembers nothing.
class WindowMemory
{
public:
    struct Layout {
        QByteArray geometry;
        QByteArray panels;
        QByteArray splitters;     ///< of the workbench
        QByteArray pingSplitters; ///< of the bench of pings
        QString colourMap;
        QString orientation;
        bool isLogarithmic = false; ///< the frequency axis
        bool isRadioAxis = false;
    };

    explicit WindowMemory(std::unique_ptr<QSettings> store = {}) : m_store(std::move(store)) {}

    /// The store of the program, in the person's configuration folder.
    static std::unique_ptr<QSettings> programStore();

    QStringList recent() const; ///< the latest first
    void addRecent(const QString &path);

    /// Where presets of one's own are kept; empty without a store.
    QString presetFolder() const;

    /// The classes that the keys 1 to 9 give events.
    QStringList classNames() const;
    void setClassNames(const QStringList &names);

    Layout layout() const;
    void setLayout(const Layout &layout);

    Theme::Kind theme() const;
    void setTheme(Theme::Kind kind);

private:
    std::unique_ptr<QSettings> m_store;
};

} // namespace faintline
