#pragma once

#include "base/Grid.h"

#include <QString>

#include <string>
#include <vector>

namespace faintline {

/// What can be done with the frames of a source, and what they are called. There are two kinds: those of a recording's
/// spectrum, whose cells lie on frequency, and a sonar's pings, whose cells lie on range and bearing.
///
/// Whoever treats them differently reads the difference here; nobody counts axes.
struct FrameKind {
    QString frame;              ///< "frame", "ping"
    QString frames;             ///< "frames", "pings"
    QString cellsPerFrame;      ///< the unit of rates: "bins/frame", "cells/ping"
    QString cellPerFrame;       ///< of fractions of it: "bin/frame", "cell/ping"
    QString signal;             ///< what is looked for: "a line", "a target"
    std::vector<QString> rates; ///< along each axis: "slope"; "range rate", "bearing rate"
    std::string preset;         ///< that a source is looked at with first; empty: the defaults

    /// Time × frequency is one picture, in which boxes are measured, analysed and annotated, and lines drawn by hand.
    bool takesBoxes = true;
    /// Each frame is a picture of its own. The one under the cursor is looked at, and its age counted in frames.
    bool isSeenSingly = false;
    /// A conventional tracker runs beside the detector, for comparison.
    bool hasConventional = false;
};

/// Of frames on that grid, of one or two axes. There is one object a kind: their addresses can be compared. Throws
/// Error of more axes, which says `where` the frames are from.
const FrameKind &frameKindOf(const Grid &grid, const std::string &where = "frames");

/// The kind of a recording's frames.
const FrameKind &lineFrames();
const FrameKind &pingFrames();

} // namespace faintline
