#pragma once

#include "plan/Analysis.h"
#include "refine/signalKind.h"

#include <limits>
#include <string>
#include <vector>

namespace faintline {

/// One detected signal in physical units, derived from a track.
struct Event {
    int id = 0;
    double onsetSeconds = 0.0;
    double detectSeconds = 0.0;
    double endSeconds = 0.0;
    /// One per axis (Hz; or m, degrees). Of a line: the straight line fitted to its track, in the middle between onset
    /// and end; on several axes: at detection.
    std::vector<double> position;
    std::vector<double> detectedPosition; ///< at detection
    double driftPerSecond = 0.0;          ///< slope of the straight line fitted to the track along the last axis
    /// In the detector's unit: the path's largest if it is a path score, else that of the detection.
    double statistic = 0.0;
    bool isConfirmed = false;
    bool isOpen = false;
    bool isSubtracted = false;          ///< from the recording in which the others were found (subtractLines.h)
    std::vector<double> ratesPerSecond; ///< as driftPerSecond, along each axis
    std::size_t model = 0;              ///< index of the bank's model that found it
    struct ChangeOfModel {
        double seconds = 0.0;
        std::size_t model = 0;
    };
    std::vector<ChangeOfModel> modelChanges; ///< to other models of the bank, from these times on
    double confirmSeconds = std::numeric_limits<double>::quiet_NaN(); ///< NaN: never confirmed

    // For tracks with a two-sided second pass (secondLook.h); NaN for others:
    /// Mean power along the track over the noise's, per frame.
    double snrDb = std::numeric_limits<double>::quiet_NaN();
    /// Mean width of the 5-95 % band of its position, in units of the last axis.
    double bandWidth = std::numeric_limits<double>::quiet_NaN();
    /// Probability that noise alone produces an event as significant as this one in this recording: 1 -
    /// exp(-rate(statistic)·cells·frames).
    double noiseProbability = std::numeric_limits<double>::quiet_NaN();
    /// T_FT of the window that found it: the frames' own, or another one (otherWindows.h).
    double windowSeconds = std::numeric_limits<double>::quiet_NaN();
    SignalKind kind = SignalKind::Unknown;
    /// Number of the strongest event among the overtones of one source (calls.h), if it is one of them; else 0.
    int call = 0;
};

/// A burst, a cloud or another signal that is not a line, in physical units; derived from an area.
struct AreaEvent {
    double onsetSeconds = 0.0;
    double endSeconds = 0.0;
    double low = 0.0; ///< along the last axis
    double high = 0.0;
    double levelDb = 0.0; ///< minimum, over the noise
};

/// The areas of an analysis with a level of at least 1 dB, ordered by onset, then frequency.
std::vector<AreaEvent> areaEvents(const Analysis &analysis);

/// "2 paths above the threshold not reported: …", the paths that this recording's own noise explains; empty if there are
/// none.
std::string unreportedWords(const Analysis &analysis);

/// Event::noiseProbability of a statistic; of a live run, in its frames so far.
double noiseProbability(double statistic, const AnalysisPlan &analysis);

/// A track's statistic as its event gives it.
double statisticOf(const Track &track, const AnalysisPlan &analysis);

/// The change of an event's SNR, which is that in a bin of these frames whatever window found it, to that against the
/// noise in `hz`, dB: B = noiseBandwidthCells/T_FT is a bin's noise bandwidth,
///
///   SNR(hz) = SNR(bin)·B/hz
///
/// WSPR and the modes of WSJT-X refer to 2500 Hz.
double snrChangeDb(double hz, const FrameGeometry &geometry);

/// The events of an analysis at its threshold, ordered by onset, then frequency.
std::vector<Event> events(const Analysis &analysis);
/// The same for other tracks on its frames, such as the conventional ones.
std::vector<Event> events(const AnalysisPlan &plan, const std::vector<Track> &tracks);
/// Sorts by onset, then frequency.
void sortEvents(std::vector<Event> &events);

/// The event of that number, or for number 0 the one with the largest statistic. Throws Error if there is none.
Event chosenEvent(const Analysis &analysis, int number);

} // namespace faintline
