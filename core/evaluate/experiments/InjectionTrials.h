#pragma once

#include "base/Axis.h"
#include "evaluate/experiments/Experiment.h"
#include "evaluate/experiments/Trials.h"
#include "plan/Calibration.h"

#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace faintline {

/// The trials of lines injected into a recording: run = trial, noise = [detector][0] without the line, signal =
/// [detector][SNR][0] with it. The thresholds are one per detector; 0 for the margin of `detect` as a whole.
class InjectionTrials : public Trials
{
public:
    /// Estimates the recording's noise, calibrates each detector, finds existing signals and measures thresholds.
    /// Throws Error, Cancelled.
    InjectionTrials(const Experiment &experiment, RecordingPointer recording, const RunContext &context = {});
    ~InjectionTrials();

    MadeTrial remake(int trial, double snrDb) const;

    /// With these, a detector that is `detect` as a whole analyses a recording with or without that line.
    AnalysisSettings wholeSettings(std::size_t detector, const TruthLine &line) const;

private:
    RunOutcome outcomeOf(int trial, const RunContext &quiet) const override;
    struct Shared;
    class LineReading;
    Experiment m_experiment;
    std::unique_ptr<const Shared> m_shared;
};

/// Cells of a recording that hold signals: ranges of bins, frame by frame.
class SignalMask
{
public:
    SignalMask(Index frames, Index bins);

    /// Adds bins low … high of a frame, clipped at the band's edges; frames outside the recording are ignored.
    void add(Index frame, Index low, Index high);

    /// Whether any of the bins low … high holds a signal in that frame.
    bool touches(Index frame, Index low, Index high) const;

    /// Sets y = 0 where there is a signal, in a row that begins with `firstBin`.
    void blank(Index frame, Index firstBin, std::span<float> y) const;

    /// Fraction of all frames × bins without signals.
    double freeShare() const;

private:
    Index m_bins;
    std::vector<std::vector<std::pair<Index, Index>>> m_stretches; ///< for each frame, ascending, disjoint
};

/// A threshold for a number of false alarms, from counts rather than a model.
///
/// `maxima` holds the largest statistic of each block of a recording without signals, for any detector in its own unit;
/// of N blocks, m exceed a threshold with
///
///   false alarms = -N ln(1 - m/N)
///
/// The threshold lies half way between the two maxima that this separates. If fewer than ten false alarms are
/// specified, it is determined for ten and shifted by the difference of the calibration's thresholds for the two rates.
/// Blocks that decide nothing (-∞) exceed no threshold; if too few others remain, the calibration's own threshold is
/// used. `eventsPerCellFrame`: the same rate in the calibration's unit.
double measuredThreshold(std::vector<float> maxima, double falseAlarms, const Calibration &calibration,
                         double eventsPerCellFrame);

} // namespace faintline
