#pragma once

#include "base/Interval.h"

#include <string>
#include <vector>

namespace faintline {

/// One curve of a chart.
struct Curve {
    enum class Kind {
        Measured, ///< simulated here: points joined by a line, with their interval
        Theory,   ///< a line
        Paper     ///< from a publication: hollow points
    };
    struct Point {
        double x = 0.0;
        double y = 0.0;
        Interval interval;   ///< low = high = 0 without an interval
        std::string label{}; ///< displayed beside it; empty: none
    };

    std::string name;
    Kind kind = Kind::Measured;
    std::vector<Point> points;
};

/// A diagram as a value, drawn by the window or written to a file.
struct Chart {
    std::string title;
    std::string xLabel; ///< with its unit: "SNR (dB)"
    std::string yLabel;
    bool isLogarithmicX = false;
    bool isLogarithmicY = false;
    std::vector<Curve> curves;
};

} // namespace faintline
