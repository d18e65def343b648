#include "widgets/base/settingWords.h"

#include "widgets/base/quantities.h"

#include <QHash>
#include <QSet>

namespace faintline {

namespace {

    /// "windowSeconds" → "window seconds".
    QString spelled(const QString &camelCase)
    {
        QString words;
        for (const QChar c : camelCase) {
            if (c.isUpper() && !words.isEmpty())
                words += QLatin1Char(' ');
            words += c.toLower();
        }
        return words;
    }

} // namespace

QString settingLabel(const QString &name)
{
    static const QHash<QString, QString> labels{
        {"selection.channel", "Channel"},
        {"selection.channels", "Channels added"},
        {"selection.fromSeconds", "From"},
        {"selection.toSeconds", "To"},
        {"selection.lowHz", "Lower edge"},
        {"selection.highHz", "Upper edge"},
        {"spectrogram.windowSeconds", "Window length"},
        {"spectrogram.stepsPerWindow", "Frames per window"},
        {"spectrogram.binsPerCell", "Bins per cell"},
        {"spectrogram.window", "Window shape"},
        {"noise.halfWidthCells", "Half width"},
        {"noise.blockWindows", "Block length"},
        {"noise.followLevel", "Follow level changes"},
        {"pings.values", "Numbers are"},
        {"pings.rangeCells", "Noise half width"},
        {"pings.guardCells", "Guard cells"},
        {"pings.blockPings", "Block length"},
        {"pings.followPing", "Follow level of pings"},
        {"pings.pastOnly", "Past pings only"},
        {"family.relation", "Lines detected together"},
        {"family.members", "Members"},
        {"family.present", "Present"},
        {"model.slopeUnit", "Slopes given in"},
        {"model.lowestSlope", "Lowest slope"},
        {"model.highestSlope", "Highest slope"},
        {"model.slopesPerBin", "Slopes per bin"},
        {"model.slopeChange", "Slope change law"},
        {"model.rangeRateChange", "Range rate change law"},
        {"model.bearingRateChange", "Bearing rate change law"},
        {"model.rounding", "Rounding"},
        {"model.likelihood", "Signal law"},
        {"model.snr", "Design SNR"},
        {"model.motion", "Motion"},
        {"detector.kind", "Kind"},
        {"pOfN.p", "P, frames needed"},
        {"pOfN.n", "N, frames in window"},
        {"pOfN.r1", "Event threshold r1"},
        {"pOfN.r2", "Mean threshold r2"},
        {"pOfN.widthCells", "Bandwidth"},
        {"integrator.shape", "Shape"},
        {"integrator.durationWindows", "Duration"},
        {"blockViterbi.durationWindows", "Block length"},
        {"shiryaevRoberts.lnK", "ln K"},
        {"decide.forgetCells", "Forget half width"},
        {"decide.resets", "Forget under tracks"},
        {"decide.inhibits", "Inhibit around tracks"},
        {"smd.reset", "Reset rule"},
        {"smd.lnK", "ln K"},
        {"decide.falseAlarmsPerHour", "False alarms"},
        {"decide.pfaPerCell", "Pfa per cell"},
        {"decide.thresholdNats", "Threshold"},
        {"decide.by", "Set by"},
        {"decide.linkCells", "Link distance"},
        {"decide.inhibitCells", "Inhibit half width"},
        {"subtract.lines", "Subtract strong lines"},
        {"subtract.leastDb", "Least level"},
        {"track.windowCells", "Window half width"},
        {"track.decayNats", "Decay per frame"},
        {"track.ceilingNats", "Ceiling"},
        {"track.endNats", "End below"},
        {"track.confirmNats", "Confirm above"},
        {"track.confirmFrames", "Confirm after"},
        {"track.smoothingFrames", "Smoothing lag"},
        {"track.bothWays", "Both ways"},
        {"sprt.falseAlarm", "False alarms α"},
        {"sprt.miss", "Misses β"},
        {"sprt.cutOffStage", "Cut-off stage"},
        {"design.snrDb", "Design SNR"},
        {"design.averagedCells", "Averaged cells"},
        {"scene.snrDb", "True SNR"},
        {"scene.moveCells", "Step deviation"},
        {"runs.walks", "Walks shown"},
        {"runs.trials", "Tests per point"},
        {"runs.designFollows", "Design at each SNR"},
        {"survey.targetSectors", "With a target"},
    };
    const auto found = labels.constFind(name);
    return found != labels.constEnd() ? *found : capitalised(spelled(name.section(QLatin1Char('.'), -1)));
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
        {"survey", "Sectors"},
    };
    const auto found = labels.constFind(prefix);
    return found != labels.constEnd() ? *found : capitalised(spelled(prefix));
}

QString choiceLabel(const QString &choice)
{
    static const QHash<QString, QString> labels{
        {"auto", "found automatically"},
        {"hann", "Hann"},
        {"hamming", "Hamming"},
        {"blackman", "Blackman"},
        {"blackmanHarris", "Blackman–Harris"},
        {"rice", "constant (Rice)"},
        {"exponential", "fluctuating"},
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
    const auto found = labels.constFind(choice);
    return found != labels.constEnd() ? *found : spelled(choice);
}

QString settingExample(const QString &name)
{
    static const QHash<QString, QString> examples{
        {"selection.channels", "all, or 0, 1"},
        {"family.members", "1, 2, 3 or -50, 50"},
    };
    return examples.value(name);
}

bool isSeldomUsed(const QString &name)
{
    static const QSet<QString> names{"model.rangeRateChange",
                                     "model.bearingRateChange",
                                     "noise.blockWindows",
                                     "noise.followLevel",
                                     "pings.blockPings",
                                     "pings.followPing",
                                     "pings.pastOnly",
                                     "selection.channels",
                                     "family.present",
                                     "model.slopeChange",
                                     "model.rounding",
                                     "model.likelihood",
                                     "smd.lnK",
                                     "decide.linkCells",
                                     "decide.inhibitCells",
                                     "track.windowCells",
                                     "track.decayNats",
                                     "track.ceilingNats",
                                     "track.smoothingFrames",
                                     "track.bothWays",
                                     "spectrogram.binsPerCell",
                                     "model.motion",
                                     "decide.forgetCells",
                                     "decide.resets",
                                     "decide.inhibits",
                                     "pOfN.r2",
                                     "pOfN.widthCells",
                                     "scene.azimuthCells",
                                     "scene.elevationCells",
                                     "scene.moves",
                                     "scene.moveCells",
                                     "scene.seed"};
    return names.contains(name);
}

} // namespace faintline
