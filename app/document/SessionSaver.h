#pragma once

#include "app/base/JobRunner.h"
#include "app/document/Document.h"
#include "app/document/Session.h"

#include <functional>

class QWidget;

namespace faintline {

/// Saves the document as a session, on a worker, for the recording's hash takes a while; and asks about unsaved work.
class SessionSaver : public QObject
{
    Q_OBJECT

public:
    /// `view`: how the results are looked at now. Dialogs belong to `window`.
    SessionSaver(Document &document, std::function<ViewState()> view, QWidget *window);

    /// Off: nobody is there to answer, and unsaved work is let go.
    void setAsking(bool isAsking) { m_isAsking = isAsking; }

    void save();
    void saveAs();

    /// Whether unsaved work may be lost to what comes next, "opening something else". Not if the person keeps it; if it
    /// is to be saved first, `next` is called when it is.
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
