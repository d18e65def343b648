#pragma once

#include "app/base/JobRunner.h"
#include "app/document/Document.h"

#include <functional>
#include <string>
#include <vector>

namespace faintline {

/// What is in front of one as JSON: version, recording with its hash (a scenario is written out), settings,
/// annotations. A session file in itself, but that the recording's folder stays out: it is told by name and hash. Reads
/// the whole recording for the hash where none is given.
std::string provenanceOf(const Source &source, const AnalysisSettings &settings, const Annotations &annotations,
                         std::string hash = {});

/// Hands out the provenance of a document. The hash takes a while, so it is taken on a worker, once.
class Provenance : public QObject
{
    Q_OBJECT

public:
    explicit Provenance(const Document &document, QObject *parent = nullptr);

    /// Calls `use` with the provenance of what is open now, at once where the hash is known, in the order of the
    /// requests.
    void with(std::function<void(const std::string &json)> use);

signals:
    void failed(const faintline::Error &error);

private:
    void answer();

    struct Request {
        Source source;
        AnalysisSettings settings;
        Annotations annotations;
        std::function<void(const std::string &json)> use;
    };

    const Document &m_document;
    std::vector<Request> m_requests;
    QString m_hashed; ///< path of the recording
    std::string m_hash;
    JobRunner m_runner; ///< last, so that its job ends first
};

/// The name of the text in a PNG that is its provenance.
inline QString pictureProvenanceKey()
{
    return QStringLiteral("provenance");
}

/// The same JSON on one line and without two spaces in a row, which do not survive there.
QString pictureProvenance(const std::string &json);

/// Writes it beside an exported file: PATH.provenance.json.
void writeProvenanceBeside(const QString &path, const std::string &json);

} // namespace faintline
