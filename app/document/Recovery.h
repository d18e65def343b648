#pragma once

#include "app/base/JobRunner.h"
#include "app/document/Document.h"
#include "app/document/ViewState.h"

#include <QLockFile>
#include <QTimer>

#include <functional>
#include <memory>
#include <string>

namespace faintline {

/// Stores unsaved work on disk, so that it survives any end of the program.
///
/// A second after an edit the session is written to a separate file in the folder, beside a lock held by this process;
/// saving, undoing to the saved state, or a regular exit removes both. A file whose lock is not held was left behind by
/// a crashed program.
class Recovery : public QObject
{
    Q_OBJECT

public:
    /// `view`: the current view state. With an empty folder nothing is stored.
    Recovery(Document &document, std::function<ViewState()> view, const QString &folder, QObject *parent = nullptr);
    ~Recovery() override;

    /// The program's recovery folder, in the user's data folder.
    static QString programFolder();

    /// Sessions left behind in the folder, the latest first.
    static QStringList leftBehind(const QString &folder);
    static void discard(const QString &session);

signals:
    void kept(const QString &session);

private:
    void follow();
    void keep();
    void forget();

    Document &m_document;
    std::function<ViewState()> m_view;
    QString m_path; ///< empty: nothing is stored
    std::unique_ptr<QLockFile> m_lock;
    QTimer m_pause;
    std::string m_hash; ///< of the recording; computed only once
    QString m_hashed;   ///< its path
    JobRunner m_runner; ///< last, so that its job ends first
};

} // namespace faintline
