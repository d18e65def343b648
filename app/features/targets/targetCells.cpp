#include "app/features/targets/targetCells.h"

#include "app/base/tr.h"

#include <QCoreApplication>

#include <algorithm>

namespace faintline {

namespace {

    template <class S>
    const FieldInfo &infoNamed(const std::vector<Field<S>> &fields, const std::string &name)
    {
        return *std::find_if(fields.begin(), fields.end(), [&](const Field<S> &field) { return field.name == name; });
    }

    /// The member that a column shows; for the columns of numbers only.
    FieldInfo infoOf(TargetColumn column, RateUnit unit)
    {
        const bool isPerPing = unit == RateUnit::PerPing;
        switch (column) {
        case TargetColumn::Snr:
            return infoNamed(PingTarget::fields(), "snrDb");
        case TargetColumn::Fluctuation:
            return infoNamed(PingTarget::fields(), "fluctuation");
        case TargetColumn::Range:
            return infoNamed(PingTarget::fields(), "rangeMetres");
        case TargetColumn::Bearing:
            return infoNamed(PingTarget::fields(), "bearingDegrees");
        case TargetColumn::From:
            return infoNamed(PingTarget::fields(), "appearPing");
        case TargetColumn::Until:
            return infoNamed(PingTarget::fields(), "vanishPing");
        case TargetColumn::RangeRate:
            return infoNamed(PingLeg::fields(), isPerPing ? "rangeCellsPerPing" : "rangeRateMetresPerSecond");
        case TargetColumn::BearingRate:
            return infoNamed(PingLeg::fields(), isPerPing ? "beamsPerPing" : "bearingRateDegreesPerSecond");
        case TargetColumn::Turn:
            return infoNamed(PingLeg::fields(), "turnPings");
        default:
            return infoNamed(PingLeg::fields(), "pings");
        }
    }

    QString wordOf(TargetColumn column)
    {
        switch (column) {
        case TargetColumn::Target:
            return tr("Target");
        case TargetColumn::Snr:
            return tr("SNR");
        case TargetColumn::Fluctuation:
            return tr("Fluctuation");
        case TargetColumn::Range:
            return tr("Range");
        case TargetColumn::Bearing:
            return tr("Bearing");
        case TargetColumn::From:
            return tr("From ping");
        case TargetColumn::Until:
            return tr("Until ping");
        case TargetColumn::Leg:
            return tr("Leg");
        case TargetColumn::Pings:
            return tr("Pings");
        case TargetColumn::RangeRate:
            return tr("Range rate");
        case TargetColumn::BearingRate:
            return tr("Bearing rate");
        case TargetColumn::Turn:
            return tr("Turn");
        }
        return {};
    }

    /// "Target T2, leg 1, range rate".
    std::string nameOf(const TargetRow &row, TargetColumn column)
    {
        const QString word = column == TargetColumn::Snr ? wordOf(column) : wordOf(column).toLower();
        const QString target = tr("Target T%1").arg(row.target + 1);
        return (isOfLeg(column) ? tr("%1, leg %2, %3").arg(target).arg(std::max(row.leg, 0) + 1).arg(word)
                                : tr("%1, %2").arg(target, word))
            .toStdString();
    }

    /// "swerling1" → "Swerling 1"
    QString textOf(Fluctuation fluctuation)
    {
        return fluctuation == Fluctuation::None ? tr("none") : tr("Swerling %1").arg(int(fluctuation));
    }

    /// From its text, in any case and with or without blanks, its name or its number.
    Fluctuation fluctuationOf(const FieldInfo &info, const QString &text)
    {
        QString plain = text.toLower().remove(QLatin1Char(' '));
        if (plain == QLatin1String("0") || plain == tr("none"))
            plain = QStringLiteral("none");
        else if (plain.size() == 1 && plain[0].isDigit())
            plain.prepend(QStringLiteral("swerling"));
        const auto name = std::get<std::string>(parseFieldValue(info, plain.toStdString()));
        return static_cast<Fluctuation>(std::ranges::find(fluctuationNames, name) - fluctuationNames.begin());
    }

