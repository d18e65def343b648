#pragma once

#include <QImage>
#include <QRect>
#include <QString>

#include <string>
#include <vector>

namespace faintline {

/// How two pictures differ, pixel for pixel.
struct PictureDifference {
    bool isSameSize = true;
    qint64 changedPixels = 0;   ///< that count
    qint64 toleratedPixels = 0; ///< that are one colour of a colour map away, and few enough not to count
    std::vector<QRect> places;  ///< round changed pixels that lie together
    QImage picture; ///< changed pixels red on a pale ground, their places framed; null where nothing changed

    bool isEqual() const { return isSameSize && changedPixels == 0; }
};

/// Compares for equality: a single changed digit has to show, and any average over the picture would swallow it.
///
/// `toleratesRasters`: where pixels of both pictures are neighbours in one of the program's colour maps, as a float
/// that was rounded the other way makes them, 1e-5 of the picture's pixels may be so. More of them, and all of them
/// count.
PictureDifference comparePictures(const QImage &expected, const QImage &actual, bool toleratesRasters = false);

/// What `faintline check-pictures` is asked for.
struct CheckOptions {
    std::string expected; ///< a PNG, or a folder of them
    std::string actual;
    std::string out; ///< folder for the report; empty: none
    bool toleratesRasters = false;
};

/// What became of one picture.
struct CheckedPicture {
    enum class State { Same, Different, Missing, New }; ///< Missing: expected, but not there
    QString name;                                       ///< relative to its folder
    State state = State::Same;
    QSize expectedSize, actualSize;
    PictureDifference difference;
};

/// Compares two PNGs, or two folders of them with all their subfolders, and writes the report: index.html, and of each
/// picture that is not the same expected/NAME, actual/NAME and difference/NAME. Throws Error where there is nothing to
/// compare.
std::vector<CheckedPicture> checkPictures(const CheckOptions &options);

/// The same as a command: a line for each picture that is not the same; throws Error{Failure} if there is one.
void runCheckPictures(const CheckOptions &options);

} // namespace faintline
