#pragma once

#include "widgets/base/Theme.h"

#include <QByteArray>
#include <QSettings>
#include <QStringList>

#include <memory>

namespace faintline {

/// State of a window that persists between runs: recent files, layout, appearance. Without a store nothing is kept.
/// A store that is still empty gives what a first window shows: time from left to right, and what was found.
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
        QString layer; ///< of the output, as in outputLayerNames
        bool isRegulationShown = true;
    };

    explicit WindowMemory(std::unique_ptr<QSettings> store = {}) : m_store(std::move(store)) {}

    bool isKept() const { return m_store != nullptr; }

    /// The program's store in the user's configuration folder.
    static std::unique_ptr<QSettings> programStore();

    QStringList recent() const; ///< most recent first
    void addRecent(const QString &path);

    /// Folder of the user's presets; empty without a store.
    QString presetFolder() const;

    /// Classes that the keys 1 to 9 assign to events.
    QStringList classNames() const;
    void setClassNames(const QStringList &names);

    /// Bandwidth of the noise that SNRs refer to, Hz; 0: that of a bin.
    double snrBandwidthHz() const;
    void setSnrBandwidthHz(double hz);

    /// Paths of the lessons that were gone through to their end.
    QStringList doneLessons() const;
    void addDoneLesson(const QString &path);

    Layout layout() const;
    void setLayout(const Layout &layout);

    Theme::Kind theme() const;
    void setTheme(Theme::Kind kind);

private:
    std::unique_ptr<QSettings> m_store;
};

} // namespace faintline
