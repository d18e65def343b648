#include "inspect/doppler/dopplerFit.h"

#include "base/Error.h"
#include "inspect/doppler/DopplerPass.h"
#include "inspect/doppler/DopplerProblem.h"

#include <Eigen/Dense>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace faintline {

namespace {

    constexpr std::size_t mostPoints = 60;
    constexpr double speedFactors[]{1.0, 1.3, 1.8, 3.0, 6.0, 15.0};
    constexpr double timeFactors[]{0.003, 0.01, 0.03, 0.1, 0.25, 0.6, 1.5, 4.0, 10.0}; ///< R/v in track lengths
    constexpr double heardStep = 0.125; ///< in track lengths, from one before its middle to one after
    constexpr double mostBeta = 0.95;

    std::vector<DopplerPoint> evenly(const std::vector<DopplerPoint> &points)
    {
        const std::size_t count = std::min(points.size(), mostPoints);
        std::vector<DopplerPoint> some;
        for (std::size_t i = 0; i < count; ++i)
            some.push_back(points[i * (points.size() - 1) / (count - 1)]);
        return some;
    }

    /// The smallest v/c whose pass spans the points.
    double leastBeta(const std::vector<DopplerPoint> &points)
    {
        std::vector<double> hz;
        for (const DopplerPoint &point : points)
            hz.push_back(point.hz);
        std::sort(hz.begin(), hz.end());
        const double low = hz[hz.size() / 20];
        const double high = hz[hz.size() - 1 - hz.size() / 20];
        const double errors = 0.1 * points.front().deviationHz / high;
        return std::clamp((high - low) / (high + low), std::max(errors, 1e-14), mostBeta);
    }

    double medianOfStarts(std::vector<double> &values)
    {
        const auto middle = values.begin() + std::ssize(values) / 2;
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    }

    void setMedianRest(DopplerPass &pass, const std::vector<DopplerPoint> &points, double propagation)
    {
        pass.restHz = 1.0;
        std::vector<double> ratios;
        for (const DopplerPoint &point : points)
            ratios.push_back(point.hz / receivedHz(pass, propagation, point.seconds));
        pass.restHz = medianOfStarts(ratios);
    }

    /// When the closest approach is heard, relative to the points.
    enum class When { Any, Before, After };

    bool isHeard(When when, const DopplerPass &pass, const std::vector<DopplerPoint> &points, double propagation)
    {
        const double heard = pass.closestSeconds + pass.rangeMetres / propagation;
        return when == When::Any || (when == When::Before && heard < points.front().seconds)
               || (when == When::After && heard > points.back().seconds);
    }

    /// Σ |measured - fitted|/deviation.
    double absoluteMisfit(const std::vector<DopplerPoint> &points, double propagation, const DopplerPass &pass)
    {
        double sum = 0.0;
        for (const DopplerPoint &point : points)
            sum += std::abs(point.hz - receivedHz(pass, propagation, point.seconds)) / point.deviationHz;
        return sum;
    }

    /// Passes long before and long after the points, at speeds up to 0.9 c, which may explain a constant frequency.
    std::vector<DopplerPass> passesElsewhere(const std::vector<DopplerPoint> &points, double propagation)
    {
        const std::vector<DopplerPoint> some = evenly(points);
        const double length = some.back().seconds - some.front().seconds;
        const double middle = 0.5 * (some.back().seconds + some.front().seconds);
        std::vector<DopplerPass> passes;
        for (const double beta : {0.003, 0.03, 0.1, 0.3, 0.9})
            for (const double heard : {-3.0, 3.0}) {
                DopplerPass pass;
                pass.metresPerSecond = beta * propagation;
                pass.rangeMetres = 0.1 * pass.metresPerSecond * length;
                pass.closestSeconds = middle + heard * length - pass.rangeMetres / propagation;
                setMedianRest(pass, some, propagation);
                passes.push_back(pass);
            }
        return passes;
    }

