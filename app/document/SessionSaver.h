#pragma once

#include "app/base/JobRunner.h"
#include "app/document/Document.h"
#include "app/document/ViewState.h"

#include <functional>

class QWidget;

namespace faintline {

/// Saves the document as a session, on a worker because of the recording's hash, and asks about unsaved work.
class SessionSaver : public QObject
{
    Q_OBJECT

public:
    /// `view`: the current view state. `window`: parent of dialogs.
    SessionSaver(Document &document, std::function<ViewState()> view, QWidget *window);

    /// If off, unsaved work is discarded without asking.
    void setAsking(bool isAsking) { m_isAsking = isAsking; }

    void save();
    void saveAs();

    /// Whether unsaved work may be discarded for the next action, such as "opening something else". False if the user
    /// keeps it; if the user saves first, `next` is called afterwards.
    bool mayLose(const QString &what, std::function<void()> next);

signals:
    void saved(const QString &path);
    void failed(const faintline::Error &error);

private:
    void saveTo(const QString &path);

    Document &m_document;
    std::function<ViewState()> m_view;
    QWidget *m_window;
    bool m_isAsking = true;
    std::function<void()> m_afterSaving;
    JobRunner m_runner; ///< last, so that its job ends first
};

} // namespace faintline
