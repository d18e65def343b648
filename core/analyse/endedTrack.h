#pragma once

#include "analyse/events.h"

#include <optional>
#include <vector>

namespace faintline {

// The question asked of a single track when it has ended, in a run that goes on: as of a track over a causal background
// in a file (secondLook.h).

/// Whether tracks are asked under these settings.
bool asksEndedTracks(const AnalysisPlan &plan);

/// Number of frames before and after a track that are read with it.
Index framesBesideTrack();
/// Half width in cells of the widest strip that is read around a track.
Index widestStripHalfWidth(const AnalysisPlan &plan);

/// The middle of that strip in a frame.
struct StripPlace {
    Index frame;
    Index cell;
};
/// Of a track's whole strip, in `frameCount` frames.
std::vector<StripPlace> stripPlaces(const Track &track, Index frameCount, const AnalysisPlan &plan);

/// What remains of a track as an event; nothing if its surroundings explain it. `analysis`: plan, frames so far and ln K.
std::optional<Event> eventOfEnded(const Analysis &analysis, const Track &track);

} // namespace faintline
