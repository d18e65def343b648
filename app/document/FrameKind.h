#pragma once

#include "base/Grid.h"

#include <QString>

#include <string>
#include <vector>

namespace faintline {

/// Operations and terms for the frames of a source. There are two kinds: frames of a recording's spectrum, with cells
/// over frequency, and sonar pings, with cells over range and bearing.
///
/// All differences in their treatment are defined here, instead of by counting axes.
struct FrameKind {
    QString frame;              ///< "frame", "ping"
    QString frames;             ///< "frames", "pings"
    QString cellsPerFrame;      ///< the unit of rates: "bins/frame", "cells/ping"
    QString cellPerFrame;       ///< of fractions of it: "bin/frame", "cell/ping"
    QString signal;             ///< what is detected: "a line", "a target"
    std::vector<QString> rates; ///< along each axis: "slope"; "range rate", "bearing rate"
    std::string preset;         ///< initial preset for a source; empty: the defaults
    QString ageUnit;            ///< of the age of paths; empty: s or h
    QString handLineHint;       ///< how a line is drawn by hand, or why none can be
    /// Sections of the settings for this kind alone.
    std::vector<QString> sections;

    /// Time × frequency is one picture, in which boxes can be measured, analysed and annotated, and lines drawn by
    /// hand.
    bool takesBoxes = true;
    /// Each frame is a separate picture. The one under the cursor is shown.
    bool isSeenSingly = false;
};

/// The kind of frames on a grid of one or two axes. There is one object per kind, so their addresses can be compared.
/// Throws Error naming `where` for more axes.
const FrameKind &frameKindOf(const Grid &grid, const std::string &where = "frames");

/// The kind of a recording's frames.
const FrameKind &lineFrames();
const FrameKind &pingFrames();

} // namespace faintline