    /// Starting passes for a fit of these points: the `most` best, and the best of those heard before and after the
    /// points. The best comes first.
    ///
    /// Searches a grid over v, R/v and the time at which the closest approach is heard; f0 is the median of measured
    /// frequency over f/f0. Passes are ranked by Σ |measured - fitted|/deviation, which is robust against a few
    /// outliers. v starts where the pass just spans the points (5 to 95 %). At most 60 evenly spread points are used.
    /// Precondition: times increase, frequencies above 0.
    std::vector<DopplerPass> dopplerStarts(const std::vector<DopplerPoint> &points, double propagation,
                                           std::size_t most)
    {
        const std::vector<DopplerPoint> some = evenly(points);
        const double length = some.back().seconds - some.front().seconds;
        const double middle = 0.5 * (some.back().seconds + some.front().seconds);
        const double least = leastBeta(some);
        std::vector<std::pair<double, DopplerPass>> ranked;
        for (const double speedFactor : speedFactors)
            for (const double timeFactor : timeFactors)
                for (double heard = -1.0; heard <= 1.0; heard += heardStep) {
                    DopplerPass pass;
                    pass.metresPerSecond = propagation * std::min(least * speedFactor, mostBeta);
                    pass.rangeMetres = pass.metresPerSecond * timeFactor * length;
                    pass.closestSeconds = middle + heard * length - pass.rangeMetres / propagation;
                    setMedianRest(pass, some, propagation);
                    ranked.emplace_back(absoluteMisfit(some, propagation, pass), pass);
                }
        std::sort(ranked.begin(), ranked.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
        std::vector<DopplerPass> best;
        for (const When when : {When::Any, When::Before, When::After})
            for (const auto &[misfit, pass] : ranked)
                if (isHeard(when, pass, some, propagation)) {
                    best.push_back(pass);
                    break;
                }
        for (std::size_t i = 1; i < std::min(most, ranked.size()); ++i)
            best.push_back(ranked[i].second);
        return best;
    }

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

    /// Limits of a model's slopes, bins per frame.
    struct Slopes {
        double lowest = 0.0, highest = 0.0;

        explicit Slopes(const StateSpace &space)
        {
            for (Index plane = 0; plane < space.planeCount(); ++plane) {
                lowest = std::min(lowest, space.ratesOfPlane(plane).back());
                highest = std::max(highest, space.ratesOfPlane(plane).back());
            }
        }
        /// Whether a line may be steeper than a path of this slope.
        bool isLimit(double slope) const
        {
            constexpr double steepShareOfLimit = 0.85;
            return (slope < 0.0 && slope <= steepShareOfLimit * lowest)
                   || (slope > 0.0 && slope >= steepShareOfLimit * highest);
        }
    };

    /// In a short piece next to a steep one, the path has probably lost its line.
    void dropShortPieces(std::vector<char> &isSteep)
    {
        constexpr std::ptrdiff_t stretchMinimumPoints = 16;
        if (std::find(isSteep.begin(), isSteep.end(), char(1)) == isSteep.end())
            return;
        for (auto from = isSteep.begin(); from != isSteep.end();) {
            const auto to = std::find(from, isSteep.end(), char(1));
            if (to - from < stretchMinimumPoints)
                std::fill(from, to, char(1));
            from = std::find(to, isSteep.end(), char(0));
        }
    }

    /// Flags points within two frames of where the path, or its mean slope over four frames, is at the limit.
    std::vector<char> steepPoints(const StateSpace &space, const Axis &axis, const Track &track)
    {
        constexpr std::ptrdiff_t slopeReachPoints = 2;
        const Slopes slopes(space);
        const std::ptrdiff_t count = std::ssize(track.points);
        const auto at = [&](std::ptrdiff_t i) { return track.lastPosition(std::size_t(i), axis); };
        std::vector<char> isSteep(track.points.size(), 0);
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            const std::ptrdiff_t from = std::max<std::ptrdiff_t>(0, i - slopeReachPoints);
            const std::ptrdiff_t to = std::min(count - 1, i + slopeReachPoints);
            const double mean = to > from ? (at(to) - at(from)) / double(to - from) : 0.0;
            const Index plane = track.points[std::size_t(i)].plane;
            if (slopes.isLimit(space.ratesOfPlane(plane).back()) || (track.hasSecondPass() && slopes.isLimit(mean)))
                std::fill(isSteep.begin() + from, isSteep.begin() + to + 1, char(1));
        }
        dropShortPieces(isSteep);
        return isSteep;
    }

    /// Standard deviation of a point's position, in cells; empty if the signal is absent.
    std::optional<double> deviationOf(const Track &track, std::size_t point)
    {
        if (!track.hasSecondPass())
            return 1.0 / std::sqrt(12.0);
        if (!track.isPresent(point))
            return {};
        return track.smoothed[point].deviation();
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

DopplerTrack dopplerTrack(const AnalysisPlan &plan, const Track &track, double centreHz)
{
    if (!plan.grid().isSpectrum())
        throw Error("Doppler fit", "needs frames on frequency alone; these have more than one axis");
    const Axis &axis = plan.grid().axes.back();
    const StateSpace &space = plan.modelAt(track.model).space;
    const std::vector<char> isSteep = steepPoints(space, axis, track);
    DopplerTrack result;
    result.steepestHzPerSecond = -Slopes(space).lowest * std::abs(axis.step) / plan.time().step;
    for (std::size_t i = 0; i < track.points.size(); ++i) {
        const std::optional<double> cells = deviationOf(track, i);
        if (cells && isSteep[i])
            ++result.steepCount;
        else if (cells)
            result.points.push_back({plan.time().value(double(track.points[i].frame)),
                                     centreHz + axis.value(track.lastPosition(i, axis)), *cells * std::abs(axis.step)});
    }
    return result;
}

DopplerTrack joined(const std::vector<DopplerTrack> &tracks)
{
    DopplerTrack all;
    for (const DopplerTrack &track : tracks) {
        all.points.insert(all.points.end(), track.points.begin(), track.points.end());
        all.steepCount += track.steepCount;
        all.steepestHzPerSecond = std::max(all.steepestHzPerSecond, track.steepestHzPerSecond);
    }
    const auto isEarlier = [](const DopplerPoint &a, const DopplerPoint &b) { return a.seconds < b.seconds; };
    std::stable_sort(all.points.begin(), all.points.end(), isEarlier);
    for (std::size_t i = 1; i < all.points.size(); ++i)
        if (!isEarlier(all.points[i - 1], all.points[i]))
            throw Error("Doppler fit", "the events are there at the same time, so they are not one pass");
    return all;
}

} // namespace faintline
