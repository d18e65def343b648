#pragma once

#include "base/json.h"

#include <vector>

namespace faintline {

/// Known parameters of a simulated or injected line: its times, strength and frequency f(t).
struct TruthLine {
    double startSeconds = 0.0; ///< of its first sample, to within a sample
    double endSeconds = 0.0;
    double snrDb = 0.0;
    double referenceSeconds = 0.0;   ///< the window that snrDb refers to
    double amplitude = 0.0;          ///< of the tone, before fading and fluctuation
    double stepSeconds = 0.0;        ///< spacing of frequencyHz
    std::vector<double> frequencyHz; ///< f(startSeconds + k·stepSeconds), linear between; the last at endSeconds

    /// f(t); outside the line, its end values. Precondition: frequencyHz is not empty.
    double frequencyAt(double seconds) const;

    bool operator==(const TruthLine &) const = default;
};

/// The lines of a recording, in the scene's order.
struct Truth {
    std::vector<TruthLine> lines;

    bool operator==(const Truth &) const = default;
};

/// {"lines": [{"startSeconds": …, …, "frequencyHz": […]}]}
Json toJson(const Truth &truth);

/// Throws Error naming the key.
Truth truthFromJson(const Json &json);

} // namespace faintline
