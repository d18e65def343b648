#include "inspect/outputLayers.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    /// Fraction of a cell that lies inside a band.
    double shareInside(Index cell, const SmoothedPoint &point)
    {
        const double low = std::max(double(cell) - 0.5, double(point.low));
        const double high = std::min(double(cell) + 0.5, double(point.high));
        return cell == Index(std::lround(point.position)) ? 1.0 : std::max(0.0, high - low);
    }

    SmoothedPoint smoothedOf(const Track &track, std::size_t i)
    {
        const auto cell = double(track.points[i].cell);
        return track.smoothed.empty() ? SmoothedPoint{cell, float(cell), float(cell), 1.0f, 0.0f} : track.smoothed[i];
    }

    void raise(LayerPicture &picture, Index frame, Index cell, double value)
    {
        if (const Index pixel = picture.pixelAt(frame, cell); pixel >= 0) {
            float &shown = picture.presence[std::size_t(pixel)];
            shown = std::max(shown, float(value));
        }
    }

} // namespace

LayerPicture presencePicture(const Analysis &analysis, const LayerWindow &window)
{
    const Index cells = analysis.grid().size();
    LayerPicture picture = pixelsOf(window, analysis.time().count, cells);
    picture.presence.assign(std::size_t(picture.rows * picture.columns), 0.0f);
    for (const Track &track : analysis.tracks)
        for (std::size_t i = 0; i < track.points.size(); ++i) {
            const SmoothedPoint point = smoothedOf(track, i);
            const auto at = [&](double position) { return std::clamp<Index>(std::lround(position), 0, cells - 1); };
            const Index first = std::min(at(double(point.low)), at(point.position));
            const Index last = std::max(at(double(point.high)), at(point.position));
            for (Index cell = first; cell <= last; ++cell)
                raise(picture, track.points[i].frame, cell, double(point.presence) * shareInside(cell, point));
        }
    return picture;
}

} // namespace faintline
