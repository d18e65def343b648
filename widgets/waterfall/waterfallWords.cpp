#include "widgets/waterfall/waterfallWords.h"

#include "widgets/base/axisWords.h"
#include "widgets/base/cellsOf.h"
#include "widgets/base/labelText.h"
#include "widgets/base/rasterise.h"
#include "widgets/waterfall/WaterfallPicture.h"

#include <algorithm>

namespace faintline {

QString cursorText(const WaterfallPicture &view)
{
    if (!view.viewport() || !view.viewport()->cursor())
        return WaterfallPicture::tr("Arrow keys move the cursor, Ctrl and wheel zoom, 0 shows all.");
    const Viewport::Point &cursor = *view.viewport()->cursor();
    const Axis &frequency = view.frequencyAxis();
    const double resolution = frequency.step > 0.0 ? std::min(0.1, 0.1 * frequency.step) : 0.1;
    QString text =
        WaterfallPicture::tr("Cursor at %1, %2")
            .arg(view.hasTime() ? secondsText(cursor.seconds, 0.01)
                                : valueText(view.picture()->time(), cursor.seconds, 0.1),
                 frequency.unit == "Hz" ? hertzText(cursor.hz, resolution) : valueText(frequency, cursor.hz, 0.1));
    if (const auto value = view.valueAt(cursor.seconds, cursor.hz))
        text += WaterfallPicture::tr(", %1 %2").arg(numberText(*value, 1), view.valueUnit());
    return text;
}

QString boxText(const WaterfallPicture &view, const Viewport::Box &box)
{
    const Axis &frequency = view.frequencyAxis();
    const double seconds = box.time.width(), hz = box.frequency.width();
    QStringList words;
    if (view.hasTime())
        words << WaterfallPicture::tr("Δt %1").arg(secondsText(seconds, 0.01 * seconds));
    else
        words << QStringLiteral("Δ ") + valueText(view.picture()->time(), seconds, 0.01 * seconds);
    if (frequency.unit == "Hz" || frequency.unit.empty())
        words << WaterfallPicture::tr("Δf %1").arg(hertzText(hz, 0.01 * hz));
    else
        words << QStringLiteral("Δ ") + valueText(frequency, hz, 0.01 * hz);
    if (seconds > 0.0 && view.hasTime())
        words << WaterfallPicture::tr("%1 %2/s").arg(
            powerText(hz / seconds, 3),
            frequency.unit.empty() ? QStringLiteral("Hz") : labelText(frequency.unit, mostUnitLetters));
    if (view.picture() && view.picture()->frameCount() > 0 && frequency.count > 0) {
        const PeakPyramid &picture = view.finestPicture(box.time);
        Axis time = picture.time();
        time.count = picture.frameCount(); // existing frames of a run in progress
        const auto [firstFrame, endFrame] = cellsOf(time, box.time);
        const auto [firstCell, endCell] = cellsOf(frequency, box.frequency);
        const BoxValues values = boxValues(picture, firstFrame, endFrame, firstCell, endCell);
        words << WaterfallPicture::tr("peak %1 %2").arg(numberText(values.peak, 1), view.valueUnit());
        if (values.mean)
            words << WaterfallPicture::tr("mean %1 dB").arg(numberText(*values.mean, 1));
    }
    constexpr qsizetype perLine = 3; // extents and slope, then the levels
    const QString levels = words.mid(perLine).join(QStringLiteral(" · "));
    return words.mid(0, perLine).join(QStringLiteral(" · "))
           + (levels.isEmpty() ? QString() : QLatin1Char('\n') + levels);
}

QString sidebandText(const WaterfallPicture &view, const Sidebands &lines, double seconds)
{
    const double bin = view.frequencyAxis().step;
    const auto level = [&](int order) {
        const auto value = view.valueAt(seconds, lines.hz(order));
        return (value ? numberText(*value, 1) : QStringLiteral("–")).rightJustified(7);
    };
    QStringList rows{
        WaterfallPicture::tr("carrier %1 %2 %3").arg(hertzText(lines.carrierHz, bin), level(0), view.valueUnit()),
        WaterfallPicture::tr("spacing %1").arg(hertzText(lines.spacingHz, 0.1 * bin)),
        WaterfallPicture::tr(" n     −n     +n %1").arg(view.valueUnit())};
    for (int order = 1; order <= Sidebands::orders; ++order)
        rows << QStringLiteral("%1 %2%3").arg(order, 2).arg(level(-order), level(order));
    return rows.join(QLatin1Char('\n'));
}

} // namespace faintline
