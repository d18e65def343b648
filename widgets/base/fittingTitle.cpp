#include "widgets/base/fittingTitle.h"

#include <QFontMetrics>

namespace faintline {

namespace {

    constexpr int margin = 4; ///< pixels that a plot's label leaves free

    QString firstThatFits(const QString &whole, const QString &shorter, const QFont &font, int room)
    {
        const QFontMetrics metrics(font);
        for (const QString &text : {whole, shorter})
            if (!text.isEmpty() && metrics.horizontalAdvance(text) + margin <= room)
                return text;
        return metrics.elidedText(shorter.isEmpty() ? whole : shorter, Qt::ElideRight, room - margin);
    }

} // namespace

QString fittingTitle(const QString &title, const QFont &font, int room)
{
    const qsizetype bracket = title.lastIndexOf(QLatin1String(" ("));
    const bool hasUnit = bracket > 0 && title.endsWith(QLatin1Char(')'));
    return firstThatFits(title, hasUnit ? title.mid(bracket + 2).chopped(1) : QString(), font, room);
}

QString fittingHeading(const QString &heading, const QFont &font, int room)
{
    return firstThatFits(heading, heading.section(QLatin1String(" ("), 0, 0), font, room);
}

} // namespace faintline
