#include "app/document/SessionSaver.h"

#include "app/base/filePath.h"
#include "widgets/base/labelText.h"

#include <QFileDialog>
#include <QMessageBox>

#include <utility>

namespace faintline {

SessionSaver::SessionSaver(Document &document, std::function<ViewState()> view, QWidget *window)
    : QObject(window), m_document(document), m_view(std::move(view)), m_window(window)
{
    connect(&m_runner, &JobRunner::failed, this, [this](const Error &error) {
        m_afterSaving = nullptr;
        emit failed(error);
    });
}

void SessionSaver::save()
{
    m_document.sessionPath().isEmpty() ? saveAs() : saveTo(m_document.sessionPath());
}

void SessionSaver::saveAs()
{
    const QString suggested = nameBeside(m_document.sourcePath(), QStringLiteral(".faintline"));
    const QString path =
        QFileDialog::getSaveFileName(m_window, tr("Save session"), suggested, tr("Sessions (*.faintline)"));
    if (path.isEmpty())
        m_afterSaving = nullptr;
    else
        saveTo(isSessionPath(pathBytes(path)) ? path : path + QStringLiteral(".faintline"));
}

void SessionSaver::saveTo(const QString &path)
{
    const Session session = m_document.session(toJson(m_view()));
    m_runner.start([this, path, session](const RunContext &) -> JobRunner::Delivery {
        writeSession(pathBytes(path), session);
        return [this, path, settings = session.settings, annotations = session.annotations] {
            if (settings == m_document.settings() && annotations == m_document.annotations())
                m_document.setSaved(path);
            emit saved(path);
            if (const auto next = std::exchange(m_afterSaving, nullptr))
                next();
        };
    });
}

bool SessionSaver::mayLose(const QString &what, std::function<void()> next)
{
    QMessageBox::StandardButton answer = QMessageBox::Discard;
    if (m_isAsking && m_document.isModified()) {
        const QString question =
            tr("Save the settings for %1 as a session before %2?").arg(m_document.sourceName(), what);
        answer =
            QMessageBox::question(m_window, tr("Unsaved settings"), asHtml(question),
                                  QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, QMessageBox::Save);
    }
    if (answer == QMessageBox::Save) {
        m_afterSaving = std::move(next);
        save();
    }
    return answer == QMessageBox::Discard;
}

} // namespace faintline
