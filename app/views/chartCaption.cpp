#include "app/views/chartCaption.h"

#include "app/base/tr.h"
#include "app/panels/differenceWords.h"
#include "app/panels/experimentWords.h"
#include "widgets/base/settingWords.h"

#include <QCoreApplication>
#include <QStringList>

namespace faintline {

namespace {

    constexpr int longest = 900; ///< letters

    QString joined(const QStringList &parts)
    {
        const QString program = QStringLiteral("Faintline " FAINTLINE_VERSION);
        QString text = parts.join(QStringLiteral("; "));
        if (text.size() > longest)
            text = text.left(longest) + QStringLiteral(" …");
        return text.isEmpty() ? program : QStringLiteral("%1. %2").arg(text, program);
    }

    QString stageOf(const FieldInfo &field)
    {
        return QString::fromStdString(field.name).section(QLatin1Char('.'), 0, 0);
    }

    /// "false alarms 2 1/h"
    QString wordsOf(const SettingDifference &difference)
    {
        const FieldInfo &field = difference.field;
        const QString label = QString::fromStdString(labelOf(field));
        const QString stage = stageLabel(stageOf(field));
        const QString words = QStringLiteral("%1 %2").arg(label, valueWords(field, difference.b));
        return stage == label ? words : QStringLiteral("%1: %2").arg(stage, words);
    }

    /// The threshold in whatever way it is given, at its default as well.
    SettingDifference thresholdOf(const AnalysisSettings &settings)
    {
        const Field<AnalysisSettings> &field =
            settingField("decide." + std::string(DecideSettings::byNames[std::size_t(settings.decide.by)]));
        return {field, {}, formatFieldValue(field, *field.get(settings))};
    }

    /// The settings that differ from the defaults.
    QStringList settingsIn(const AnalysisSettings &settings, CaptionOf what)
    {
        static const QStringList ofInput{"selection", "spectrogram", "noise", "pings", "family"};
        QStringList words;
        for (const SettingDifference &difference : settingDifferences(AnalysisSettings(), settings)) {
            const bool matters = what == CaptionOf::Statistic || ofInput.contains(stageOf(difference.field));
            if (matters && !difference.b.empty())
                words << wordsOf(difference.field.name == "decide.by" ? thresholdOf(settings) : difference);
        }
        words.removeDuplicates();
        return words;
    }

    QStringList detectorsIn(const Experiment &experiment)
    {
        QStringList words;
        for (const DetectorUnderTest &one : detectorsOf(experiment)) {
            const QStringList settings = settingsIn(one.settings, CaptionOf::Statistic);
            const QString name = QString::fromStdString(one.name);
            words << (settings.isEmpty() ? name : QStringLiteral("%1 (%2)").arg(name, settings.join(", ")));
        }
        return words;
    }

} // namespace

QString captionOf(const Document &document, CaptionOf what)
{
    if (document.isEmpty())
        return QString();
    return joined(QStringList{document.sourceName()} + settingsIn(document.settings(), what));
}

QString captionOf(const Experiments::Entry &entry)
{
    QStringList parts{entry.name};
    if (entry.campaign)
        parts << tr("%1 runs done").arg(entry.runsDone()) << experimentWords(entry.campaign->experiment)
              << detectorsIn(entry.campaign->experiment);
    return joined(parts);
}

} // namespace faintline
