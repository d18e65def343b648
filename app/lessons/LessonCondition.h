#pragma once

#include <limits>
#include <string>
#include <vector>

namespace faintline {

/// A condition on the window: measures (lessonMeasures.h) within bounds, settings with a value. All parts must hold.
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
