// The tables of the settings that belong to no stage of their own.

#include "plan/AnalysisSettings.h"

namespace faintline {

namespace {

    /// Setting the value of one of the three thresholds also selects it.
    Field<DecideSettings> chosenBy(Field<DecideSettings> field, DecideSettings::By by)
    {
        field.set = [inner = field.set, by](DecideSettings &settings, const FieldValue &value) {
            inner(settings, value);
            settings.by = by;
        };
        return field;
    }

} // namespace

const std::vector<Field<ModelSettings>> &ModelSettings::fields()
{
    using S = ModelSettings;
    static const std::vector<Field<S>> table{
        field(&S::motion, "motion", motionNames,
              "Motion of signals: slopes as given here, or sonar targets that keep their rates, that turn, or both in "
              "parallel.")
            .labelled("Motion")
            .advanced()
            .advised("Targets that turn need more states than targets that keep their rates. Both in parallel take the "
                     "time and the memory of both, and have more false alarms at the same threshold."),
        field(&S::slopeUnit, "slopeUnit", slopeUnitNames,
              "Unit of the lowest and highest slope; Hz/s are converted to bins per frame with the window in use and "
              "rounded outward to a multiple of 1/slopesPerBin.")
            .labelled("Slopes given in")
            .advised("Slopes in Hz/s keep their meaning when the window changes; slopes in bins/frame keep the number "
                     "of states."),
        field(&S::lowestSlope, "lowestSlope", "bins/frame", -1e9, 1e9,
              "Most negative slope a line may have, at least -100 bins/frame; in Hz/s if model.slopeUnit is "
              "hzPerSecond.")
            .labelled("Lowest slope")
            .advised("Widen the range of slopes for faster lines. Time and memory are proportional to the number of "
                     "slopes, and the threshold rises, because noise offers more paths."),
        field(&S::highestSlope, "highestSlope", "bins/frame", -1e9, 1e9,
              "Most positive slope a line may have, at most 100 bins/frame; in Hz/s if model.slopeUnit is hzPerSecond.")
            .labelled("Highest slope")
            .advised("Widen the range of slopes for faster lines. Time and memory are proportional to the number of "
                     "slopes, and the threshold rises, because noise offers more paths."),
        field(&S::slopesPerBin, "slopesPerBin", "", 1.0, 64.0,
              "Number of slopes per bin/frame: 8 means steps of 1/8 bin/frame.")
            .labelled("Slopes per bin")
            .advised("Raise it for lines that remain straight over many frames; lower it for lines that turn within a "
                     "few. Time and memory are proportional to it."),
        field(&S::slopeChange, "slopeChange", "", 0.0, 1.0,
              "Law h(0), h(1), … of the slope's change from frame to frame, in steps of the slope set; h(0) + 2·(h(1) "
              "+ …) = 1.")
            .labelled("Slope change law")
            .advanced()
            .advised("Lower h(0) for signals that turn within a few frames. Expensive changes keep paths in noise from "
                     "following the brightest cells, so steady lines are found 1 to 2 dB earlier. Source: Billon 2005 "
                     "with h = (⅓, ⅓)."),
        field(&S::rangeRateChange, "rangeRateChange", "", 0.0, 1.0,
              "Law h(0), h(1), … of a manoeuvring target's change of range rate from ping to ping; h(0) + 2·(h(1) + …) "
              "= 1.")
            .labelled("Range rate change law")
            .advanced()
            .advised("Lower h(0) for targets that accelerate or turn. Steady targets are then detected later, because "
                     "noise follows the brightest cells at less cost."),
        field(&S::bearingRateChange, "bearingRateChange", "", 0.0, 1.0,
              "Law of the change of its bearing rate, in the "
              "same form.")
            .labelled("Bearing rate change law")
            .advanced()
            .advised("Lower h(0) for targets that cross or turn close to the sonar. Steady targets are then detected "
                     "later."),
        field(&S::rounding, "rounding", roundingNames, "Rounding of a movement by half a bin.")
            .labelled("Rounding")
            .advanced()
            .advised("It matters with slopes of whole bins only. halfDown is Billon's half-open interval."),
        field(&S::likelihood, "likelihood", likelihoodNames,
              "Signal law in a frame: constant amplitude (rice; also for Swerling 1 and 3), power that fluctuates from "
              "frame to frame (exponential: Swerling 2; swerling4), or the power itself (linear).")
            .labelled("Signal law")
            .advanced()
            .advised("Choose a fluctuating law for signals that fade from frame to frame: the constant law counts each "
                     "deep fade as evidence against them. Sources: Billon 2005, section 4; Parsons, equations 9 and "
                     "10; Grossi and Lops, equation 10."),
        field(&S::snr, "snr", "", 1e-6, 1e6,
              "Signal-to-noise ratio r0 for which the likelihood is designed, as a power ratio in one frame.")
            .labelled("Design SNR")
            .advised("Set it near the SNR of the weakest signals of interest. A higher value favours short strong "
                     "signals, a lower one long weak signals. It does not affect the time."),
    };
    return table;
}

const std::vector<Field<DecideSettings>> &DecideSettings::fields()
{
    using S = DecideSettings;
    static const std::vector<Field<S>> table{
        chosenBy(
            field(&S::falseAlarmsPerHour, "falseAlarmsPerHour", "1/h", 1e-9, 1e9,
                  "False alarms per hour of recording that the threshold permits on noise.")
                .labelled("False alarms")
                .advised("Raise it to find weaker signals among more false ones. It applies to the whole band, so a "
                         "wide band needs a higher threshold than a narrow one. Source: Billon 2005, section 3."),
            S::By::FalseAlarmsPerHour),
        chosenBy(
            field(&S::pfaPerCell, "pfaPerCell", "", 1e-15, 0.5,
                  "Probability that a cell of noise exceeds the threshold in a frame.")
                .labelled("Pfa per cell")
                .advised("Use it for comparison with detectors whose performance is published for one cell and frame. "
                         "The number of false alarms per hour is then proportional to the number of cells."),
            S::By::PfaPerCell),
        chosenBy(field(&S::thresholdNats, "thresholdNats", "nat", -100.0, 1e6, "Threshold on the statistic.")
                     .labelled("Threshold")
                     .advised("Use it to keep a threshold while other settings change. The number of false alarms then "
                              "depends on these settings."),
                 S::By::Nats),
        field(&S::by, "by", S::byNames, "Quantity that sets the threshold.")
            .labelled("Set by")
            .advised("False alarms per hour suit recordings, the probability per cell comparisons, and nats a "
                     "threshold found by hand."),
        field(&S::linkCells, "linkCells", "bins", 0.0, 1000.0,
              "Largest distance between threshold crossings of one event, per axis; the last number repeats.")
            .labelled("Link distance")
            .advanced()
            .advised("Raise it if one broad signal gives several events beside each other. Two lines that are closer "
                     "than this become one event."),
        field(
            &S::inhibitCells, "inhibitCells", "cells", 0.0, 1000.0,
            "Half width, in resolution cells, of the box inhibited around a track, per axis; the last number repeats.")
            .labelled("Inhibit half width")
            .advanced()
            .advised("Raise it if the skirts of strong signals give events of their own. Weaker signals in the box are "
                     "not detected while the track lasts. The box is widened automatically to the side lobes of the "
                     "window. Source: Parsons, section 2.3."),
        field(&S::forgetCells, "forgetCells", "cells", 0.0, 1000.0,
              "Half width of the box in which the detector is reset around a new track, per axis; none: as "
              "inhibitCells.")
            .labelled("Forget half width")
            .advanced()
            .advised("Raise it if a signal is detected again beside its own track. Evidence of weaker signals in the "
                     "box is lost. Source: Parsons, section 2.3."),
        field(&S::resets, "resets", "Whether the detector is reset in the box around a new track.")
            .labelled("Forget under tracks")
            .advanced()
            .advised("Switch it off for comparison only: the scores of a strong signal then spread at the largest "
                     "slope and hide weaker ones."),
        field(&S::inhibits, "inhibits", "Whether the detector is inhibited in the box around a track.")
            .labelled("Inhibit around tracks")
            .advanced()
            .advised("Switch it off for comparison only: a strong signal is then detected again and again."),
    };
    return table;
}

const std::vector<Field<SubtractSettings>> &SubtractSettings::fields()
{
    using S = SubtractSettings;
    static const std::vector<Field<S>> table{
        field(&S::lines, "lines",
              "Whether strong lines are subtracted with their phase and the rest is searched again, for weak lines "
              "beside them.")
            .labelled("Subtract strong lines")
            .advised("Use it for weak lines that strong ones hide beside them. The recording is analysed twice, which "
                     "takes about twice the time."),
        field(&S::leastDb, "leastDb", "dB", 3.0, 200.0,
              "Mean power over the noise, in one frame, from which on a line is subtracted.")
            .labelled("Least level")
            .advised("Lower it to subtract weaker lines as well. Each line takes time, and the phase of a weak line is "
                     "known less accurately."),
    };
    return table;
}

} // namespace faintline