    bool canLastToTheEnd(TargetColumn column)
    {
        return column == TargetColumn::Until || column == TargetColumn::Pings;
    }

    double numberIn(const PingScene &scene, const TargetRow &row, TargetColumn column, RateUnit unit)
    {
        const PingTarget &target = scene.targets[std::size_t(row.target)];
        const PingLeg leg = row.leg < 0 ? PingLeg() : target.legs[std::size_t(row.leg)];
        switch (column) {
        case TargetColumn::Snr:
            return target.snrDb;
        case TargetColumn::Range:
            return target.rangeMetres;
        case TargetColumn::Bearing:
            return target.bearingDegrees;
        case TargetColumn::From:
            return target.appearPing + 1;
        case TargetColumn::Until:
            return target.vanishPing; // the first ping without it, from 0, is the last one with it, from 1
        case TargetColumn::Pings:
            return leg.pings;
        case TargetColumn::RangeRate:
            return rangeRateOf(leg, scene, unit);
        case TargetColumn::BearingRate:
            return bearingRateOf(leg, scene, unit);
        case TargetColumn::Turn:
            return leg.turnPings;
        default:
            return 0.0;
        }
    }

    void setNumber(PingScene &scene, const TargetRow &row, TargetColumn column, double number, RateUnit unit)
    {
        PingTarget &target = scene.targets[std::size_t(row.target)];
        if (isOfLeg(column) && target.legs.empty())
            target.legs.emplace_back();
        PingLeg *leg = isOfLeg(column) ? &target.legs[std::size_t(std::max(row.leg, 0))] : nullptr;
        switch (column) {
        case TargetColumn::Snr:
            target.snrDb = number;
            break;
        case TargetColumn::Range:
            target.rangeMetres = number;
            break;
        case TargetColumn::Bearing:
            target.bearingDegrees = number;
            break;
        case TargetColumn::From:
            target.appearPing = int(number) - 1;
            break;
        case TargetColumn::Until:
            target.vanishPing = int(number);
            break;
        case TargetColumn::Pings:
            leg->pings = int(number);
            break;
        case TargetColumn::RangeRate:
            setRangeRate(*leg, number, unit);
            break;
        case TargetColumn::BearingRate:
            setBearingRate(*leg, number, unit);
            break;
        case TargetColumn::Turn:
            leg->turnPings = int(number);
            break;
        default:
            break;
        }
    }

