#include "app/panels/differenceWords.h"

#include "widgets/base/settingWords.h"

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
    const QString unit =
        difference.field.unit.empty() ? QString() : QLatin1Char(' ') + QString::fromStdString(difference.field.unit);
    return QStringLiteral("%1 %2 → %3%4").arg(label, value(difference.a), value(difference.b), unit);
}

} // namespace faintline
