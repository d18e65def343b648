#include "evaluate/theory/theory.h"

#include <algorithm>
#include <array>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/gamma.hpp>

#include <cmath>
#include <cstdint>
#include <functional>

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

namespace {

    /// P( Γ(shape) > value ).
    double upperTail(int shape, double value)
    {
        return shape <= 0 ? 0.0 : math::gamma_q(double(shape), value);
    }

    /// A(n) = ∫₀ⱽ f_n(x) e^{-(V-x)/a} dx; for n = 0, where Γ(0) is 0, e^{-V/a}.
    ///
    /// Up to z = (1 - 1/a)V = n + 1 by the series f_{n+1}(V)·Σ zʲ/((n+1)…(n+j)), beyond by
    /// P(n, z)·e^{-V/a}·(1 - 1/a)^-n; there P(n, z) is at least a third, so that neither factor underflows alone.
    double decayedGamma(int n, double v, double a)
    {
        const double share = 1.0 - 1.0 / a;
        const double z = share * v;
        if (n == 0)
            return std::exp(-v / a);
        if (z > n + 1.0)
            return std::exp(-v / a - n * std::log(share)) * math::gamma_p(double(n), z);
        double sum = 0.0;
        double term = 1.0;
        for (int j = 1; term > 1e-17 * sum; ++j) {
            sum += term;
            term *= z / (n + j);
        }
        return math::gamma_p_derivative(n + 1.0, v) * sum;
    }

    double pdOfSwerling1(double v, int looks, double snr)
    {
        return upperTail(looks - 1, v) + decayedGamma(looks - 1, v, 1.0 + looks * snr);
    }

    double pdOfSwerling3(double v, int looks, double snr)
    {
        const double a = 1.0 + 0.5 * looks * snr;
        if (looks == 1)
            return std::exp(-v / a) * (1.0 + (a - 1.0) * v / (a * a));
        const int n = looks - 2;
        return upperTail(n, v) + (1.0 + v / a) * decayedGamma(n, v, a)
               - (n == 0 ? 0.0 : n / a * decayedGamma(n + 1, v, a));
    }

    double pdOfSwerling4(double v, int looks, double snr)
    {
        const double a = 1.0 + 0.5 * snr;
        const math::binomial law(looks, 1.0 - 1.0 / a);
        double sum = 0.0;
        for (int more = 0; more <= looks; ++more)
            sum += math::pdf(law, more) * upperTail(looks + more, v / a);
        return sum;
    }

    constexpr double smallestDrawnProbability = 1e-15;
    constexpr double step = 0.25;
    constexpr double highestLevel = 1000.0;

    using Law = std::function<double(double level)>; ///< negative where it says nothing

    Law lawOf(const AnalysisSettings &settings, const Calibration &calibration)
    {
        const bool isIndependentInTime = settings.spectrogram.stepsPerWindow == 1;
        const ModelSettings &model = settings.model;
        if (std::holds_alternative<EnergySettings>(settings.detector))
            return [](double level) { return std::exp(-level); };
        if (const auto *integrator = std::get_if<IntegratorSettings>(&settings.detector);
            integrator && isIndependentInTime && integrator->shape == IntegratorSettings::Shape::Boxcar) {
            const int looks = int(std::lround(integrator->durationWindows));
            if (looks >= 1 && double(looks) == integrator->durationWindows)
                return [looks](double level) { return level > 0.0 ? pfaOfMeanPower(level, looks) : 1.0; };
        }
        const auto *smd = std::get_if<SmdSettings>(&settings.detector);
        const bool isOneToOne = model.motion == Motion::Slopes && model.lowestSlope == model.highestSlope;
        if (smd && isIndependentInTime && isOneToOne && model.likelihood == LikelihoodKind::Linear
            && calibration.lnK < -1.0
            && (smd->reset == SmdSettings::Reset::Fixed || smd->reset == SmdSettings::Reset::Calibrated))
            return [lnK = calibration.lnK](double level) {
                return level + lnK >= 0.0 ? lindleyExceedance(level + lnK, lnK) : -1.0;
            };
        return {};
    }

