#pragma once

#include <QByteArray>
#include <QString>

#include <string>

class QUrl;

namespace faintline {

/// The window's paths are text, but file names are bytes. Bytes that are not part of a character map to special
/// characters in the text (base/files/fileName.h), so that any file can be opened, stored and reopened. QFile and QFileInfo
/// do not know these characters; use these functions to access files.

QString pathText(const std::string &bytes);
std::string pathBytes(const QString &path);

/// Path of a dragged or selected file; empty if it is not a local file.
QString pathOf(const QUrl &url);

bool fileExists(const QString &path);
bool isRegularFile(const QString &path);
qint64 fileSize(const QString &path); ///< bytes, 0 if it does not exist
QString absolutePath(const QString &path);

/// At most `mostBytes` from the file's beginning, also for resources (":/…"). Throws Error.
QByteArray readBeginning(const QString &path, qint64 mostBytes);

/// Label for a file name: one line of limited length.
QString fileLabel(const QString &path);

/// Name of a companion file, "name-events.csv": in the same folder, of a resource in the user's, with a name that any
/// dialog can show and accept.
QString nameBeside(const QString &path, const QString &ending);

} // namespace faintline
