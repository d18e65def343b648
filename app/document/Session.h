#pragma once

#include "analysis/AnalysisSettings.h"
#include "analysis/Review.h"
#include "app/document/Source.h"
#include "widgets/base/Viewport.h"

#include <QString>

#include <optional>

namespace faintline {

/// How the results are looked at: saved with a session, of no influence on any number.
struct ViewState {
    std::optional<Viewport::Box> visible; ///< nothing: all of it
    std::optional<Viewport::Point> cursor;
    QString orientation; ///< "newestOnTop", "oldestOnTop", "leftToRight"; empty: as it is
    QString colourMap;
    bool isLogarithmic = false; ///< the frequency axis
    bool isRadioAxis = false;   ///< frequencies are labelled with the centre frequency added

    // Of a sonar's pings, where the frequency above is the range.
    std::optional<Span> bearing{}; ///< visible
    std::optional<double> cursorBearing{};
    bool isPolar = false;
};

Json toJson(const ViewState &view);

/// A session file: the recipe, never the results. The recording is named relative to the session and known by its
/// hash; a scenario is written out.
struct Session {
    Source source;
    std::string recordingHash; ///< empty for a scenario
    AnalysisSettings settings;
    ViewState view;
    Annotations annotations{};
};

/// Whether a path names a session (".faintline").
bool isSessionPath(const QString &path);

/// Throws Error naming the file and the key.
Session readSession(const QString &path);

/// The session as the file holds it, with the recording's path relative to that folder.
std::string sessionText(const Session &session, const QString &folder);

/// Takes the recording's hash where none is given, and writes, completely or not at all. Throws Error.
void writeSession(const QString &path, Session session);

/// Why the recording on disk is not the one the session was saved with; empty where it is.
QString recordingMismatch(const Session &session);

} // namespace faintline
