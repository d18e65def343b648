#pragma once

#include "analyse/Source.h"
#include "base/json.h"
#include "inspect/SignalNumbers.h"
#include "plan/AnalysisSettings.h"

#include <string>

namespace faintline {

/// A session file (.faintline): settings, source and annotations, but no results. The recording is named relative to
/// the session's folder and identified by its hash; a scene is included in full.
struct Session {
    Source source;
    std::string recordingHash; ///< empty for a scene
    AnalysisSettings settings;
    Json view = Json::object(); ///< how the window displays it; kept, but not interpreted here
    Annotations annotations{};
    SignalNumbers numbers{}; ///< of the events, if they differ from those of an analysis with these settings
};

/// Whether a path names a session.
bool isSessionPath(const std::string &path);

/// Throws Error naming the file and the key.
Session readSession(const std::string &path);

/// The session of a file's JSON. Throws like readSession.
Session sessionOf(const Json &json, const std::string &path);

/// The source in a session's or a provenance's "recording", with its path relative to `folder`. Throws Error naming the
/// key, Json::exception.
Source sourceFromJson(const Json &recording, const std::string &folder);

/// The text of a session file, with the recording's path relative to `folder`.
std::string sessionText(const Session &session, const std::string &folder);

/// Computes the recording's hash if none is given, and writes the file completely or not at all. Throws Error.
void writeSession(const std::string &path, Session session);

/// All files that may be read for an input of this name, which results must not replace (InputFiles): the file itself
/// (standard input for "-"), both files of a SigMF recording, the files of a folder or a list, a session's recording,
/// the grid and the truth beside. What cannot be found is left out.
std::vector<std::string> filesReadFor(const std::string &name);

/// All files that may be written for a result of this name: the file itself, its provenance, both files of a SigMF
/// recording, the grid beside.
std::vector<std::string> filesWrittenFor(const std::string &result);

/// Throws Error if one of them would replace a file that is read: before anything is computed.
void checkReplacesNoInput(const std::string &result);

/// Why the recording on disk differs from the one of the session; empty if it does not. Throws Error if it cannot be
/// read.
std::string recordingMismatch(const Session &session);

} // namespace faintline
