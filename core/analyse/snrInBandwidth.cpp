#include "analyse/snrInBandwidth.h"

#include "base/logmath.h"
#include "frames/Window.h"

#include <numeric>

namespace faintline {

double noiseBandwidthCells(WindowShape shape)
{
    constexpr int length = 4096; // of unit energy; long enough for any shape's sum to have converged
    const std::vector<float> window = sampleWindow(shape, length);
    const double sum = std::accumulate(window.begin(), window.end(), 0.0);
    return length / (sum * sum);
}

double snrChangeDb(double hz, const FrameGeometry &geometry)
{
    return dbFromRatio(noiseBandwidthCells(geometry.window) / (geometry.windowSeconds * hz));
}

} // namespace faintline
