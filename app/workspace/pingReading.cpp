#include "app/workspace/pingReading.h"

#include "app/control/OutputLayers.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"
#include "widgets/pings/PingMap.h"

#include <QCoreApplication>
#include <QStringList>

#include <cmath>

namespace faintline {

namespace {

    QString tr(const char *text)
    {
        return QCoreApplication::translate("pingReading", text);
    }

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
        const auto there = view.valueAt(place.range, place.bearing);
        return there ? numberText(*there, 1) : QStringLiteral("–");
    }

    QString rateText(const Axis &axis, const Axis &time, double perSecond)
    {
        return numberText(perSecond, decimalsFor(axis.step / time.step)) + unitText(axis) + QStringLiteral("/s");
    }

} // namespace

QString pingReading(const PingPictures &pictures, Index ping, const PingMarks::Place &place)
{
    const Axis &time = pictures.analysis.time();
    const Axis &ranges = pictures.analysis.grid().axes[0];
    const Axis &bearings = pictures.analysis.grid().axes[1];
    const PingMarks::Place cell{ranges.value(double(ranges.nearest(place.range))),
                                bearings.value(double(bearings.nearest(place.bearing)))};
    QStringList words{
        tr("ping %1/%2").arg(ping + 1).arg(time.count),
        secondsText(time.value(double(ping)), 1.0),
        axisText(ranges, cell.range),
        axisText(bearings, cell.bearing),
        tr("y %1 dB").arg(valueText(*pictures.input.plane(), cell)),
        tr("D %1 %2").arg(valueText(*pictures.output.plane(), cell), pictures.output.plane()->valueUnit())};
    if (const auto best = pictures.layers.readingAt({time.value(double(ping)), {cell.range, cell.bearing}}))
        words << tr("best state %1, %2")
                     .arg(rateText(ranges, time, best->ratePerSecond),
                          rateText(bearings, time, best->secondRatePerSecond))
              << tr("path age %1").arg(std::lround(best->ageSeconds / time.step));
    if (const PingMarks::Box *box = pictures.marks.boxAt(cell))
        words << (box->pings == 1 ? tr("inhibited: track %1, from now on").arg(box->track)
                                  : tr("inhibited: track %1, %2 pings").arg(box->track).arg(box->pings));
    return words.join(QStringLiteral(" · "));
}

} // namespace faintline
