#pragma once

#include <QImage>
#include <QRect>
#include <QString>

#include <string>
#include <vector>

namespace faintline {

/// Difference between two pictures, pixel by pixel.
struct PictureDifference {
    bool isSameSize = true;
    qint64 changedPixels = 0;   ///< that count
    qint64 toleratedPixels = 0; ///< tolerated: one colour of a colour map away, and few enough
    std::vector<QRect> places;  ///< around groups of neighbouring changed pixels
    QImage picture;             ///< changed pixels red on a pale background, `places` framed; null if nothing changed

    bool isEqual() const { return isSameSize && changedPixels == 0; }
};

/// Compares for equality: a single changed digit must be found, and any average over the picture would hide it.
///
/// With `toleratesRasters`, pixels that are neighbours in one of the program's colour maps, as different rounding of a
/// float produces them, are tolerated up to a fraction of 1e-5 of the picture's pixels. If there are more, all of them
/// count.
PictureDifference comparePictures(const QImage &expected, const QImage &actual, bool toleratesRasters = false);

/// What `faintline check-pictures` is asked for.
struct CheckOptions {
    std::string expected; ///< a PNG, or a folder of them
    std::string actual;
    std::string out; ///< folder for the report; empty: none
    bool toleratesRasters = false;
    std::string junit{}; ///< file for the results as JUnit XML; empty: none
    bool isJson = false; ///< prints the results as JSON
};

/// What became of one picture.
struct CheckedPicture {
    enum class State { Same, Different, Missing, New }; ///< Missing: expected, but not there
    QString name;                                       ///< relative to its folder
    State state = State::Same;
    QSize expectedSize, actualSize;
    PictureDifference difference;

    bool differs() const { return state != State::Same; }
};

/// "3 pixel(s) changed in 1 place(s)"
QString verdictOf(const CheckedPicture &one);

/// Compares two PNGs, or two folders of them with all their subfolders, and writes the report: index.html, and of each
/// picture that is not the same expected/NAME, actual/NAME and difference/NAME. Throws Error where there is nothing to
/// compare.
std::vector<CheckedPicture> checkPictures(const CheckOptions &options);

} // namespace faintline
