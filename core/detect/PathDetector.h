#pragma once

#include "detect/Detector.h"

#include <cstddef>
#include <span>

namespace faintline {

/// A detector that scores the states of a model by the paths into them: the best one, which can be traced (tracePath)
/// and followed on, or the sum over all of them. Or several models in parallel, each with states of its own.
class PathDetector : public Detector
{
public:
    /// Models in parallel; one unless said otherwise.
    virtual std::size_t modelCount() const { return 1; }

    /// The scores of all states of a model after the last frame, in nats (StateSpace order).
    virtual std::span<const float> scores(std::size_t model = 0) const = 0;

    /// What is to be added to a model's score to get its statistic, nat.
    virtual double offset(std::size_t model = 0) const = 0;

    /// What regulated a model's scores in the last frame.
    struct Regulation {
        double lnK = 0.0;               ///< what the law gave for the last frame
        double continuedFraction = 0.0; ///< of the states, those whose path went on rather than being reset
        /// What was added on the way into the last frame (under Mean, the ln K of the frame before).
        double stepLnK = 0.0;
    };
    virtual Regulation regulation(std::size_t model = 0) const = 0;

    /// The model whose statistic a cell shows after the last frame.
    virtual std::size_t winnerAt(Index /*cell*/) const { return 0; }
};

} // namespace faintline
