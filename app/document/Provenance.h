#pragma once

#include "app/base/JobRunner.h"
#include "app/document/Document.h"

#include <functional>
#include <string>
#include <vector>

namespace faintline {

/// A document's session as JSON: version, recording with its hash (a scenario is included in full), settings,
/// annotations, numbers. It is a session file without the recording's folder, which is identified by name and hash, and
/// without a view. Reads the whole recording for the hash if it is not known.
std::string provenanceOf(Session session);

/// That of what the document shows: the settings are those of its analysis, which may lag behind.
Session shownSession(const Document &document);

/// Provides the provenance of a document. The hash takes some time, so it is computed once, on a worker.
class Provenance : public QObject
{
    Q_OBJECT

public:
    explicit Provenance(const Document &document, QObject *parent = nullptr);

    /// Calls `use` with the provenance of the open document, immediately if the hash is known, in the order of the
    /// requests.
    void with(std::function<void(const std::string &json)> use);

signals:
    void failed(const faintline::Error &error);

private:
    void answer();

    struct Request {
        Session session;
        std::function<void(const std::string &json)> use;
    };

    const Document &m_document;
    std::vector<Request> m_requests;
    std::string m_hashed; ///< path of the recording
    std::string m_hash;
    JobRunner m_runner; ///< last, so that its job ends first
};

/// Key of the provenance text in a PNG.
inline QString pictureProvenanceKey()
{
    return QStringLiteral("provenance");
}

/// The same JSON on one line without consecutive spaces, which PNG text does not preserve.
QString pictureProvenance(const std::string &json);

/// Writes the provenance beside an exported file: PATH.provenance.json.
void writeProvenanceBeside(const QString &path, const std::string &json);

} // namespace faintline
