#pragma once

#include "analysis/analyse.h"

#include <span>
#include <vector>

namespace faintline {

/// A cell in a frame: a path is one of these for each frame it goes through, in ascending order.
struct PathCell {
    Index frame = 0;
    Index cell = 0;
    bool operator==(const PathCell &) const = default;
};

/// What the data say about a path somebody names: how much more likely they are with a signal along it than with noise.
struct PathEvidence {
    Index frames = 0;
    double logLikelihoodRatio = 0.0; ///< Σ λ(y), nat
    double meanPower = 0.0;          ///< mean y along it, 1 on noise
    /// Estimate of the SNR in one frame, a power ratio: mean y - 1; not above 0 where there is no more than noise.
    double snr() const { return meanPower - 1.0; }
    bool operator==(const PathEvidence &) const = default;
};

/// Σ λ(y) and mean y over the cells of a path, λ the analysis's own likelihood (of a bank, its first model's).
///
/// Along the detector's path this is the λ part of its statistic; ln P and ln K are what the detector adds. Oracle:
/// explain's steps. Frames or cells that do not exist throw Error. Cost: one transform a frame. Thread-safe.
PathEvidence evidenceAlong(const Analysis &analysis, std::span<const PathCell> path, const RunContext &context = {});

/// The frames and cells a polyline of (seconds, hz) goes through, vertices in ascending time; linear between them, ends
/// included. What lies outside of the picture is left out. Of frames on one axis.
struct PolylinePoint {
    double seconds = 0.0;
    double hz = 0.0;
    bool operator==(const PolylinePoint &) const = default;
};
std::vector<PathCell> cellsAlong(const Analysis &analysis, std::span<const PolylinePoint> line);

} // namespace faintline
