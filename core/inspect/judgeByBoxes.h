#pragma once

#include "inspect/Review.h"

#include <vector>

namespace faintline {

/// Applies the reviews of annotated boxes to the events within them.
struct JudgedByBoxes {
    std::vector<Review> reviews;    ///< the given ones and those added
    std::vector<Annotation> others; ///< boxes that match no event, or contain no judgement
    int judged = 0;                 ///< number of events
};

/// A box with a verdict or a note applies it to each event that matches it: they share at least half of the shorter
/// one's time, and at least half of the track's points in that time lie in the box, extended by two bins beyond its
/// edges. If several boxes match an event, the first counts. For lines, whose grid has one axis.
JudgedByBoxes judgeByBoxes(std::vector<Review> reviews, const Analysis &analysis, const std::vector<Event> &events,
                           const std::vector<Annotation> &boxes);

} // namespace faintline
