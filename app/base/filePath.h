#pragma once

#include <QByteArray>
#include <QString>

#include <string>

class QUrl;

namespace faintline {

/// The window's paths are text, a file's name is bytes. A byte that is no part of a character has a letter of its own
/// in the text (base/fileName.h), so that any file can be opened, remembered and opened again. QFile and QFileInfo know
/// nothing of these letters; whoever asks for a file itself asks here.

QString pathText(const std::string &bytes);
std::string pathBytes(const QString &path);

/// Where a dragged or chosen file lies; empty for what is no file of this machine.
QString pathOf(const QUrl &url);

bool fileExists(const QString &path);
bool isRegularFile(const QString &path);
qint64 fileSize(const QString &path); ///< bytes, 0 where there is none
QString absolutePath(const QString &path);

/// At most so many bytes from the file's beginning, of a resource (":/…") as well. Throws Error.
QByteArray readBeginning(const QString &path, qint64 mostBytes);

/// The file's name as a label shows it: one line, not too long.
QString fileLabel(const QString &path);

/// What to call a file that goes with another, "name-events.csv": in the same folder, with a name that any dialog can
/// show and type.
QString nameBeside(const QString &path, const QString &ending);

} // namespace faintline
