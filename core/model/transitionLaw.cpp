#include "model/transitionLaw.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline {

namespace {

    constexpr double lowestSnr = 1e-6;
    constexpr double highestSnr = 1e9;

    /// Simpson's rule over the amplitude a = √y from `first` to `last`; its density is 2a·e^(-a²)·p1/p0.
    double meanOverAmplitude(const Likelihood &likelihood, double snr, double first, double last)
    {
        constexpr int intervals = 600;
        const Likelihood actual(likelihood.kind(), std::max(snr, lowestSnr));
        const double step = (last - first) / intervals;
        double sum = 0.0;
        for (int i = 0; i <= intervals; ++i) {
            const double a = first + i * step;
            const double y = a * a;
            const double weight = i == 0 || i == intervals ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
            sum += weight * 2.0 * a * std::exp(actual.at(y) - y) * likelihood.at(y);
        }
        return sum * step / 3.0;
    }

    double meanRice(const Likelihood &likelihood, double snr)
    {
        constexpr double amplitudeReach = 7.0; // in amplitude, whose standard deviation is at most √½
        const double centre = std::sqrt(snr);
        return meanOverAmplitude(likelihood, snr, std::max(0.0, centre - amplitudeReach), centre + amplitudeReach);
    }

    double meanSwerling4(const Likelihood &likelihood, double snr)
    {
        constexpr double amplitudeReach = 7.0; // y falls as e^(-y/(1 + snr/2))
        return meanOverAmplitude(likelihood, snr, 0.0, amplitudeReach * std::sqrt(1.0 + 0.5 * snr));
    }

} // namespace

std::vector<double> withProbability(std::vector<double> law, std::size_t change, double probability)
{
    if (law.size() <= change)
        law.resize(change + 1, 0.0);
    const double times = change == 0 ? 1.0 : 2.0; // both signs of a change
    const double wanted = std::isnan(probability) ? law[change] : std::clamp(probability, 0.0, 1.0 / times);
    const double others = 1.0 - times * law[change];
    const double left = 1.0 - times * wanted;
    if (others > 1e-12) {
        for (std::size_t i = 0; i < law.size(); ++i)
            law[i] = i == change ? 0.0 : std::clamp(law[i] * left / others, 0.0, 1.0); // rounding must stay within 0 …
                                                                                       // 1
    } else {
        const std::size_t heir = change == 0 ? 1 : 0;
        law.assign(std::max(law.size(), heir + 1), 0.0);
        law[heir] = heir == 0 ? left : 0.5 * left;
    }
    law[change] = wanted;
    while (law.size() > 1 && !(law.back() > 0.0))
        law.pop_back();
    return law;
}

LawDamping damping(const std::vector<double> &law)
{
    LawDamping result;
    double most = 0.0;
    double least = 1.0;
    for (std::size_t i = 0; i < law.size(); ++i) {
        if (!(law[i] > 0.0))
            continue;
        most = std::max(most, law[i]);
        least = std::min(least, law[i]);
        result.mean -= (i == 0 ? 1.0 : 2.0) * law[i] * std::log(law[i]);
    }
    result.likeliest = -std::log(most);
    result.unlikeliest = -std::log(least);
    return result;
}

double meanEvidence(const Likelihood &likelihood, double snr)
{
    if (likelihood.kind() == LikelihoodKind::Rice)
        return meanRice(likelihood, snr);
    if (likelihood.kind() == LikelihoodKind::Swerling4)
        return meanSwerling4(likelihood, snr);
    return likelihood.at(1.0 + snr); // linear in y, whose mean is 1 + SNR
}

double lowestIntegratedSnr(const Likelihood &likelihood, double lossNats)
{
    if (meanEvidence(likelihood, lowestSnr) >= lossNats)
        return 0.0;
    double low = std::log(lowestSnr);
    double high = std::log(highestSnr);
    if (!(meanEvidence(likelihood, highestSnr) > lossNats))
        return std::numeric_limits<double>::infinity();
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (low + high);
        (meanEvidence(likelihood, std::exp(middle)) < lossNats ? low : high) = middle;
    }
    return std::exp(0.5 * (low + high));
}

} // namespace faintline
