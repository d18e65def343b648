#include "plan/Analysis.h"

#include <cmath>
#include <numeric>

namespace faintline {

NoiseBand noiseBand(std::span<const double> lnK)
{
    const auto n = double(lnK.size());
    NoiseBand band;
    band.mean = std::accumulate(lnK.begin(), lnK.end(), 0.0) / n;
    double squares = 0.0;
    for (double value : lnK)
        squares += (value - band.mean) * (value - band.mean);
    band.deviation = std::sqrt(squares / (n - 1.0));
    return band;
}

} // namespace faintline
