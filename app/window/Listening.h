#pragma once

#include "app/features/live/LiveRun.h"

#include <QObject>

#include <functional>
#include <memory>
#include <optional>

class QWidget;

namespace faintline {

class ListenDialog;
class LiveBar;
class Playback;
class WindowParts;

/// Live runs in a window: the document's recording is still being written, and is opened when the run ends.
class Listening : public QObject
{
    Q_OBJECT

public:
    Listening(WindowParts &parts, QWidget &window);
    ~Listening() override;

    LiveRun &run() { return m_run; }
    LiveBar &bar() { return *m_bar; }
    bool isRunning() const { return m_run.isRunning(); }
    /// To hear it.
    void setPlayback(Playback &playback);

    void ask(); ///< for the source, then starts
    /// Records into a folder, in files of limited length, with these settings or those of the open document, which is
    /// closed. At the end the recording is opened.
    void start(LiveRun::OpenSource source, const QString &folder, const std::optional<AnalysisSettings> &settings = {},
               const RotationSettings &rotation = {});
    /// Stops; at the end the window is closed.
    void leave();
    bool isLeaving() const { return m_isLeaving; }
    /// Whether nothing is being received; otherwise says what to do before that.
    bool mayLeave(const QString &what);

signals:
    void told(const QString &hint);

private:
    void show(const LiveView &view);
    void tell(const ListenNotice &notice);
    void end();

    WindowParts &m_parts;
    QWidget &m_window;
    LiveRun m_run;
    LiveBar *m_bar;
    std::unique_ptr<ListenDialog> m_dialog; ///< remembers its entries
    std::optional<Error> m_trouble;         ///< last error
    bool m_isLeaving = false;
};

} // namespace faintline
