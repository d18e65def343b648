#pragma once

#include <QImage>

namespace faintline {

/// Reads a PNG and its provenance; other texts, colour profiles and times are left out, so that memory stays bounded by
/// the picture's pixels and the size of the file. Throws Error with the reason if it cannot be read. The PNG library
/// also writes to standard error, where only our own line must appear; its output is suppressed, provided that no other
/// thread writes there meanwhile.
QImage readPicture(const QString &path);

} // namespace faintline
