#include "app/document/FrameKind.h"

#include "base/Error.h"

#include <QCoreApplication>

namespace faintline {

namespace {

    QString tr(const char *text)
    {
        return QCoreApplication::translate("FrameKind", text);
    }

} // namespace

const FrameKind &lineFrames()
{
    static const FrameKind kind{
        .frame = tr("frame"),
        .frames = tr("frames"),
        .cellsPerFrame = tr("bins/frame"),
        .cellPerFrame = tr("bin/frame"),
        .signal = tr("a line"),
        .rates = {tr("slope")},
        .preset = {},
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
        .rates = {tr("range rate"), tr("bearing rate")},
        .preset = "sonar",
        .ageUnit = tr("pings"),
        .handLineHint = tr("Lines can be drawn through recordings, not through pings."),
        .sections = {QStringLiteral("conventional")},
        .takesBoxes = false,
        .isSeenSingly = true,
    };
    return kind;
}

const FrameKind &frameKindOf(const Grid &grid, const std::string &where)
{
    switch (const std::size_t count = grid.axes.size()) {
    case 1:
        return lineFrames();
    case 2:
        return pingFrames();
    default:
        throw Error(where, "has frames on " + std::to_string(count)
                               + " axes; at most two can be shown (faintline-cli sequential accepts more)");
    }
}

} // namespace faintline
