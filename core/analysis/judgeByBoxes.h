#pragma once

#include "analysis/Review.h"

#include <vector>

namespace faintline {

/// Applies the reviews of annotated boxes to the events within them.
struct JudgedByBoxes {
    std::vector<Review> reviews;    ///< the given ones and what was added
    std::vector<Annotation> others; ///< boxes that judge no event here, or judge nothing
    int judged = 0;                 ///< events
};

/// A box that is accepted, rejected or has a note says so of every event it is of: they have at least half of the
/// shorter one's time in common, and at least half of the track's points in that time lie in the box, two bins beyond
/// its edges included. Of several boxes on one event the first counts. For lines, whose grid has one axis.
JudgedByBoxes judgeByBoxes(std::vector<Review> reviews, const Analysis &analysis, const std::vector<Event> &events,
                           const std::vector<Annotation> &boxes);

} // namespace faintline
