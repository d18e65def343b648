#include "refine/TrackPiece.h"

#include "refine/bothWays.h"
#include "refine/constants.h"
#include "refine/explainPath.h"
#include "refine/levelBeside.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace faintline {

namespace {

    /// Least-squares slope of `count` points from `first` on, cells per frame.
    double slopeOf(const std::vector<TrackPoint> &points, std::size_t first, std::size_t count)
    {
        const double middle = 0.5 * double(count - 1);
        double cross = 0.0;
        double square = 0.0;
        for (std::size_t i = 0; i < count; ++i) {
            const double t = double(i) - middle;
            cross += t * double(points[first + i].cell);
            square += t * t;
        }
        return square > 0.0 ? cross / square : 0.0;
    }

    Index plainHalfWidth(double binsPerCell)
    {
        return std::max(bothWaysHalfWidth(binsPerCell), levelBesideHalfWidth(binsPerCell));
    }

    /// An empty strip around a piece of a path, extended by some frames at either end: along the track, or beyond
    /// its ends with its slope there.
    PathStrip stripRound(const TrackPiece &piece, Index frameCount, double binsPerCell)
    {
        PathStrip strip;
        const std::vector<TrackPoint> &points = piece.track->points;
        const auto goesOn = [&](const TrackPoint &end, double slope, Index frame) {
            strip.centres.push_back(end.cell + Index(std::lround(slope * double(frame - end.frame))));
        };
        const std::size_t count = std::min(points.size(), std::size_t(endSlopeFrames));
        const std::size_t from = piece.from - std::min(piece.from, std::size_t(pieceOverlapFrames));
        const std::size_t to = std::min(points.size(), piece.to + std::size_t(pieceOverlapFrames));
        strip.firstFrame = points[from].frame;
        if (piece.isFirst()) {
            strip.firstFrame = std::max<Index>(0, points.front().frame - TrackPiece::extraFrames);
            for (Index frame = strip.firstFrame; frame < points.front().frame; ++frame)
                goesOn(points.front(), slopeOf(points, 0, count), frame);
        }
        for (std::size_t i = from; i < to; ++i)
            strip.centres.push_back(points[i].cell);
        if (piece.isLast()) {
            const Index end = std::min(frameCount, points.back().frame + 1 + TrackPiece::extraFrames);
            for (Index frame = points.back().frame + 1; frame < end; ++frame)
                goesOn(points.back(), slopeOf(points, points.size() - count, count), frame);
        }
        const bool isStrong = piece.track->peakStatistic > strongNatsPerFrame * double(points.size());
        strip.halfWidth = isStrong ? widestHalfWidth(binsPerCell) : plainHalfWidth(binsPerCell);
        return strip;
    }

} // namespace

Index widestHalfWidth(double binsPerCell)
{
    return std::max(plainHalfWidth(binsPerCell), skirtBins);
}

void addPieces(std::vector<TrackPiece> &pieces, const Track &track, Index frameCount, double binsPerCell)
{
    const std::size_t length = track.points.size();
    const std::size_t count = (length + piecesFromFrames - 1) / piecesFromFrames;
    for (std::size_t i = 0; i < count; ++i) {
        TrackPiece piece{&track, i * length / count, (i + 1) * length / count, {}};
        piece.strip = stripRound(piece, frameCount, binsPerCell);
        pieces.push_back(std::move(piece));
    }
}

} // namespace faintline
