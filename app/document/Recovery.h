#pragma once

#include "app/base/JobRunner.h"
#include "app/document/Document.h"
#include "app/document/Session.h"

#include <QLockFile>
#include <QTimer>

#include <functional>
#include <memory>
#include <string>

namespace faintline {

/// Keeps unsaved work on disk while it is unsaved, so that whatever ends the program does not end the work.
///
/// A second after an edit the session goes into a file of its own in the folder, beside a lock that this process holds;
/// saving, undoing back to what was saved, or a regular end removes both. A file whose lock nobody holds was left
/// behind by a program that died.
class Recovery : public QObject
{
    Q_OBJECT

public:
    /// `view`: how the results are looked at now. An empty folder keeps nothing.
    Recovery(Document &document, std::function<ViewState()> view, const QString &folder, QObject *parent = nullptr);
    ~Recovery() override;

    /// Where the program keeps it, in the person's data folder.
    static QString programFolder();

    /// Sessions left behind in the folder, the latest first.
    static QStringList leftBehind(const QString &folder);
    static void discard(const QString &session);

    bool isPending() const { return m_pause.isActive() || m_runner.isRunning(); }

signals:
    void kept(const QString &session);

private:
    void follow();
    void keep();
    void forget();

    Document &m_document;
    std::function<ViewState()> m_view;
    QString m_path; ///< empty: nothing is kept
    std::unique_ptr<QLockFile> m_lock;
    QTimer m_pause;
    std::string m_hash; ///< of the recording, which takes a while, so only once
    QString m_hashed;   ///< its path
    JobRunner m_runner; ///< last, so that its job ends first
};

} // namespace faintline
