#include "app/panels/differenceWords.h"

#include "widgets/base/settingWords.h"

#include <algorithm>

namespace faintline {

QString differenceWords(const SettingDifference &difference)
{
    const auto value = [&](const std::string &text) {
        const QString word = QString::fromStdString(text);
        if (word.isEmpty())
            return QStringLiteral("–");
        return difference.field.kind == FieldKind::Choice ? choiceLabel(difference.field, word) : word;
    };
    const QString name = QString::fromStdString(difference.field.name);
    const QString label = name == QLatin1String("detector.kind") ? stageLabel(QStringLiteral("detector"))
                                                                 : QString::fromStdString(labelOf(difference.field));
    const bool isNumber = !std::ranges::count(difference.field.words, difference.b, &ValueWord::word);
    const QString unit = isNumber && !difference.field.unit.empty()
                             ? QLatin1Char(' ') + QString::fromStdString(difference.field.unit)
                             : QString();
    return QStringLiteral("%1 %2 → %3%4").arg(label, value(difference.a), value(difference.b), unit);
}

} // namespace faintline
