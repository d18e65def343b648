#pragma once

#include "base/RunContext.h"
#include "plan/Analysis.h"

#include <span>
#include <vector>

namespace faintline {

/// A cell in a frame; a path has one for each of its frames, in ascending order.
struct PathCell {
    Index frame = 0;
    Index cell = 0;
    bool operator==(const PathCell &) const = default;
};

/// Evidence for a given path: how much likelier the data are with a signal along it than with noise.
struct PathEvidence {
    Index frames = 0;
    double logLikelihoodRatio = 0.0; ///< Σ λ(y), nat
    double meanPower = 0.0;          ///< mean y along it, 1 on noise
    /// Estimate of the SNR in one frame, a power ratio: mean y - 1; not positive if there is only noise.
    double snr() const { return meanPower - 1.0; }
    bool operator==(const PathEvidence &) const = default;
};

/// Σ λ(y) and mean y over the cells of a path, with the analysis's own likelihood λ (that of a bank's first model).
///
/// Along the detector's path this is the λ part of its statistic; the detector adds ln P and ln K. Oracle: explain's
/// steps. Throws Error for frames or cells that do not exist. Cost: one transform per frame. Thread-safe.
PathEvidence evidenceAlong(const Analysis &analysis, std::span<const PathCell> path, const RunContext &context = {});

/// The frames and cells of a polyline of (seconds, hz) with vertices in ascending time, linear between them, including
/// the ends. Parts outside the picture are omitted. For frames on one axis.
struct PolylinePoint {
    double seconds = 0.0;
    double hz = 0.0;
    bool operator==(const PolylinePoint &) const = default;
};
std::vector<PathCell> cellsAlong(const Analysis &analysis, std::span<const PolylinePoint> line);

} // namespace faintline
