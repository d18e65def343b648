#pragma once

#include <limits>
#include <string>
#include <vector>

namespace faintline {

/// What must hold of the window: measures (lessonMeasures.h) within bounds, settings with a value. All of them must.
struct LessonCondition {
    struct Part {
        std::string measure;
        double low = -std::numeric_limits<double>::infinity();
        double high = std::numeric_limits<double>::infinity();
        std::string text; ///< not empty: the measure is this word
    };
    std::vector<Part> parts;

    bool isEmpty() const { return parts.empty(); }
};

} // namespace faintline
