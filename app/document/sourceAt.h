#pragma once

#include "analyse/Source.h"
#include "app/document/FrameKind.h"

#include <QString>

namespace faintline {

struct Session;

/// The source that a path of the window denotes, which may be a scene in the program's resources (":/…"). Throws Error.
Source sourceAt(const QString &path, const OpenOptions &options = {});

/// The session at such a path. One in the resources is an example, which has no file to be saved to: its source has its
/// path. Throws Error.
Session sessionAt(const QString &path);

/// Name for window titles: the file's label.
QString nameOf(const Source &source);

/// Throws Error if the window cannot show such frames.
const FrameKind &kindOf(const OpenedSource &opened);

/// Initial settings for a source.
AnalysisSettings firstSettings(const OpenedSource &opened);

/// Whether a file holds raw samples whose type and rate must be specified before it can be opened.
bool needsRawOptions(const QString &path, const OpenOptions &options);

} // namespace faintline
