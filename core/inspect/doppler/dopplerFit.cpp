#include "inspect/doppler/dopplerFit.h"

#include "base/Error.h"
#include "inspect/doppler/dopplerLimits.h"
#include "inspect/doppler/dopplerSentences.h"
#include "inspect/doppler/dopplerStarts.h"

#include <Eigen/Dense>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr int parameterCount = 4;
    constexpr double outlierDeviations = 4.0;
    constexpr double normalFromMedian = 1.4826; ///< standard deviation over the median of the magnitude
    constexpr double leastScale = 1e-3;         ///< smaller errors, relative to those given, are rounding
    constexpr double coverage = 0.9;
    constexpr double doubtfulCoverage = 0.99; ///< of the joint region of all four if no bend is detected
    constexpr int mostRounds = 12;
    constexpr std::size_t startCount = 3;
    constexpr int mostWhitenings = 2;

    void check(const std::vector<DopplerPoint> &points, double propagation)
    {
        if (!std::isfinite(propagation) || propagation <= 0.0)
            throw Error("speed of propagation", "must be above 0 m/s");
        if (points.size() < leastDopplerPoints)
            throw Error("Doppler fit", "needs at least " + std::to_string(leastDopplerPoints)
                                           + " points; this track has " + std::to_string(points.size()));
        for (std::size_t i = 0; i < points.size(); ++i) {
            const DopplerPoint &point = points[i];
            const std::string where = "Doppler fit, point " + std::to_string(i + 1);
            if (!std::isfinite(point.seconds) || !std::isfinite(point.hz) || !std::isfinite(point.deviationHz))
                throw Error(where, "is not finite");
            if (point.hz <= 0.0)
                throw Error(where, "has a frequency of 0 Hz or below; the fit needs absolute frequencies, centre "
                                   "frequency included");
            if (point.deviationHz <= 0.0)
                throw Error(where, "needs a standard deviation above 0 Hz");
            if (i > 0 && point.seconds <= points[i - 1].seconds)
                throw Error(where, "must be later than the one before");
        }
    }

    std::vector<double> residualsOf(const std::vector<DopplerPoint> &points, double propagation,
                                    const DopplerPass &pass)
    {
        std::vector<double> residuals;
        for (const DopplerPoint &point : points)
            residuals.push_back(point.hz - receivedHz(pass, propagation, point.seconds));
        return residuals;
    }

    /// Points too far from a pass to be included.
    std::vector<char> outliersOf(const std::vector<DopplerPoint> &points, const std::vector<double> &residuals)
    {
        std::vector<double> magnitudes;
        for (std::size_t i = 0; i < points.size(); ++i)
            magnitudes.push_back(std::abs(residuals[i]) / points[i].deviationHz);
        std::vector<double> sorted = magnitudes;
        std::nth_element(sorted.begin(), sorted.begin() + std::ssize(sorted) / 2, sorted.end());
        const double most = outlierDeviations * std::max(leastScale, normalFromMedian * sorted[sorted.size() / 2]);
        std::vector<char> isOut;
        for (const double magnitude : magnitudes)
            isOut.push_back(magnitude > most ? 1 : 0);
        return isOut;
    }

    std::vector<DopplerPoint> without(const std::vector<DopplerPoint> &points, const std::vector<char> &isOut)
    {
        std::vector<DopplerPoint> kept;
        for (std::size_t i = 0; i < points.size(); ++i)
            if (!isOut[i])
                kept.push_back(points[i]);
        return kept;
    }

    /// State of the iteration: excluded points, error correlation, and the pass.
    struct Settling {
        std::vector<char> isOut;
        DopplerProblem problem;
        DopplerCoordinates x;
        std::vector<DopplerCoordinates> others{}; ///< minima from other starts
    };

    /// Alternates fitting and outlier removal until the excluded points no longer change.
    void leaveOutliersOut(Settling &settling, const std::vector<DopplerPoint> &points, double propagation)
    {
        for (int round = 0; round < mostRounds; ++round) {
            const auto residuals = residualsOf(points, propagation, settling.problem.passOf(settling.x));
            std::vector<char> isOut = outliersOf(points, residuals);
            if (isOut == settling.isOut)
                return;
            settling.isOut = std::move(isOut);
            settling.problem = settling.problem.with(without(points, settling.isOut));
            settling.x = settling.problem.minimum(settling.x);
        }
    }

    /// The best fit from several starts; outliers count by absolute, not squared distance.
    Settling settled(const std::vector<DopplerPoint> &points, double propagation)
    {
        const DopplerProblem whole(points, propagation);
        Settling best{{}, whole, {}};
        std::vector<DopplerCoordinates> all;
        double least = 0.0;
        for (const DopplerPass &start : dopplerStarts(points, propagation, startCount)) {
            Settling one{{}, whole, whole.coordinatesOf(start)};
            leaveOutliersOut(one, points, propagation);
            all.push_back(one.x);
            const double misfit = absoluteMisfit(points, propagation, one.problem.passOf(one.x));
            if (best.isOut.empty() || misfit < least) {
                least = misfit;
                best = std::move(one);
            }
        }
        for (int round = 0; round < mostWhitenings; ++round) {
            best.problem.estimateCorrelation(best.x);
            best.x = best.problem.minimum(best.x);
        }
        for (const DopplerCoordinates &x : all)
            best.others.push_back(best.problem.minimum(x));
        return best;
    }

    /// Whether the points clearly deviate from a straight line. If they do not, a small pass somewhere fits the errors,
    /// and the likelihood of single parameters does not follow its usual law.
    bool isSurelyBent(const Settling &settling, const DopplerOptimum &optimum)
    {
        constexpr double deviations = 5.0;
        return settling.problem.straightLineCost() - optimum.cost > deviations * deviations * optimum.variance;
    }

    DopplerOptimum optimumOf(const Settling &settling)
    {
        DopplerOptimum optimum;
        optimum.x = settling.x;
        optimum.cost = settling.problem.cost(settling.x);
        const double freedom = double(settling.problem.count()) - parameterCount;
        optimum.variance = std::max(leastScale * leastScale, optimum.cost / freedom);
        const double rest = std::max(1.0, settling.problem.errors().effectiveCount() - parameterCount);
        optimum.critical =
            isSurelyBent(settling, optimum)
                ? boost::math::quantile(boost::math::students_t(rest), 0.5 * (1.0 + coverage))
                : std::sqrt(parameterCount
                            * boost::math::quantile(boost::math::fisher_f(parameterCount, rest), doubtfulCoverage));
        return optimum;
    }

    /// The other minima, and those of passes long before and after at several speeds.
    std::vector<DopplerCoordinates> minimaElsewhere(const Settling &settling, const std::vector<DopplerPoint> &points,
                                                    double propagation)
    {
        std::vector<DopplerCoordinates> minima = settling.others;
        for (const DopplerPass &pass : passesElsewhere(points, propagation)) {
            const DopplerCoordinates x = settling.problem.coordinatesOf(pass);
            minima.push_back(settling.problem.minimum(x, DopplerParameter::Speed, x[1]));
        }
        return minima;
    }

    void describeResiduals(DopplerFit &fit, const Settling &settling, const DopplerOptimum &optimum)
    {
        double sum = 0.0;
        for (std::size_t i = 0; i < fit.residualHz.size(); ++i)
            if (!fit.isLeftOut[i])
                sum += fit.residualHz[i] * fit.residualHz[i];
        fit.rmsHz = std::sqrt(sum / double(settling.problem.count()));
        fit.deviationScale = std::sqrt(optimum.variance);
        fit.effectivePoints = settling.problem.errors().effectiveCount();
    }

} // namespace

DopplerFit fitDopplerPass(const std::vector<DopplerPoint> &points, double propagation)
{
    check(points, propagation);
    const Settling settling = settled(points, propagation);
    DopplerOptimum optimum = optimumOf(settling);
    const bool isBent = isSurelyBent(settling, optimum);
    const auto bounds = dopplerLimits(settling.problem, optimum,
                                      isBent ? settling.others : minimaElsewhere(settling, points, propagation));
    DopplerFit fit;
    fit.pass = settling.problem.passOf(optimum.x);
    fit.propagation = propagation;
    fit.restHz = bounds[std::size_t(DopplerParameter::RestHz)];
    fit.metresPerSecond = bounds[std::size_t(DopplerParameter::Speed)];
    fit.rangeMetres = bounds[std::size_t(DopplerParameter::Range)];
    fit.closestSeconds = bounds[std::size_t(DopplerParameter::Closest)];
    fit.residualHz = residualsOf(points, propagation, fit.pass);
    fit.isLeftOut = settling.isOut;
    describeResiduals(fit, settling, optimum);
    fit.isBent = isBent;
    fit.sentences = dopplerSentences(fit, points);
    return fit;
}

} // namespace faintline