    /// The field with the range that the scene leaves to this cell.
    FieldInfo limitsOf(const PingScene &scene, const TargetRow &row, TargetColumn column, RateUnit unit)
    {
        FieldInfo info = infoOf(column, unit);
        info.name = nameOf(row, column);
        const PingTarget &target = scene.targets[std::size_t(row.target)];
        const Axis range = pingGrid(scene).axes[0];
        switch (column) {
        case TargetColumn::Range:
            info.minimum = range.first;
            info.maximum = range.last();
            break;
        case TargetColumn::From:
            info.unit.clear();
            info.minimum = 1.0;
            info.maximum = target.vanishPing == 0 ? scene.pings : std::min(target.vanishPing, scene.pings);
            break;
        case TargetColumn::Until:
            info.unit.clear();
            info.minimum = target.appearPing + 1;
            info.maximum = scene.pings;
            break;
        case TargetColumn::Pings:
            info.unit.clear();
            info.minimum = 1.0;
            info.maximum = scene.pings;
            break;
        case TargetColumn::Turn:
            info.unit.clear();
            info.maximum = scene.pings;
            break;
        default:
            break;
        }
        return info;
    }

} // namespace

std::vector<TargetRow> targetRows(const PingScene &scene)
{
    std::vector<TargetRow> rows;
    for (int target = 0; target < int(scene.targets.size()); ++target) {
        const int legs = int(scene.targets[std::size_t(target)].legs.size());
        if (legs == 0)
            rows.push_back({target, -1});
        for (int leg = 0; leg < legs; ++leg)
            rows.push_back({target, leg});
    }
    return rows;
}

bool isOfLeg(TargetColumn column)
{
    return column >= TargetColumn::Leg;
}

bool isEditable(const TargetRow &row, TargetColumn column)
{
    return column != TargetColumn::Target && column != TargetColumn::Leg && (isOfLeg(column) || row.isFirst());
}

QString titleOf(TargetColumn column, RateUnit unit)
{
    switch (column) {
    case TargetColumn::From:
        return tr("From");
    case TargetColumn::Until:
        return tr("Until");
    case TargetColumn::Target:
    case TargetColumn::Fluctuation:
    case TargetColumn::Leg:
    case TargetColumn::Pings:
        return wordOf(column);
    default:
        return tr("%1 (%2)").arg(wordOf(column), QString::fromStdString(infoOf(column, unit).unit));
    }
}

QString sentenceOf(TargetColumn column, RateUnit unit)
{
    switch (column) {
    case TargetColumn::Target:
        return tr("Number of the target on the map.");
    case TargetColumn::Fluctuation:
        return QString::fromStdString(infoOf(column, unit).sentence)
               + tr(" Type 1 to 4, or “none” for constant power.");
    case TargetColumn::Leg:
        return tr("Number of the target's leg.");
    case TargetColumn::From:
        return tr("First ping with the target, counted from 1.");
    case TargetColumn::Until:
        return tr("Last ping with the target, or “end”.");
    case TargetColumn::Pings:
        return tr("Number of pings in the leg; “end” extends the last leg to the end.");
    default:
        return QString::fromStdString(infoOf(column, unit).sentence);
    }
}

QString textOf(const PingScene &scene, const TargetRow &row, TargetColumn column, RateUnit unit)
{
    constexpr int digits = 6;
    if (column == TargetColumn::Target)
        return row.isFirst() ? QStringLiteral("T%1").arg(row.target + 1) : QString();
    if (column == TargetColumn::Leg)
        return row.leg < 0 ? QString() : QString::number(row.leg + 1);
    if (isOfLeg(column) ? row.leg < 0 : !row.isFirst())
        return {};
    if (column == TargetColumn::Fluctuation)
        return textOf(scene.targets[std::size_t(row.target)].fluctuation);
    const double number = numberIn(scene, row, column, unit);
    return canLastToTheEnd(column) && number == 0.0 ? tr("end") : QString::number(number, 'g', digits);
}

PingScene withText(const PingScene &scene, const TargetRow &row, TargetColumn column, const QString &text,
                   RateUnit unit)
{
    QString plain = text.trimmed();
    plain.replace(QChar(0x2212), QLatin1Char('-'));
    PingScene after = scene;
    FieldInfo info = limitsOf(scene, row, column, unit);
    if (canLastToTheEnd(column) && (plain == tr("end") || plain == QLatin1String("0"))) {
        const int legs = int(scene.targets[std::size_t(row.target)].legs.size());
        if (column == TargetColumn::Pings && row.leg + 1 < legs)
            throw fieldError(info.name, plain.toStdString(),
                             "must be a number of pings, because another leg follows this one");
        setNumber(after, row, column, 0.0, unit);
        return after;
    }
    if (column == TargetColumn::Fluctuation) {
        after.targets[std::size_t(row.target)].fluctuation = fluctuationOf(info, plain);
        checkScene(after);
        return after;
    }
    const FieldValue value = parseFieldValue(info, plain.toStdString());
    const int *whole = std::get_if<int>(&value);
    setNumber(after, row, column, whole ? *whole : std::get<double>(value), unit);
    return after;
}

} // namespace faintline
