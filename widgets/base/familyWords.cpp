#include "widgets/base/familyWords.h"

#include "frames/familyMembers.h"
#include "widgets/base/quantities.h"

#include <QCoreApplication>
#include <QStringList>

#include <algorithm>
#include <vector>

namespace faintline {

namespace {

    constexpr std::size_t mostLines = 12;

    QString column(const QStringList &texts, qsizetype row)
    {
        qsizetype width = 0;
        for (const QString &text : texts)
            width = std::max(width, text.size());
        return texts[row].rightJustified(width);
    }

} // namespace

QString frequencyName(const FamilySettings &family)
{
    return family.relation == FamilySettings::Relation::Harmonics
               ? QCoreApplication::translate("familyWords", "Fundamental")
               : QCoreApplication::translate("familyWords", "Frequency");
}

QString memberText(const FamilySettings &family, double member)
{
    return QString::fromStdString(memberName(family, member)).replace(QLatin1Char('-'), QChar(0x2212));
}

QString toothText(const FamilySettings &family, const FamilyTooth &tooth)
{
    const QString channel = QCoreApplication::translate("familyWords", "channel %1").arg(tooth.channel);
    if (tooth.channel < 0)
        return memberText(family, tooth.member);
    return family.isNone() ? channel : memberText(family, tooth.member) + QStringLiteral(", ") + channel;
}

QString membersText(const AnalysisPlan &plan, double hz)
{
    const FamilySettings &family = plan.settings.family;
    if (family.isNone())
        return {};
    const double resolution = plan.grid().axes.back().step;
    const std::vector<double> frequencies = memberFrequencies(family, hz);
    QStringList names, places;
    for (std::size_t k = 0; k < frequencies.size(); ++k) {
        if (frequencies.size() > mostLines && k == mostLines - 2) {
            names << QStringLiteral("…");
            places << QString();
        }
        if (frequencies.size() <= mostLines || k < mostLines - 2 || k + 1 == frequencies.size()) {
            names << memberText(family, family.members[k]);
            places << hertzText(frequencies[k], resolution);
        }
    }
    QStringList lines;
    for (qsizetype row = 0; row < names.size(); ++row)
        lines << column(names, row) + QStringLiteral("  ") + column(places, row);
    return lines.join(QLatin1Char('\n'));
}

} // namespace faintline
