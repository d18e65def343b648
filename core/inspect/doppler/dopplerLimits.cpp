#include "inspect/doppler/DopplerProblem.h"

#include <Eigen/Dense>
#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace faintline {

namespace {

    constexpr std::array parameters{DopplerParameter::RestHz, DopplerParameter::Speed, DopplerParameter::Range,
                                    DopplerParameter::Closest};
    constexpr double growth = 1.6;
    constexpr double accuracy = 2e-3; ///< of a limit, in units of the first step
    constexpr double betterBy = 1e-6; ///< relative: more than rounding
    constexpr int mostOptima = 4;

    /// Distance of a cost from the optimum's region, in standard deviations; positive: outside.
    double excessOf(double cost, const DopplerOptimum &optimum)
    {
        const double above = cost - optimum.cost;
        return std::copysign(std::sqrt(std::abs(above) / optimum.variance), above) - optimum.critical;
    }

    /// A point inside the likelihood region.
    struct Inside {
        DopplerCoordinates x;
        double excess = 0.0; ///< at most 0
    };

    /// One parameter's profile around an optimum. Shares the inside points that it finds with the others.
    class Profile
    {
    public:
        Profile(const DopplerProblem &problem, const DopplerOptimum &optimum, DopplerParameter parameter,
                std::vector<Inside> &found)
            : m_problem(problem), m_optimum(optimum), m_parameter(parameter), m_found(found),
              m_centre(problem.ownCoordinate(parameter, optimum.x)), m_step(firstStep())
        {
        }

        /// The farthest point known to lie inside, on side -1 or 1.
        Inside farthest(int direction) const
        {
            return *std::max_element(m_found.begin(), m_found.end(), [&](const Inside &a, const Inside &b) {
                return direction * ownOf(a) < direction * ownOf(b);
            });
        }

        /// Whether a known inside point lies beyond a limit's coordinate.
        bool isPassed(double limit, int direction) const
        {
            return direction * (ownOf(farthest(direction)) - limit) > 2.0 * accuracy * m_step;
        }

        /// The limit on one side in the parameter's own coordinate; empty if open.
        std::optional<double> limit(int direction)
        {
            const double end = endOf(direction);
            Inside last = farthest(direction);
            double own = ownOf(last);
            for (double step = m_step; direction * (end - own) > 0.0; step *= growth) {
                const double next = direction > 0 ? std::min(own + step, end) : std::max(own - step, end);
                Inside there{last.x};
                there.excess = excess(next, there.x);
                if (there.excess > 0.0)
                    return crossing({own, next}, {last.excess, there.excess}, last.x);
                own = next;
                last = there;
            }
            return std::nullopt;
        }

    private:
        double ownOf(const Inside &place) const { return m_problem.ownCoordinate(m_parameter, place.x); }

        /// Distance of a value outside, in standard deviations; x is the nearest solution and is updated to its own.
        double excess(double own, DopplerCoordinates &x)
        {
            x = m_problem.minimum(x, m_parameter, own);
            const double result = excessOf(m_problem.cost(x), m_optimum);
            if (result <= 0.0)
                m_found.push_back({x, result});
            return result;
        }

        double crossing(std::array<double, 2> own, std::array<double, 2> value, const DopplerCoordinates &nearest)
        {
            if (value[0] >= 0.0)
                return own[0];
            if (own[0] > own[1]) {
                std::swap(own[0], own[1]);
                std::swap(value[0], value[1]);
            }
            std::uintmax_t evaluations = 20;
            const auto isNear = [this](double a, double b) { return b - a < accuracy * m_step; };
            const auto at = [&](double z) {
                DopplerCoordinates x = nearest;
                return excess(z, x);
            };
            const auto [low, high] =
                boost::math::tools::toms748_solve(at, own[0], own[1], value[0], value[1], isNear, evaluations);
            return 0.5 * (low + high);
        }

