#include "evaluate/theory/walkOnLine.h"

#include <cmath>
#include <cstdlib>

namespace faintline {

SequentialModel walkOnLine(Index cells, double deviation, double snr)
{
    KinematicAxis axis;
    axis.name = "cell";
    axis.cells = cells;
    const Likelihood likelihood(LikelihoodKind::Exponential, snr);
    if (std::isinf(deviation))
        return makeSequentialModel({axis}, {true}, likelihood);
    axis.step = gaussianStep(deviation, cells);
    axis.renormalised = true;
    std::vector<double> initial(std::size_t(cells), 0.0);
    const Index centre = cells / 2;
    for (Index cell = 0; cell < cells; ++cell)
        if (const Index d = std::abs(cell - centre); d < std::ssize(axis.step))
            initial[std::size_t(cell)] = axis.step[std::size_t(d)] * std::exp(axis.lnDeparture(centre));
    return makeSequentialModel({axis}, {false}, likelihood, std::move(initial));
}

double relativeEntropyRate(Index cells, double deviation)
{
    if (cells < 2)
        return 0.0;
    if (std::isinf(deviation))
        return 1.0;
    KinematicAxis axis;
    axis.cells = cells;
    axis.step = gaussianStep(deviation, cells);
    axis.renormalised = true;
    double rate = 0.0;
    double mass = 0.0;
    for (Index from = 0; from < cells; ++from) {
        const double rowSum = std::exp(-axis.lnDeparture(from));
        double entropy = 0.0;
        for (Index to = 0; to < cells; ++to)
            if (const Index d = std::abs(to - from); d < std::ssize(axis.step)) {
                const double p = axis.step[std::size_t(d)] / rowSum;
                entropy -= p > 0.0 ? p * std::log(p) : 0.0;
            }
        rate += rowSum * entropy;
        mass += rowSum;
    }
    return rate / mass / std::log(double(cells));
}

} // namespace faintline
