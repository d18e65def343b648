#include "app/features/pictures/pingReading.h"

#include "app/base/tr.h"
#include "app/document/FrameKind.h"
#include "app/document/OutputLayers.h"
#include "frames/pictureCuts.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"
#include "widgets/pings/PingMap.h"

#include <QCoreApplication>
#include <QStringList>

#include <cmath>

namespace faintline {

namespace {

    QString unitText(const Axis &axis)
    {
        const QString unit = labelText(axis.unit, mostUnitLetters);
        return unit == QStringLiteral("°") ? unit : QLatin1Char(' ') + unit;
    }

    QString axisText(const Axis &axis, double value)
    {
        return numberText(value, decimalsFor(axis.step)) + unitText(axis);
    }

    QString valueText(const WaterfallView &view, const PingMarks::Place &place)
    {
        const auto there = view.valueAt(place.along, place.across);
        return there ? numberText(*there, 1) : QStringLiteral("–");
    }

    QString rateText(const Axis &axis, const Axis &time, double perSecond)
    {
        return numberText(perSecond, decimalsFor(axis.step / time.step)) + unitText(axis) + QStringLiteral("/s");
    }

    QString hiddenText(const Grid &grid, const FramePlane &plane, const std::vector<double> &position)
    {
        QStringList words;
        for (std::size_t axis = 0; axis < position.size(); ++axis)
            if (!plane.isShown(axis))
                words << labelText(grid.axes[axis].name, mostUnitLetters) + QLatin1Char(' ')
                             + axisText(grid.axes[axis], position[axis]);
        return words.isEmpty() ? QString() : QStringLiteral(" (%1)").arg(words.join(QStringLiteral(", ")));
    }

} // namespace

QString pingReading(const PingPictures &pictures, Index ping, const PingMarks::Place &place)
{
    const Axis &time = pictures.analysis.time();
    const Grid &grid = pictures.analysis.grid();
    const Axis &along = grid.axes[pictures.plane.along];
    const Axis &across = grid.axes[pictures.plane.across];
    const Index row = along.nearest(place.along);
    const Index column = across.nearest(place.across);
    const PingMarks::Place cell{along.value(double(row)), across.value(double(column))};
    const std::vector<double> position =
        grid.position(strongestCell(*pictures.analysis.statistic, grid, ping, pictures.plane, row, column));
    QStringList words{
        tr("%1 %2/%3").arg(frameKindOf(grid).frame).arg(ping + 1).arg(time.count),
        secondsText(time.value(double(ping)), 1.0),
        axisText(along, cell.along),
        axisText(across, cell.across) + hiddenText(grid, pictures.plane, position),
        tr("y %1 dB").arg(valueText(*pictures.input.plane(), cell)),
        tr("D %1 %2").arg(valueText(*pictures.output.plane(), cell), pictures.output.plane()->valueUnit())};
    if (const auto best = pictures.layers.readingAt({time.value(double(ping)), position}))
        words << tr("best state %1, %2")
                     .arg(rateText(along, time, best->ratePerSecond), rateText(across, time, best->secondRatePerSecond))
              << tr("path age %1").arg(std::lround(best->ageSeconds / time.step));
    if (const PingMarks::Box *box = pictures.marks.boxAt(cell))
        words << (box->pings == 1
                      ? tr("inhibited: track %1, from now on").arg(box->track)
                      : tr("inhibited: track %1, %2 %3").arg(box->track).arg(box->pings).arg(frameKindOf(grid).frames));
    return words.join(QStringLiteral(" · "));
}

} // namespace faintline
