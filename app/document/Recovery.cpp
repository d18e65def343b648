#include "app/document/Recovery.h"

#include "app/base/filePath.h"

#include <QDir>
#include <QFile>
#include <QStandardPaths>
#include <QUuid>

namespace faintline {

namespace {

    constexpr int pauseMs = 1000;

    QString lockOf(const QString &session)
    {
        return session + QStringLiteral(".lock");
    }

} // namespace

Recovery::Recovery(Document &document, std::function<ViewState()> view, const QString &folder, QObject *parent)
    : QObject(parent), m_document(document), m_view(std::move(view))
{
    if (folder.isEmpty() || !QDir().mkpath(folder))
        return;
    m_path = QDir(folder).filePath(QUuid::createUuid().toString(QUuid::WithoutBraces) + QStringLiteral(".faintline"));
    m_pause.setSingleShot(true);
    m_pause.setInterval(pauseMs);
    connect(&m_pause, &QTimer::timeout, this, &Recovery::keep);
    connect(&document, &Document::settingsChanged, this, &Recovery::follow);
    connect(&document, &Document::annotationsChanged, this, &Recovery::follow);
    connect(&document, &Document::sessionChanged, this, &Recovery::follow);
}

Recovery::~Recovery()
{
    m_runner.cancel();
    forget();
}

QString Recovery::programFolder()
{
    return QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation)
           + QStringLiteral("/faintline/recovery");
}

QStringList Recovery::leftBehind(const QString &folder)
{
    QStringList result;
    const QFileInfoList files = QDir(folder).entryInfoList({QStringLiteral("*.faintline")}, QDir::Files, QDir::Time);
    for (const QFileInfo &file : files) {
        QLockFile lock(lockOf(file.filePath()));
        lock.setStaleLockTime(0); // age is irrelevant: only whether its process is still running counts
        if (lock.tryLock())
            result.append(file.filePath());
    }
    return result;
}

void Recovery::discard(const QString &session)
{
    QFile::remove(session);
    QFile::remove(lockOf(session));
}

void Recovery::follow()
{
    if (m_document.isModified())
        return m_pause.start();
    m_pause.stop();
    m_runner.cancel();
    forget();
}

void Recovery::keep()
{
    if (!m_lock) {
        m_lock = std::make_unique<QLockFile>(lockOf(m_path));
        m_lock->setStaleLockTime(0);
        m_lock->tryLock();
    }
    const QString source = m_document.sourcePath();
    if (source != m_hashed)
        m_hash.clear();
    const Session session = m_document.session(toJson(m_view()), m_hash);
    m_runner.start([this, source, session](const RunContext &) -> JobRunner::Delivery {
        const std::string path = pathBytes(m_path);
        writeSession(path, session);
        std::string hash = session.recordingHash.empty() ? readSession(path).recordingHash : session.recordingHash;
        return [this, source, hash = std::move(hash)] {
            m_hashed = source;
            m_hash = hash;
            emit kept(m_path);
        };
    });
}

void Recovery::forget()
{
    if (!m_lock)
        return;
    QFile::remove(m_path);
    m_lock.reset();
}

} // namespace faintline
