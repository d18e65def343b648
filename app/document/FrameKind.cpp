#include "app/document/FrameKind.h"

#include "app/base/tr.h"

#include <QCoreApplication>

namespace faintline {

const FrameKind &lineFrames()
{
    static const FrameKind kind{
        .frame = tr("frame"),
        .frames = tr("frames"),
        .cellsPerFrame = tr("bins/frame"),
        .cellPerFrame = tr("bin/frame"),
        .signal = tr("a line"),
        .rate = tr("slope"),
        .anyRate = tr("slope"),
        .ageUnit = {},
        .handLineHint = tr("Press Draw and drag a line through the input where you expect a signal. Cover the "
                           "statistic first to make it a prediction."),
        .sections = {},
    };
    return kind;
}

const FrameKind &pingFrames()
{
    static const FrameKind kind{
        .frame = tr("ping"),
        .frames = tr("pings"),
        .cellsPerFrame = tr("cells/ping"),
        .cellPerFrame = tr("cell/ping"),
        .signal = tr("a target"),
        .rate = tr("%1 rate"),
        .anyRate = tr("either rate"),
        .ageUnit = tr("pings"),
        .handLineHint = tr("Lines can be drawn through recordings, not through pings."),
        .sections = {QStringLiteral("conventional")},
        .takesBoxes = false,
        .isSeenSingly = true,
    };
    return kind;
}

const FrameKind &scanFrames()
{
    static const FrameKind kind = [] {
        FrameKind scans = pingFrames();
        scans.frame = tr("scan");
        scans.frames = tr("scans");
        scans.cellsPerFrame = tr("cells/scan");
        scans.cellPerFrame = tr("cell/scan");
        scans.anyRate = tr("any rate");
        scans.ageUnit = tr("scans");
        scans.hasHiddenAxes = true;
        scans.handLineHint = tr("Lines can be drawn through recordings, not through scans.");
        return scans;
    }();
    return kind;
}

const FrameKind &frameKindOf(const Grid &grid)
{
    if (grid.isSpectrum())
        return lineFrames();
    return grid.isSurface() ? pingFrames() : scanFrames();
}

} // namespace faintline
