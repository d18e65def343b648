#pragma once

#include "app/render/RenderOptions.h"

#include <QImage>

#include <string>

namespace faintline {

/// A picture to be made again from what it tells of itself, or the numbers of a sequential test's chart from what
/// stands beside them.
struct ReplayOptions {
    std::string picture;   ///< PNG that `render` wrote, or the window with what suffices for it; or .csv
    std::string recording; ///< where the recording is; empty: beside the picture
};

/// Whether it is the latter.
bool isChart(const ReplayOptions &options);

/// The picture as it is. Throws Error.
QImage pictureOf(const ReplayOptions &options);

/// Device pixels per pixel that a picture says it was made with, else 1: Qt wants to know before its application
/// begins.
double scaleOf(const QImage &picture);

/// What a picture tells of its making.
struct PictureOrigin {
    RenderOptions options; ///< their source is a session that was written into a folder
    std::string view;
};

/// Reads it, looks for the recording and checks that it is the same. Throws Error.
PictureOrigin originOf(const QImage &picture, const ReplayOptions &options, const QString &folder);

/// Compares pixels, or bytes; prints whether they are the same. Throws Error where they are not, or where it cannot be
/// made again.
void replay(const ReplayOptions &options);

} // namespace faintline
