#include "app/views/chartCaption.h"

#include "app/base/tr.h"
#include "app/features/evaluate/experimentWords.h"
#include "app/features/events/differenceWords.h"
#include "widgets/base/settingWords.h"

#include <QCoreApplication>
#include <QStringList>

#include <algorithm>
#include <iterator>
#include <vector>

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

    /// The threshold in whatever way it is given, at its default as well.
    SettingDifference thresholdOf(const AnalysisSettings &settings)
    {
        const Field<AnalysisSettings> &field =
            settingField("decide." + std::string(DecideSettings::byNames[std::size_t(settings.decide.by)]));
        return {field, {}, formatFieldValue(field, *field.get(settings))};
    }

    struct StatedSetting {
        QString stage;
        QString words; ///< "Window length 0.5 s"
        bool operator==(const StatedSetting &) const = default;
    };
    using StatedSettings = std::vector<StatedSetting>;

    StatedSetting stated(const SettingDifference &difference)
    {
        const FieldInfo &field = difference.field;
        return {stageLabel(stageOf(field)),
                QStringLiteral("%1 %2").arg(QString::fromStdString(labelOf(field)), valueWords(field, difference.b))};
    }

    /// The settings that differ from the defaults.
    StatedSettings settingsIn(const AnalysisSettings &settings, CaptionOf what)
    {
        static const QStringList ofInput{"selection", "spectrogram", "noise", "pings", "family"};
        StatedSettings all;
        for (const SettingDifference &difference : settingDifferences(AnalysisSettings(), settings)) {
            const bool matters = what == CaptionOf::Statistic || ofInput.contains(stageOf(difference.field));
            if (!matters || difference.b.empty())
                continue;
            const StatedSetting one = stated(difference.field.name == "decide.by" ? thresholdOf(settings) : difference);
            if (std::ranges::find(all, one) == all.end())
                all.push_back(one);
        }
        return all;
    }

    /// The name of each stage once: "Spectrogram: Window length 0.5 s, Overlap 50 %". A label that begins with it, such
    /// as Threshold, stands alone.
    QStringList wordsOf(const StatedSettings &settings)
    {
        QStringList words;
        QString last;
        for (const StatedSetting &one : settings) {
            if (!words.isEmpty() && one.stage == last)
                words.back() += QStringLiteral(", ") + one.words;
            else
                words << (one.words.startsWith(one.stage) ? one.words
                                                          : QStringLiteral("%1: %2").arg(one.stage, one.words));
            last = one.stage;
        }
        return words;
    }

    /// What all detectors, or values of a sweep, have in common, then the name of each with its own settings.
    QStringList detectorsIn(const Experiment &experiment)
    {
        std::vector<DetectorUnderTest> detectors = experiment.detectors;
        for (std::size_t i = 0; i < experiment.values.size(); ++i)
            detectors.push_back({experiment.parameter + " = " + formatNumber(experiment.values[i]),
                                 experimentAt(experiment, i).settings});
        std::vector<StatedSettings> each;
        for (const DetectorUnderTest &one : detectors)
            each.push_back(settingsIn(one.settings, CaptionOf::Statistic));
        StatedSettings common;
        if (!each.empty())
            std::ranges::copy_if(each.front(), std::back_inserter(common), [&each](const StatedSetting &setting) {
                return std::ranges::all_of(
                    each, [&](const StatedSettings &own) { return std::ranges::find(own, setting) != own.end(); });
            });
        QStringList words = wordsOf(common);
        for (std::size_t i = 0; i < detectors.size(); ++i) {
            std::erase_if(each[i], [&common](const StatedSetting &setting) {
                return std::ranges::find(common, setting) != common.end();
            });
            const QString name = QString::fromStdString(detectors[i].name);
            words << (each[i].empty() ? name : QStringLiteral("%1 (%2)").arg(name, wordsOf(each[i]).join("; ")));
        }
        return words;
    }

} // namespace

QString captionOf(const Document &document, CaptionOf what)
{
    if (document.isEmpty())
        return QString();
    return joined(QStringList{document.sourceName()} + wordsOf(settingsIn(document.settings(), what)));
}

QString captionOf(const Experiments::Entry &entry)
{
    QStringList parts{entry.name};
    if (entry.campaign) {
        const Experiment &experiment = entry.campaign->experiment;
        if (entry.runsDone() < experiment.runs())
            parts << tr("%1 runs done").arg(entry.runsDone());
        parts << experimentWords(experiment) << detectorsIn(experiment);
    }
    return joined(parts);
}

} // namespace faintline
