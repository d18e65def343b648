#pragma once

#include "analysis/AnalysisSettings.h"
#include "analysis/Review.h"
#include "app/document/Source.h"
#include "widgets/base/Viewport.h"

#include <QString>

#include <optional>

namespace faintline {

/// View state: saved with a session, without influence on any result.
struct ViewState {
    std::optional<Viewport::Box> visible; ///< nothing: everything
    std::optional<Viewport::Point> cursor;
    QString orientation; ///< "newestOnTop", "oldestOnTop", "leftToRight"; empty: unchanged
    QString colourMap;
    bool isLogarithmic = false; ///< the frequency axis
    bool isRadioAxis = false;   ///< frequencies are labelled with the centre frequency added

    // For sonar pings, where the frequency above is the range.
    std::optional<Span> bearing{}; ///< visible
    std::optional<double> cursorBearing{};
    bool isPolar = false;
};

Json toJson(const ViewState &view);

/// A session file: settings and source, but no results. The recording is named relative to the session and identified
/// by its hash; a scenario is included in full.
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

/// The text of a session file, with the recording's path relative to `folder`.
std::string sessionText(const Session &session, const QString &folder);

/// Computes the recording's hash if none is given, and writes the file completely or not at all. Throws Error.
void writeSession(const QString &path, Session session);

/// Why the recording on disk differs from the one of the session; empty if it does not.
QString recordingMismatch(const Session &session);

} // namespace faintline
