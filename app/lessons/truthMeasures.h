#pragma once

#include <cstddef>
#include <optional>

namespace faintline {

class Document;

// How well the shown tracks match the truth of a simulated recording. A document with an analysis is required; "line"
// stands for the truth's lines, or for its targets if the frames are pings. A track's point is near a line if it is at
// most 3 cells from the line's cell of the same frame along each axis, and a track follows the line to which more than
// half of its points are near.

/// How one line, counted from 0, is followed by shown tracks.
struct Following {
    double share = 0.0;            ///< of the line's frames, those in which a track has a point near it
    int tracks = 0;                ///< that follow it
    double peak = 0.0;             ///< largest statistic of them
    std::optional<double> seconds; ///< from the line's beginning to the first detection of them
};

/// A line that the truth does not have is followed by no track.
Following following(const Document &document, std::size_t line);

/// Lines or targets that at least one shown track follows.
double linesFound(const Document &document);

/// Shown tracks that have less than a quarter of their points along any line: the rest of a line that was found
/// late or followed too long is no false alarm.
double falseEvents(const Document &document);

} // namespace faintline
