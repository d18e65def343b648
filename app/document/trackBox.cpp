#include "app/document/trackBox.h"

#include "plan/Analysis.h"

#include <algorithm>

namespace faintline {

Viewport::Box trackBox(const Track &track, const Analysis &analysis)
{
    const Axis &time = analysis.time();
    const Axis &last = analysis.grid().axes.back();
    double low = 1e300;
    double high = -1e300;
    for (const TrackPoint &point : track.points) {
        const double value = last.value(double(point.cell % last.count));
        low = std::min(low, value);
        high = std::max(high, value);
    }
    return {{time.value(double(track.onsetFrame)), time.value(double(track.endFrame))}, {low, high}};
}

} // namespace faintline
