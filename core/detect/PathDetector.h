#pragma once

#include "detect/Detector.h"

#include <cstddef>
#include <span>
#include <vector>

namespace faintline {

/// A detector that scores the states of one or more parallel models by the paths into them: by the best path, which can
/// be traced (tracePath) and followed, or by the sum over all paths.
class PathDetector : public Detector
{
public:
    /// Number of parallel models.
    virtual std::size_t modelCount() const { return 1; }

    /// Scores of all states of a model after the last frame, in nats (StateSpace order).
    virtual std::span<const float> scores(std::size_t model = 0) const = 0;

    /// Offset to add to a model's score to get its statistic, nat.
    virtual double offset(std::size_t model = 0) const = 0;

    /// Regulation of a model's scores in the last frame.
    struct Regulation {
        double lnK = 0.0;               ///< result of the law for the last frame
        double continuedFraction = 0.0; ///< fraction of states whose path continued instead of being reset
        /// Value added in the step into the last frame (under Mean, ln K of the previous frame).
        double stepLnK = 0.0;
    };
    virtual Regulation regulation(std::size_t model = 0) const = 0;

    /// How many of these frames, from the first on, updateTogether can take: 1 or more.
    virtual Index takenTogether(std::span<const float> /*y*/) const { return 1; }
    /// Takes that many frames at once: the same bytes as one at a time, but faster. `inhibited`: the cells of each frame
    /// that do not count in the regulation (as by `inhibit`) and are forgotten before the next frame. Returns the
    /// regulation of each frame.
    virtual std::vector<Regulation> updateTogether(std::span<const float> y, std::span<float> statistic,
                                                   std::span<const std::vector<Index>> inhibited)
    {
        inhibit(inhibited.front());
        update(y, statistic);
        return {regulation()};
    }
    /// Undoes updateTogether, if it took several frames.
    virtual void takeBack() {}

    /// Replaces the statistic that decides, in which what tracks follow is missing, by the one to be shown, for the
    /// frame as it was received. Call it once per frame.
    virtual void showStatistic(std::span<const float> /*y*/, std::span<float> /*statistic*/) {}

    /// The model that gave a cell's statistic after the last frame.
    virtual std::size_t winnerAt(Index /*cell*/) const { return 0; }
};

} // namespace faintline
