#pragma once

#include "analysis/Analysis.h"

#include <limits>
#include <vector>

namespace faintline {

/// One detected signal, in physical units; a view of a track.
struct Event {
    int id = 0;
    double onsetSeconds = 0.0;
    double detectSeconds = 0.0;
    double endSeconds = 0.0;
    std::vector<double> position; ///< at detection, one per axis (Hz; or m, degrees)
    double driftPerSecond = 0.0;  ///< straight-line slope of the track along the last axis
    /// In the detector's unit: the path's largest where it is its score, else that of the detection.
    double statistic = 0.0;
    bool isConfirmed = false;
    bool isOpen = false;
    bool isSubtracted = false;          ///< from the recording that the others were found in (subtractLines.h)
    std::vector<double> ratesPerSecond; ///< as driftPerSecond, along every axis
    std::size_t model = 0;              ///< of a bank, the one that found it
    double confirmSeconds = std::numeric_limits<double>::quiet_NaN(); ///< NaN: never confirmed

    // Of tracks that were looked at from both ends (secondLook.h); NaN of others:
    /// Mean power along the track over the noise's in one frame.
    double snrDb = std::numeric_limits<double>::quiet_NaN();
    /// Of the 5-95 % band of its position, mean, in units of the last axis.
    double bandWidth = std::numeric_limits<double>::quiet_NaN();
    /// That noise alone brings an event as significant as this in this recording: 1 -
    /// exp(-rate(statistic)·cells·frames).
    double noiseProbability = std::numeric_limits<double>::quiet_NaN();
    /// T_FT of the window that found it: the frames' own, or a longer one's (steadyLines.h).
    double windowSeconds = std::numeric_limits<double>::quiet_NaN();
};

/// A burst, a cloud or another signal that is no line, in physical units; a view of an area.
struct AreaEvent {
    double onsetSeconds = 0.0;
    double endSeconds = 0.0;
    double low = 0.0; ///< along the last axis
    double high = 0.0;
    double levelDb = 0.0; ///< at least, over the noise
};

/// The areas of an analysis that are raised by 1 dB or more, ordered by onset, then frequency.
std::vector<AreaEvent> areaEvents(const Analysis &analysis);

/// A track's statistic as its event has it.
double statisticOf(const Track &track, const AnalysisPlan &analysis);

/// The events of an analysis at its threshold, ordered by onset, then frequency.
std::vector<Event> events(const Analysis &analysis);
/// The same of other tracks on its frames, such as the conventional ones.
std::vector<Event> events(const AnalysisPlan &plan, const std::vector<Track> &tracks);
/// By onset, then frequency: the order of the above.
void sortEvents(std::vector<Event> &events);

/// The event of that number, or, of number 0, the one with the largest statistic. Throws Error where there is none.
Event chosenEvent(const Analysis &analysis, int number);

} // namespace faintline
