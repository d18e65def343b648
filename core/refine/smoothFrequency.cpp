#include "refine/smoothFrequency.h"

#include "base/Error.h"
#include "base/Field.h"
#include "refine/constants.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace faintline {

namespace {

    /// Frequencies and weights of a track's frames.
    struct Samples {
        Eigen::VectorXd hz;
        Eigen::VectorXd weights;
    };

    Samples samplesOf(const Track &track, const Axis &frequency)
    {
        const auto count = std::ssize(track.points);
        Samples samples{Eigen::VectorXd(count), Eigen::VectorXd::Ones(count)};
        for (Eigen::Index i = 0; i < count; ++i) {
            const auto point = std::size_t(i);
            samples.hz[i] = frequency.value(track.lastPosition(point, frequency));
            if (!track.hasSecondPass())
                continue;
            const SmoothedPoint &smoothed = track.smoothed[point];
            samples.weights[i] = double(smoothed.presence) / std::pow(smoothed.deviation(), 2);
        }
        return samples;
    }

    /// Removes the least-squares straight line, which the smoother does not change, to reduce rounding errors.
    Eigen::VectorXd straightLine(const Samples &samples)
    {
        const Eigen::Index n = samples.hz.size();
        Eigen::MatrixXd basis(n, 2);
        basis.col(0).setOnes();
        basis.col(1).setLinSpaced(n, -1.0, 1.0);
        const Eigen::VectorXd root = samples.weights.cwiseSqrt();
        const Eigen::Vector2d solution =
            (root.asDiagonal() * basis).colPivHouseholderQr().solve(root.cwiseProduct(samples.hz));
        return basis * solution;
    }

    /// Whittaker's smoother; `stiffness` in units of the mean weight.
    Eigen::VectorXd whittaker(const Samples &samples, double stiffness)
    {
        const Eigen::Index n = samples.hz.size();
        if (n < 3)
            return samples.hz;
        const Eigen::VectorXd line = straightLine(samples);
        const Eigen::VectorXd weights = samples.weights / samples.weights.mean();
        std::vector<Eigen::Triplet<double>> entries;
        for (Eigen::Index i = 0; i < n; ++i)
            entries.emplace_back(i, i, weights[i]);
        constexpr std::array<double, 3> difference{1.0, -2.0, 1.0};
        for (Eigen::Index i = 0; i + 2 < n; ++i)
            for (std::size_t a = 0; a < difference.size(); ++a)
                for (std::size_t b = 0; b < difference.size(); ++b)
                    entries.emplace_back(i + Eigen::Index(a), i + Eigen::Index(b),
                                         stiffness * difference[a] * difference[b]);
        Eigen::SparseMatrix<double> matrix(n, n);
        matrix.setFromTriplets(entries.begin(), entries.end());
        const Eigen::VectorXd right = weights.cwiseProduct(samples.hz - line);
        return line + Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right);
    }

    /// Extends the curve by `beyond` frames at either end with its slope there.
    std::vector<double> extendedBeyond(const Eigen::VectorXd &hz, Index beyond)
    {
        const Eigen::Index last = hz.size() - 1;
        const double rise = last > 0 ? hz[1] - hz[0] : 0.0;
        const double fall = last > 0 ? hz[last] - hz[last - 1] : 0.0;
        std::vector<double> longer;
        for (Index i = beyond; i > 0; --i)
            longer.push_back(hz[0] - rise * double(i));
        longer.insert(longer.end(), hz.begin(), hz.end());
        for (Index i = 1; i <= beyond; ++i)
            longer.push_back(hz[last] + fall * double(i));
        return longer;
    }

} // namespace

FrequencyCurve smoothFrequency(const AnalysisPlan &plan, const Track &track, double smoothingSeconds)
{
    const Axis &time = plan.time();
    const double period = smoothingSeconds == 0.0 ? smoothedFrames : smoothingSeconds / time.step;
    if (!(period >= shortestPeriodFrames && period <= mostSmoothedFrames))
        throw Error("smoothing over " + formatNumber(smoothingSeconds) + " s",
                    "must last 2 to 4096 frames, " + formatNumber(shortestPeriodFrames * time.step) + " … "
                        + formatNumber(mostSmoothedFrames * time.step) + " s");
    const double stiffness = std::pow(2.0 * std::sin(std::numbers::pi / period), -4);
    const Eigen::VectorXd hz = whittaker(samplesOf(track, plan.grid().axes.back()), stiffness);
    const auto beyond = Index(std::lround(0.5 * std::min(period, double(hz.size()))));
    Axis knots = time;
    knots.first = time.value(double(track.points.front().frame - beyond));
    knots.count = hz.size() + 2 * beyond;
    return {knots, extendedBeyond(hz, beyond)};
}

} // namespace faintline
