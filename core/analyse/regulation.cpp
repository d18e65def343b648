#include "analyse/regulation.h"

#include "analyse/constants.h"
#include "base/Random.h"
#include "calibrate/calibrate.h"

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

NoiseBand regulationBand(const MarkovModel &model, const ResetRule &rule, const RunContext &context)
{
    if (rule.law != ResetLaw::Mean && rule.law != ResetLaw::Half)
        return {};
    const MarkovModel piece = calibrationSubgrid(model);
    Smd detector(piece, rule);
    std::vector<float> y(std::size_t(piece.space.cellCount()));
    std::vector<float> statistic(y.size());
    std::vector<double> lnK;
    Random random(2000, 0);
    for (int frame = 0; frame < regulationNoiseFrames; ++frame) {
        context.checkpoint(double(frame) / regulationNoiseFrames, "regulating K on noise");
        for (float &value : y)
            value = float(random.exponential());
        detector.update(y, statistic);
        if (frame >= regulationSettlingFrames)
            lnK.push_back(detector.regulation().lnK);
    }
    NoiseBand band = noiseBand(lnK);
    band.deviation *= std::sqrt(double(piece.space.cellCount()) / double(model.space.cellCount()));
    return band;
}

std::vector<Index> draggedFrames(const Analysis &analysis)
{
    std::vector<Index> frames;
    if (analysis.lnKBand.deviation > 0.0)
        for (std::size_t frame = 0; frame < analysis.lnK.size(); ++frame)
            if (double(analysis.lnK[frame]) < analysis.lnKBand.low())
                frames.push_back(Index(frame));
    return frames;
}

} // namespace faintline