        /// Distance of the limit if the residuals were linear in the coordinates.
        double firstStep() const
        {
            Eigen::MatrixXd J;
            m_problem.residuals(m_optimum.x, &J);
            const double beta = 1.0 / (1.0 + std::exp(-m_optimum.x[1]));
            const double time = std::exp(m_optimum.x[2]);
            Eigen::Vector4d gradient = Eigen::Vector4d::Unit(int(m_parameter));
            if (m_parameter == DopplerParameter::Range)
                gradient[1] = 1.0 - beta;
            if (m_parameter == DopplerParameter::Closest) {
                gradient[1] = -beta * (1.0 - beta) * time;
                gradient[2] = -beta * time;
            }
            const Eigen::Vector4d spread = (J.transpose() * J).eval().ldlt().solve(gradient);
            const double step = m_optimum.critical * std::sqrt(std::abs(gradient.dot(spread)) * m_optimum.variance);
            return std::isfinite(step) ? std::clamp(step, 1e-12, 1.0) : 0.1;
        }

        double endOf(int direction) const
        {
            constexpr double logSpeed = 12.0;
            constexpr double limitLogitSpeed = 6.5; // v/c = 0.9985
            constexpr double logRange = 14.0;
            constexpr double lengths = 200.0;
            constexpr double mostRest = 1e3;
            switch (m_parameter) {
            case DopplerParameter::RestHz:
                return direction < 0 ? m_problem.coordinateOfRest(0.0)
                                     : m_problem.coordinateOfRest(mostRest * m_problem.passOf(m_optimum.x).restHz);
            case DopplerParameter::Speed:
                return direction < 0 ? m_centre - logSpeed : std::max(limitLogitSpeed, m_centre);
            case DopplerParameter::Range:
                return m_centre + direction * logRange;
            case DopplerParameter::Closest:
                break;
            }
            return m_centre + direction * lengths;
        }

        const DopplerProblem &m_problem;
        const DopplerOptimum &m_optimum;
        DopplerParameter m_parameter;
        std::vector<Inside> &m_found;
        double m_centre;
        double m_step;
    };

    /// One limit, in its own coordinate.
    struct Limit {
        std::size_t parameter;
        int direction;
        std::optional<double> own;
        bool isKnown = false;
    };

    /// Follows all profiles, and repeats those whose limits another profile has passed: a curved region has points that
    /// a profile does not reach from the optimum.
    std::vector<Limit> followed(const DopplerProblem &problem, const DopplerOptimum &optimum,
                                std::vector<Inside> &found)
    {
        constexpr int rounds = 3;
        std::vector<Limit> limits;
        for (std::size_t i = 0; i < parameters.size(); ++i)
            limits.insert(limits.end(), {Limit{i, -1, {}}, Limit{i, 1, {}}});
        for (int round = 0; round < rounds; ++round)
            for (Limit &limit : limits) {
                Profile profile(problem, optimum, parameters[limit.parameter], found);
                if (limit.isKnown && (!limit.own || !profile.isPassed(*limit.own, limit.direction)))
                    continue;
                limit.own = profile.limit(limit.direction);
                limit.isKnown = true;
            }
        return limits;
    }

} // namespace

std::array<DopplerBounds, 4> dopplerLimits(const DopplerProblem &problem, DopplerOptimum &optimum,
                                           const std::vector<DopplerCoordinates> &others)
{
    std::vector<Limit> limits;
    for (int optima = 0; optima < mostOptima; ++optima) {
        std::vector<Inside> found{{optimum.x, -optimum.critical}};
        for (const DopplerCoordinates &x : others)
            if (const double excess = excessOf(problem.cost(x), optimum); excess <= 0.0)
                found.push_back({x, excess});
        limits = followed(problem, optimum, found);
        const auto best = std::min_element(found.begin(), found.end(),
                                           [](const Inside &a, const Inside &b) { return a.excess < b.excess; });
        const DopplerCoordinates x = problem.minimum(best->x);
        const double cost = problem.cost(x);
        if (cost >= optimum.cost * (1.0 - betterBy))
            break;
        optimum.variance *= cost / optimum.cost;
        optimum.x = x;
        optimum.cost = cost;
    }
    std::array<DopplerBounds, 4> bounds;
    for (const Limit &limit : limits)
        if (limit.own) {
            DopplerBounds &both = bounds[limit.parameter];
            (limit.direction < 0 ? both.low : both.high) = problem.valueOf(parameters[limit.parameter], *limit.own);
        }
    return bounds;
}

} // namespace faintline
