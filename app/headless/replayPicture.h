#pragma once

#include "app/headless/RenderOptions.h"

#include <QImage>

#include <string>

namespace faintline {

/// A picture to be reproduced from its own metadata, or the numbers of a sequential test's chart from the description
/// beside them.
struct ReplayOptions {
    std::string picture;   ///< PNG written by `render` or saved by the window with sufficient metadata; or .csv
    std::string recording; ///< path of the recording; empty: next to the picture
};

/// Whether `picture` is a .csv.
bool isChart(const ReplayOptions &options);

/// Reads the picture. Throws Error.
QImage pictureOf(const ReplayOptions &options);

/// Device pixels per pixel according to the picture's metadata, else 1. Qt needs it before the application object is
/// constructed.
double scaleOf(const QImage &picture);

/// How a picture was made, according to its metadata.
struct PictureOrigin {
    RenderOptions options; ///< `source` is a session that was written into a folder
    std::string view;
};

/// Reads the metadata, finds the recording and checks that it is the same one. Throws Error.
PictureOrigin originOf(const QImage &picture, const ReplayOptions &options, const QString &folder);

/// Compares pixels, or bytes, and prints whether they are identical. Throws Error if they are not or if the picture
/// cannot be reproduced.
void replay(const ReplayOptions &options);

} // namespace faintline
