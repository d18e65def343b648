#include "app/features/events/differenceWords.h"

#include "app/base/tr.h"
#include "base/Field.h"
#include "widgets/base/settingWords.h"

#include <QCoreApplication>
#include <QStringList>

#include <algorithm>

namespace faintline {

namespace {

    QString textOf(const FieldInfo &field, const std::string &value)
    {
        const QString text = QString::fromStdString(value);
        if (field.kind == FieldKind::Choice)
            return choiceLabel(field, text);
        if (field.kind == FieldKind::Flag)
            return text == QLatin1String("true") ? tr("on") : tr("off");
        constexpr int digits = 6; // as many as anybody reads; files have all
        QStringList numbers = text.split(QLatin1Char(','));
        for (QString &number : numbers)
            if (const auto parsed = parseNumber(number.trimmed().toStdString()))
                number = QString::number(*parsed, 'g', digits);
            else
                number = number.trimmed();
        return numbers.join(QStringLiteral(", "));
    }

    bool isNumber(const FieldInfo &field, const std::string &value)
    {
        return field.kind != FieldKind::Choice && field.kind != FieldKind::Flag
               && !std::ranges::count(field.words, value, &ValueWord::word);
    }

} // namespace

QString valueWords(const FieldInfo &field, const std::string &value)
{
    const QString unit = isNumber(field, value) ? QString::fromStdString(field.unit) : QString();
    return unit.isEmpty() ? textOf(field, value) : textOf(field, value) + QLatin1Char(' ') + unit;
}

QString differenceWords(const SettingDifference &difference)
{
    const FieldInfo &field = difference.field;
    const QString dash = QStringLiteral("–");
    const QString label =
        field.name == "detector.kind" ? stageLabel(QStringLiteral("detector")) : QString::fromStdString(labelOf(field));
    return QStringLiteral("%1 %2 → %3")
        .arg(label, difference.a.empty() ? dash : textOf(field, difference.a),
             difference.b.empty() ? dash : valueWords(field, difference.b));
}

} // namespace faintline
