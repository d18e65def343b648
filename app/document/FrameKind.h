#pragma once

#include "base/Grid.h"

#include <QString>

#include <string>
#include <vector>

namespace faintline {

/// Operations and terms for the frames of a source. There are three kinds: frames of a recording's spectrum, with cells
/// over frequency; sonar pings, with cells over range and bearing; and a radar's scans, with cells over more axes.
///
/// All differences in their treatment are defined here, instead of by counting axes.
struct FrameKind {
    QString frame;         ///< "frame", "ping"
    QString frames;        ///< "frames", "pings"
    QString cellsPerFrame; ///< the unit of rates: "bins/frame", "cells/ping"
    QString cellPerFrame;  ///< of fractions of it: "bin/frame", "cell/ping"
    QString signal;        ///< what is detected: "a line", "a target"
    QString rate;          ///< along an axis of the name %1: "slope"; "%1 rate"
    QString anyRate;       ///< along any one of the axes: "slope", "either rate"
    QString ageUnit;       ///< of the age of paths; empty: s or h
    QString handLineHint;  ///< how a line is drawn by hand, or why none can be
    /// Sections of the settings for this kind alone.
    std::vector<QString> sections;

    /// Time × frequency is one picture, in which boxes can be measured, analysed and annotated, and lines drawn by
    /// hand.
    bool takesBoxes = true;
    /// Each frame is a separate picture. The one under the cursor is shown.
    bool isSeenSingly = false;
    /// Two of its axes are shown at a time; the others are reduced to maxima, or cut.
    bool hasHiddenAxes = false;

    /// Whether the same parts of the window show frames of the other kind.
    bool isShownLike(const FrameKind &other) const { return isSeenSingly == other.isSeenSingly; }
    QString rateName(const Axis &axis) const
    {
        return QString(rate).replace(QStringLiteral("%1"), QString::fromStdString(axis.name));
    }
};

/// The kind of frames on a grid. There is one object per kind, so their addresses can be compared.
const FrameKind &frameKindOf(const Grid &grid);

/// The kind of a recording's frames.
const FrameKind &lineFrames();
const FrameKind &pingFrames(); ///< two axes
const FrameKind &scanFrames(); ///< more axes, of which two are shown at a time

} // namespace faintline
