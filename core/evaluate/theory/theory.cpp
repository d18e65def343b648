#include "evaluate/theory/theory.h"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/distributions/non_central_f.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <boost/math/tools/roots.hpp>

#include <cmath>

namespace faintline {

namespace math = boost::math;

double pfaOfMeanPower(double threshold, int looks)
{
    return threshold <= 0.0 ? 1.0 : math::gamma_q(double(looks), looks * threshold);
}

double thresholdOfMeanPower(double pfa, int looks)
{
    return math::gamma_q_inv(double(looks), pfa) / looks;
}

double pdOfMeanPower(double threshold, int looks, double snr)
{
    if (snr <= 0.0)
        return pfaOfMeanPower(threshold, looks);
    const math::non_central_chi_squared law(2.0 * looks, 2.0 * looks * snr);
    return threshold <= 0.0 ? 1.0 : math::cdf(math::complement(law, 2.0 * looks * threshold));
}

double pfaOfMeanPowerEstimated(double threshold, int looks, int references)
{
    return math::cdf(math::complement(math::fisher_f(2.0 * looks, 2.0 * references), threshold));
}

double pdOfMeanPowerEstimated(double threshold, int looks, int references, double snr)
{
    if (snr <= 0.0)
        return pfaOfMeanPowerEstimated(threshold, looks, references);
    return math::cdf(
        math::complement(math::non_central_f(2.0 * looks, 2.0 * references, 2.0 * looks * snr), threshold));
}

double snrOfMeanPower(double pd, double pfa, int looks)
{
    const double threshold = thresholdOfMeanPower(pfa, looks);
    const auto gap = [&](double lnSnr) { return pdOfMeanPower(threshold, looks, std::exp(lnSnr)) - pd; };
    std::uintmax_t steps = 200;
    const auto [low, high] =
        math::tools::toms748_solve(gap, -12.0, 12.0, math::tools::eps_tolerance<double>(40), steps);
    return std::exp(0.5 * (low + high));
}

double pdOfPofN(int p, int n, double event)
{
    return p <= 0 ? 1.0 : math::cdf(math::complement(math::binomial(n, event), p - 1));
}

double lindleySigma(double lnK)
{
    // The fixed-point iteration from 0 rises to the smaller root.
    double sigma = 0.0;
    for (int i = 0; i < 100000; ++i) {
        const double next = std::exp(lnK * (1.0 - sigma));
        if (next - sigma < 1e-16)
            break;
        sigma = next;
    }
    return sigma;
}

double lindleyExceedance(double threshold, double lnK)
{
    const double sigma = lindleySigma(lnK);
    return sigma * std::exp(-(1.0 - sigma) * threshold);
}

} // namespace faintline
