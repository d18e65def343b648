#include "app/document/Provenance.h"

#include "app/base/filePath.h"
#include "base/files/AtomicFile.h"
#include "signal/openRecording.h"

#include <filesystem>
#include <utility>

namespace faintline {

std::string provenanceOf(Session session)
{
    const Source &source = session.source;
    if (!source.isSimulated() && session.recordingHash.empty())
        session.recordingHash = recordingHash(source.path);
    const std::string folder = std::filesystem::path(source.path).parent_path().string();
    Json json = parseJson(sessionText(session, folder), "session");
    json.erase("view");
    json["version"] = FAINTLINE_VERSION;
    return json.dump(2) + "\n";
}

Session shownSession(const Document &document)
{
    Session session = document.session();
    if (const auto &analysis = document.analysis())
        session.settings = analysis->settings;
    return session;
}

Provenance::Provenance(const Document &document, QObject *parent) : QObject(parent), m_document(document)
{
    connect(&m_runner, &JobRunner::failed, this, [this](const Error &error) {
        m_requests.clear();
        emit failed(error);
    });
}

void Provenance::with(std::function<void(const std::string &json)> use)
{
    m_requests.push_back({shownSession(m_document), std::move(use)});
    if (!m_runner.isRunning())
        answer();
}

void Provenance::answer()
{
    while (!m_requests.empty()) {
        const Source &source = m_requests.front().session.source;
        if (!source.isSimulated() && source.path != m_hashed) {
            m_runner.start([this, path = source.path](const RunContext &) -> JobRunner::Delivery {
                std::string hash = recordingHash(path);
                return [this, path, hash = std::move(hash)] {
                    m_hashed = path;
                    m_hash = hash;
                    answer();
                };
            });
            return;
        }
        Request request = std::move(m_requests.front());
        m_requests.erase(m_requests.begin());
        request.session.recordingHash = m_hash;
        request.use(provenanceOf(std::move(request.session)));
    }
}

QString pictureProvenance(const std::string &json)
{
    QString text = QString::fromStdString(parseJson(json, "provenance").dump());
    while (text.contains(QLatin1String("  "))) // within a name, then
        text.replace(QLatin1String("  "), QLatin1String(" \\u0020"));
    return text;
}

void writeProvenanceBeside(const QString &path, const std::string &json)
{
    writeTextFile(pathBytes(path) + ".provenance.json", json);
}

} // namespace faintline
