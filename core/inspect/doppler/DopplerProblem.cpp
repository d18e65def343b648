#include "inspect/doppler/DopplerProblem.h"

#include <Eigen/Dense>
#include <boost/math/tools/minima.hpp>
#include <unsupported/Eigen/AutoDiff>
#include <unsupported/Eigen/LevenbergMarquardt>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace faintline {

namespace {

    using Dual = Eigen::AutoDiffScalar<Eigen::Vector4d>;

    // Beyond these limits, a curve differs from that at the limit by less than machine precision, or v from c by less
    // than a thousandth.
    constexpr double leastLogitSpeed = -40.0;
    constexpr double mostLogitSpeed = 7.0;
    constexpr double mostLogTime = 14.0;

    double logistic(double x)
    {
        return 1.0 / (1.0 + std::exp(-x));
    }

    /// A coordinate with its derivative with respect to itself, 0 beyond its limits.
    Dual limited(const DopplerCoordinates &x, int number, double low, double high)
    {
        Eigen::Vector4d derivative = Eigen::Vector4d::Zero();
        derivative[number] = low <= x[number] && x[number] <= high ? 1.0 : 0.0;
        return {std::clamp(x[number], low, high), derivative};
    }

    /// β and T = R/v in units of the problem's time span, heard = t0 + R/c: these determine the shape of the curve.
    struct Shape {
        Dual beta, time, heard;

        explicit Shape(const DopplerCoordinates &x)
        {
            const Dual logit = limited(x, 1, leastLogitSpeed, mostLogitSpeed);
            beta = 1.0 / (1.0 + exp(-logit));
            time = exp(limited(x, 2, -mostLogTime, mostLogTime));
            heard = Dual(x[3], Eigen::Vector4d::Unit(3));
        }

        /// f(t)/f0, with s = τ - t0: receivedHz in these coordinates, which stay exact for light.
        Dual at(double t) const
        {
            const Dual w = t - heard + beta * time;
            const Dual rest = 1.0 - beta * beta;
            const Dual s = (w - beta * sqrt(w * w + rest * time * time)) / rest;
            return 1.0 / (1.0 + beta * s / sqrt(time * time + s * s));
        }
    };

    /// Functor for Eigen's optimiser. `held` < 0: all coordinates are free.
    class Reduced : public Eigen::DenseFunctor<double>
    {
    public:
        Reduced(const DopplerProblem &problem, int held, double own)
            : DenseFunctor(held < 0 ? 4 : 3, int(problem.count())), m_problem(&problem), m_held(held), m_own(own)
        {
        }

        /// All coordinates, given the free ones.
        DopplerCoordinates full(const Eigen::VectorXd &free) const
        {
            DopplerCoordinates x;
            for (int i = 0, j = 0; i < 4; ++i)
                x[i] = i == m_held ? m_own : free[j++];
            if (m_held == 2)
                x[2] -= std::log(logistic(x[1]));
            if (m_held == 3)
                x[3] += logistic(x[1]) * std::exp(x[2]);
            return x;
        }

        Eigen::VectorXd freeOf(const DopplerCoordinates &x) const
        {
            Eigen::VectorXd free(inputs());
            for (int i = 0, j = 0; i < 4; ++i)
                if (i != m_held)
                    free[j++] = x[i];
            return free;
        }

        int operator()(const Eigen::VectorXd &free, Eigen::VectorXd &values) const
        {
            values = m_problem->residuals(full(free));
            return 0;
        }

        int df(const Eigen::VectorXd &free, Eigen::MatrixXd &derivatives) const
        {
            const DopplerCoordinates x = full(free);
            Eigen::MatrixXd all;
            m_problem->residuals(x, &all);
            const double beta = logistic(x[1]);
            if (m_held == 2)
                all.col(1) -= (1.0 - beta) * all.col(2);
            if (m_held == 3) {
                all.col(1) += beta * (1.0 - beta) * std::exp(x[2]) * all.col(3);
                all.col(2) += beta * std::exp(x[2]) * all.col(3);
            }
            for (int i = 0, j = 0; i < 4; ++i)
                if (i != m_held)
                    derivatives.col(j++) = all.col(i);
            return 0;
        }

    private:
        const DopplerProblem *m_problem;
        int m_held;
        double m_own;
    };

    DopplerCoordinates minimise(const Reduced &reduced, const DopplerCoordinates &from)
    {
        Reduced functor = reduced;
        Eigen::LevenbergMarquardt<Reduced> optimiser(functor);
        constexpr double tolerance = 1e-9;
        optimiser.setFtol(tolerance);
        optimiser.setXtol(tolerance);
        optimiser.setMaxfev(100);
        optimiser.setFactor(1.0);
        Eigen::VectorXd free = functor.freeOf(from);
        optimiser.minimize(free);
        DopplerCoordinates x = functor.full(free);
        x[1] = std::clamp(x[1], leastLogitSpeed, mostLogitSpeed); // start the next search where derivatives are nonzero
        x[2] = std::clamp(x[2], -mostLogTime, mostLogTime);
        return x;
    }

