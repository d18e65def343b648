#include "track/trimOnset.h"

namespace faintline {

void trimOnset(std::vector<TrackPoint> &points)
{
    const double tilt = 0.5 * points.back().statistic / double(points.size());
    std::size_t onset = 0;
    double least = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double before = i == 0 ? 0.0 : points[i - 1].statistic;
        const double tilted = before - tilt * double(i);
        if (tilted < least) {
            least = tilted;
            onset = i;
        }
    }
    points.erase(points.begin(), points.begin() + std::ptrdiff_t(onset));
}

} // namespace faintline
