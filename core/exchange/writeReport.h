#pragma once

#include "inspect/Review.h"
#include "inspect/explain.h"

#include <string>
#include <vector>

namespace faintline {

/// Content of a report besides the analysis.
struct ReportMaterial {
    struct Picture {
        std::string title;
        std::string png; ///< the file's bytes
        int width = 0, height = 0;
    };
    struct Ladder {
        int event = 0;
        Explanation explanation;
    };

    std::string title; ///< of the recording, scenario or session
    std::string version;
    std::vector<Event> events;
    Annotations annotations;
    std::vector<Picture> pictures;
    std::vector<Ladder> ladders;
    std::string provenance; ///< JSON
};

/// The events whose path breakdown a report shows: the accepted ones, or, if there are none, the ten strongest that
/// were not rejected.
std::vector<Event> eventsToExplain(const Analysis &analysis, const std::vector<Event> &events,
                                   const Annotations &annotations);

/// A report as one self-contained HTML page: facts, settings that differ from the defaults, pictures, threshold and
/// calibration with their interval, events and annotations, path breakdowns of the most interesting ones, provenance.
/// The same material gives the same bytes.
std::string reportHtml(const Analysis &analysis, const ReportMaterial &material);

} // namespace faintline