    double medianOf(std::vector<double> values)
    {
        const auto middle = values.begin() + std::ssize(values) / 2;
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    }

    /// Flags the points that follow a gap.
    std::vector<char> firstsOf(const std::vector<DopplerPoint> &points)
    {
        constexpr double gapInTypicalSteps = 4.0; // typical steps
        std::vector<double> steps;
        for (std::size_t i = 1; i < points.size(); ++i)
            steps.push_back(points[i].seconds - points[i - 1].seconds);
        const double longest = gapInTypicalSteps * medianOf(steps);
        std::vector<char> isFirst{1};
        for (const double step : steps)
            isFirst.push_back(step > longest ? 1 : 0);
        return isFirst;
    }

    constexpr std::size_t mostOrder = 5;
    constexpr double mostPartial = 0.995;
    constexpr int searchBits = 10;
    constexpr int cycles = 2; ///< passes over all partial correlations of an order

    /// -2 ln L of the restricted likelihood.
    double restricted(const CorrelatedErrors &errors, Eigen::VectorXd r, Eigen::MatrixXd J)
    {
        errors.whiten(r);
        for (Eigen::Index column = 0; column < J.cols(); ++column)
            errors.whiten(J.col(column));
        const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(J);
        const Eigen::VectorXd rotated = qr.householderQ().transpose() * r;
        const Eigen::Index freedom = r.size() - J.cols();
        double result = errors.logDeterminant();
        result += double(freedom) * std::log(std::max(1e-300, rotated.tail(freedom).squaredNorm()));
        constexpr double rounding = 1e-12;
        for (Eigen::Index i = 0; i < J.cols(); ++i)
            result += 2.0 * std::log(std::max(std::abs(qr.matrixR()(i, i)), rounding * qr.maxPivot()));
        return result;
    }

} // namespace

DopplerProblem::DopplerProblem(const std::vector<DopplerPoint> &points, double propagation)
    : m_points(points), m_propagation(propagation), m_errors(firstsOf(points), {})
{
    const auto [lowest, highest] = std::minmax_element(
        points.begin(), points.end(), [](const DopplerPoint &a, const DopplerPoint &b) { return a.hz < b.hz; });
    m_middleHz = 0.5 * (lowest->hz + highest->hz);
    m_spanHz = std::max(highest->hz - lowest->hz, lowest->deviationHz);
    m_middleSeconds = 0.5 * (points.front().seconds + points.back().seconds);
    m_spanSeconds = points.back().seconds - points.front().seconds;
}

DopplerProblem DopplerProblem::with(std::vector<DopplerPoint> points) const
{
    DopplerProblem other = *this;
    other.m_points = std::move(points);
    other.m_errors = CorrelatedErrors(firstsOf(other.m_points), {});
    return other;
}

DopplerPass DopplerProblem::passOf(const DopplerCoordinates &x) const
{
    DopplerPass pass;
    pass.restHz = m_middleHz + x[0] * m_spanHz;
    pass.metresPerSecond = valueOf(DopplerParameter::Speed, x[1]);
    pass.rangeMetres = valueOf(DopplerParameter::Range, ownCoordinate(DopplerParameter::Range, x));
    pass.closestSeconds = valueOf(DopplerParameter::Closest, ownCoordinate(DopplerParameter::Closest, x));
    return pass;
}

DopplerCoordinates DopplerProblem::coordinatesOf(const DopplerPass &pass) const
{
    const double beta = pass.metresPerSecond / m_propagation;
    return {coordinateOfRest(pass.restHz), std::log(beta / (1.0 - beta)),
            std::log(pass.rangeMetres / (pass.metresPerSecond * m_spanSeconds)),
            (pass.closestSeconds + pass.rangeMetres / m_propagation - m_middleSeconds) / m_spanSeconds};
}

double DopplerProblem::ownCoordinate(DopplerParameter parameter, const DopplerCoordinates &x) const
{
    switch (parameter) {
    case DopplerParameter::RestHz:
        return x[0];
    case DopplerParameter::Speed:
        return x[1];
    case DopplerParameter::Range:
        return x[2] + std::log(logistic(x[1]));
    case DopplerParameter::Closest:
        break;
    }
    return x[3] - logistic(x[1]) * std::exp(x[2]);
}

double DopplerProblem::valueOf(DopplerParameter parameter, double own) const
{
    switch (parameter) {
    case DopplerParameter::RestHz:
        return m_middleHz + own * m_spanHz;
    case DopplerParameter::Speed:
        return m_propagation * logistic(own);
    case DopplerParameter::Range:
        return m_propagation * m_spanSeconds * std::exp(own);
    case DopplerParameter::Closest:
        break;
    }
    return m_middleSeconds + own * m_spanSeconds;
}

void DopplerProblem::estimateCorrelation(const DopplerCoordinates &x)
{
    const std::vector<char> isFirst = firstsOf(m_points);
    m_errors = CorrelatedErrors(isFirst, {});
    Eigen::MatrixXd J;
    const Eigen::VectorXd r = residuals(x, &J);
    CorrelatedErrors errors = likeliestErrors(r, J, isFirst);
    constexpr double mostGain = 1.5;
    if (errors.effectiveCount() < mostGain * double(count()))
        m_errors = std::move(errors);
}

