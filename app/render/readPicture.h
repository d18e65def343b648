#pragma once

#include <QImage>

namespace faintline {

/// A PNG with the texts in it, or an Error that says why it is none. The library that reads it says so, too, straight
/// on standard error, where one line of ours is to be the only one: so it is not heard, as long as no other thread
/// writes there.
QImage readPicture(const QString &path);

} // namespace faintline