    constexpr Index mostCells = 2'000'000;
    constexpr std::int64_t pointMinimumCells = 10; ///< cells above a level that is worth a point

} // namespace

double pdOfMeanPower(double threshold, int looks, double snr, Fluctuation fluctuation)
{
    if (threshold <= 0.0)
        return 1.0;
    if (snr <= 0.0)
        return pfaOfMeanPower(threshold, looks);
    const double v = looks * threshold;
    switch (fluctuation) {
    case Fluctuation::None:
        break;
    case Fluctuation::Swerling1:
        return pdOfSwerling1(v, looks, snr);
    case Fluctuation::Swerling2:
        return upperTail(looks, v / (1.0 + snr));
    case Fluctuation::Swerling3:
        return pdOfSwerling3(v, looks, snr);
    case Fluctuation::Swerling4:
        return pdOfSwerling4(v, looks, snr);
    }
    return pdOfMeanPower(threshold, looks, snr);
}

double pdOfPofN(int p, int n, double threshold, double snr, Fluctuation fluctuation)
{
    if (fluctuation == Fluctuation::None || changesFromFrameToFrame(fluctuation))
        return pdOfPofN(p, n, pdOfMeanPower(threshold, 1, snr, fluctuation));
    // Over the amplitude √g, whose density 2√g·f(g) is below 1e-20 from 7 on.
    const double shape = fluctuation == Fluctuation::Swerling1 ? 1.0 : 2.0;
    const auto weighted = [&](double amplitude) {
        const double g = amplitude * amplitude;
        const double density = 2.0 * amplitude * shape * math::gamma_p_derivative(shape, shape * g);
        return density * pdOfPofN(p, n, pdOfMeanPower(threshold, 1, g * snr));
    };
    return math::quadrature::gauss_kronrod<double, 31>::integrate(weighted, 0.0, 7.0, 12, 1e-9);
}

std::vector<ExceedancePoint> closedFormExceedance(const AnalysisSettings &settings, const Calibration &calibration)
{
    std::vector<ExceedancePoint> points;
    const Law law = lawOf(settings, calibration);
    if (!law)
        return points;
    for (double level = 0.0; level < highestLevel; level += step) {
        const double probability = law(level);
        if (probability < 0.0)
            continue; // below where the law holds
        if (!(probability >= smallestDrawnProbability))
            break;
        points.push_back({level, probability});
    }
    return points;
}

std::vector<ExceedancePoint> boxExceedance(const PeakPyramid &statistic, Index beginFrame, Index endFrame,
                                           Index beginCell, Index endCell)
{
    beginFrame = std::clamp<Index>(beginFrame, 0, statistic.frameCount());
    endFrame = std::clamp<Index>(endFrame, beginFrame, statistic.frameCount());
    beginCell = std::clamp<Index>(beginCell, 0, statistic.cells());
    endCell = std::clamp<Index>(endCell, beginCell, statistic.cells());
    const Index width = endCell - beginCell;
    std::vector<ExceedancePoint> points;
    if (statistic.framesPerRow(0) != 1 || width == 0 || beginFrame == endFrame)
        return points;
    const Index stride = std::max<Index>(1, (endFrame - beginFrame) * width / mostCells);
    std::array<std::int64_t, 256> counts{};
    std::int64_t total = 0;
    for (Index frame = beginFrame; frame < endFrame; frame += stride) {
        const auto row = statistic.row(0, frame);
        for (const std::uint8_t byte : row.subspan(std::size_t(beginCell), std::size_t(width)))
            ++counts[byte];
        total += width;
    }
    // Half the way to the next byte's value lies what rounding takes for it.
    std::int64_t above = total;
    for (int byte = 0; byte < 255; ++byte) {
        above -= counts[std::size_t(byte)];
        if (above < pointMinimumCells)
            break;
        points.push_back(
            {0.5 * (statistic.scale().value(byte) + statistic.scale().value(byte + 1)), double(above) / double(total)});
    }
    return points;
}

} // namespace faintline
