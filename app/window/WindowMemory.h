#pragma once

#include "widgets/base/Theme.h"

#include <QByteArray>
#include <QSettings>
#include <QStringList>

#include <memory>

class QMainWindow;

namespace faintline {

class WindowParts;

/// State of a window that persists between runs: recent files, layout, appearance. Without a store nothing is kept.
/// A store that is still empty gives what a first window shows: time from left to right, and what was found.
class WindowMemory
{
public:
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

    /// Keeps places of panels and pictures, colours, axes and layer.
    void keepLayout(const QMainWindow &window, const WindowParts &parts, bool isRegulationShown);
    void restoreLayout(QMainWindow &window, const WindowParts &parts) const;
    QByteArray panels() const; ///< state of the window's docks
    bool isRegulationShown() const;

    Theme::Kind theme() const;
    void setTheme(Theme::Kind kind);

private:
    std::unique_ptr<QSettings> m_store;
};

} // namespace faintline
