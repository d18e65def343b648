#include "widgets/base/settingWords.h"

#include "plan/AnalysisSettings.h"
#include "widgets/base/quantities.h"

#include <QHash>

#include <algorithm>

namespace faintline {

namespace {

    QString spelled(const QString &camelCase)
    {
        return QString::fromStdString(spelledOut(camelCase.toStdString()));
    }

} // namespace

QString settingLabel(const QString &name)
{
    const auto &fields = AnalysisSettings::fields();
    const auto found = std::ranges::find(fields, name.toStdString(), &FieldInfo::name);
    if (found != fields.end())
        return QString::fromStdString(labelOf(*found));
    FieldInfo unknown;
    unknown.name = name.toStdString();
    return QString::fromStdString(labelOf(unknown));
}

QString stageLabel(const QString &prefix)
{
    static const QHash<QString, QString> labels{
        {"selection", "Selection"},
        {"spectrogram", "Spectrogram"},
        {"noise", "Noise background"},
        {"pings", "Noise of pings"},
        {"family", "Family of lines"},
        {"model", "Signal model"},
        {"detector", "Detector"},
        {"decide", "Threshold"},
        {"smd", "Sequential Markov"},
        {"pOfN", "P out of N"},
        {"integrator", "Integrator"},
        {"blockViterbi", "Fixed-window Viterbi"},
        {"shiryaevRoberts", "Shiryaev–Roberts"},
        {"track", "Tracks"},
        {"subtract", "Strong lines"},
        {"sprt", "Error probabilities"},
        {"design", "Design"},
        {"scene", "Scene"},
        {"runs", "Runs"},
    };
    const auto found = labels.constFind(prefix);
    return found != labels.constEnd() ? *found : capitalised(spelled(prefix));
}

QString choiceLabel(const FieldInfo &setting, const QString &choice)
{
    static const QHash<QString, QString> ofSetting{
        {"likelihood.exponential", "fluctuating"},
        {"shape.exponential", "exponential"},
    };
    static const QHash<QString, QString> labels{
        {"auto", "found automatically"},
        {"hann", "Hann"},
        {"hamming", "Hamming"},
        {"blackman", "Blackman"},
        {"blackmanHarris", "Blackman–Harris"},
        {"rice", "constant (Rice)"},
        {"swerling4", "fluctuating (Swerling 4)"},
        {"linear", "plain power"},
        {"halfDown", "half rounds down"},
        {"trunc", "toward zero"},
        {"calibrated", "calibrated"},
        {"half", "regulated"},
        {"mean", "Parsons' mean"},
        {"smd", "sequential Markov"},
        {"pOfN", "P out of N"},
        {"integrator", "integrator"},
        {"energy", "single-frame energy"},
        {"blockViterbi", "fixed-window Viterbi"},
        {"shiryaevRoberts", "Shiryaev–Roberts"},
        {"offsets", "fixed distances"},
        {"inTurn", "one at a time"},
        {"slopes", "slope set"},
        {"binsPerFrame", "bins/frame"},
        {"hzPerSecond", "Hz/s"},
        {"nonManoeuvring", "rates kept"},
        {"manoeuvring", "manoeuvring"},
        {"bank", "both in parallel"},
        {"falseAlarmsPerHour", "false alarms/h"},
        {"pfaPerCell", "Pfa per cell"},
        {"thresholdNats", "nats"},
    };
    const QString name = QString::fromStdString(setting.name).section(QLatin1Char('.'), -1);
    if (const auto own = ofSetting.constFind(name + QLatin1Char('.') + choice); own != ofSetting.constEnd())
        return *own;
    const auto found = labels.constFind(choice);
    return found != labels.constEnd() ? *found : spelled(choice);
}

} // namespace faintline