Eigen::VectorXd DopplerProblem::residuals(const DopplerCoordinates &x, Eigen::MatrixXd *derivatives) const
{
    const auto n = Eigen::Index(count());
    Eigen::VectorXd values(n);
    if (derivatives)
        derivatives->resize(n, 4);
    const Shape shape(x);
    const Dual rest(m_middleHz + x[0] * m_spanHz, m_spanHz * Eigen::Vector4d::Unit(0));
    for (Eigen::Index i = 0; i < n; ++i) {
        const DopplerPoint &point = m_points[std::size_t(i)];
        const Dual fitted = rest * shape.at((point.seconds - m_middleSeconds) / m_spanSeconds);
        values[i] = (point.hz - fitted.value()) / point.deviationHz;
        if (derivatives)
            derivatives->row(i) = -fitted.derivatives().transpose() / point.deviationHz;
    }
    m_errors.whiten(values);
    for (Eigen::Index i = 0; derivatives && i < 4; ++i)
        m_errors.whiten(derivatives->col(i));
    return values;
}

double DopplerProblem::straightLineCost() const
{
    const auto n = Eigen::Index(count());
    Eigen::VectorXd values(n);
    Eigen::MatrixXd terms(n, 2);
    for (Eigen::Index i = 0; i < n; ++i) {
        const DopplerPoint &point = m_points[std::size_t(i)];
        values[i] = (point.hz - m_middleHz) / point.deviationHz;
        terms(i, 0) = 1.0 / point.deviationHz;
        terms(i, 1) = (point.seconds - m_middleSeconds) / (m_spanSeconds * point.deviationHz);
    }
    m_errors.whiten(values);
    m_errors.whiten(terms.col(0));
    m_errors.whiten(terms.col(1));
    return (values - terms * terms.colPivHouseholderQr().solve(values)).squaredNorm();
}

DopplerCoordinates DopplerProblem::minimum(const DopplerCoordinates &from) const
{
    return minimise(Reduced(*this, -1, 0.0), from);
}

DopplerCoordinates DopplerProblem::minimum(const DopplerCoordinates &from, DopplerParameter held, double own) const
{
    return minimise(Reduced(*this, int(held), own), from);
}

CorrelatedErrors::CorrelatedErrors(std::vector<char> isFirst, const std::vector<double> &partial)
    : m_predictors{{}}, m_variances{1.0}
{
    for (const double kappa : partial) {
        std::vector<double> next = m_predictors.back();
        for (std::size_t j = 0; j < next.size(); ++j)
            next[j] -= kappa * m_predictors.back()[next.size() - 1 - j];
        next.push_back(kappa);
        m_predictors.push_back(std::move(next));
        m_variances.push_back(m_variances.back() * (1.0 - kappa * kappa));
    }
    for (std::size_t i = 0; i < isFirst.size(); ++i)
        m_known.push_back(i == 0 || isFirst[i] ? 0 : std::min(m_known.back() + 1, partial.size()));
}

void CorrelatedErrors::whiten(Eigen::Ref<Eigen::VectorXd> values) const
{
    if (order() == 0)
        return;
    for (Eigen::Index i = values.size() - 1; i >= 0; --i) {
        const std::size_t known = m_known[std::size_t(i)];
        double predicted = 0.0;
        for (std::size_t j = 0; j < known; ++j)
            predicted += m_predictors[known][j] * values[i - 1 - Eigen::Index(j)];
        values[i] = (values[i] - predicted) / std::sqrt(m_variances[known]);
    }
}

double CorrelatedErrors::effectiveCount() const
{
    Eigen::VectorXd ones = Eigen::VectorXd::Ones(Eigen::Index(m_known.size()));
    whiten(ones);
    return ones.squaredNorm();
}

double CorrelatedErrors::logDeterminant() const
{
    return std::accumulate(m_known.begin(), m_known.end(), 0.0,
                           [this](double sum, std::size_t known) { return sum + std::log(m_variances[known]); });
}

CorrelatedErrors likeliestErrors(const Eigen::VectorXd &r, const Eigen::MatrixXd &J, const std::vector<char> &isFirst)
{
    std::vector<double> partial;
    std::vector<double> best;
    const auto valueOf = [&](const std::vector<double> &kappas) {
        return restricted(CorrelatedErrors(isFirst, kappas), r, J);
    };
    double least = valueOf({});
    for (std::size_t order = 1; order <= mostOrder; ++order) {
        partial.push_back(0.0);
        double value = least;
        for (int cycle = 0; cycle < cycles; ++cycle)
            for (std::size_t i = order; i-- > 0;) {
                const auto at = [&](double kappa) {
                    std::vector<double> changed = partial;
                    changed[i] = kappa;
                    return valueOf(changed);
                };
                std::tie(partial[i], value) =
                    boost::math::tools::brent_find_minima(at, -mostPartial, mostPartial, searchBits);
            }
        if (value + 2.0 * double(order) < least) {
            least = value + 2.0 * double(order);
            best = partial;
        }
    }
    return {isFirst, best};
}

} // namespace faintline
