#include "evaluate/theory/waldTheory.h"

#include "base/Error.h"

#include <Eigen/Dense>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/gamma.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace faintline {

namespace {

    void checkSnr(double snr)
    {
        if (!(snr > 0.0 && snr < 1e12))
            throw fieldError("SNR", formatNumber(snr), "must be a power ratio above 0");
    }

    /// E e^{-t·g(y)} of one cell, g = e^{ys}/(1+ρ), s = ρ/(1+ρ), y exponential of the given mean.
    double cellTransform(double lnT, double snr, double mean)
    {
        const double s = snr / (1.0 + snr);
        const double lnScaled = lnT - std::log1p(snr);
        // e^{-t·g} is nearly 1 up to where t·g reaches 1 and nothing soon afterwards: one piece on either side.
        const auto value = [&](double y) { return std::exp(-y - std::exp(lnScaled + mean * s * y)); };
        const double knee = std::clamp(-lnScaled / (mean * s), 0.0, 700.0);
        const double end = std::max(knee + 4.5 / (mean * s), 1.0);
        using Rule = boost::math::quadrature::gauss_kronrod<double, 61>;
        double sum = 0.0;
        for (const auto &[from, to] :
             {std::pair{0.0, std::min(knee, 45.0)}, std::pair{std::min(knee, 45.0), std::min(end, 60.0)}})
            if (from < to)
                sum += Rule::integrate(value, from, to, 8, 1e-13);
        return sum;
    }

    using Nodes = std::vector<double>;

    /// Gauss-Legendre points and weights on -1 … 1.
    constexpr std::size_t order = 16;
    struct Rule {
        Nodes x;
        Nodes w;
    };
    const Rule &gaussRule()
    {
        static const Rule rule = [] {
            using Half = boost::math::quadrature::gauss<double, order>;
            Rule all;
            for (std::size_t i = order / 2; i-- > 0;) {
                all.x.push_back(-Half::abscissa()[i]);
                all.w.push_back(Half::weights()[i]);
            }
            for (std::size_t i = 0; i < order / 2; ++i) {
                all.x.push_back(Half::abscissa()[i]);
                all.w.push_back(Half::weights()[i]);
            }
            return all;
        }();
        return rule;
    }

    /// Values at x of the polynomials that are 1 at one Gauss point and 0 at the others (barycentric).
    Nodes lagrange(double x)
    {
        static const Nodes barycentric = [] {
            Nodes weights;
            for (std::size_t i = 0; i < order; ++i) {
                double product = 1.0;
                for (std::size_t j = 0; j < order; ++j)
                    if (j != i)
                        product *= gaussRule().x[i] - gaussRule().x[j];
                weights.push_back(1.0 / product);
            }
            return weights;
        }();
        Nodes values(order, 0.0);
        double sum = 0.0;
        for (std::size_t i = 0; i < order; ++i) {
            const double distance = x - gaussRule().x[i];
            if (distance == 0.0) {
                values.assign(order, 0.0);
                values[i] = 1.0;
                return values;
            }
            values[i] = barycentric[i] / distance;
            sum += values[i];
        }
        for (double &value : values)
            value /= sum;
        return values;
    }

    /// A walk on `low` … `high` whose steps are λ = scale·E - c, E exponential of mean 1: quantities N = g + ∫ N f.
    class Walk
    {
    public:
        Walk(double low, double high, double c, double scale) : m_low(low), m_high(high), m_c(c), m_scale(scale)
        {
            const double panels = std::ceil((high - low) / c - 1e-9);
            if (!(panels <= 256.0))
                throw Error("SNR", "is too low for the exact solution; use Wald's approximation");
            for (double edge = low; std::ssize(m_edges) < Index(panels); edge += c)
                m_edges.push_back(edge);
            m_edges.push_back(high);
            const auto size = Index((m_edges.size() - 1) * order);
            Eigen::MatrixXd system = Eigen::MatrixXd::Identity(size, size);
            for (Index i = 0; i < size; ++i) {
                const Nodes row = weights(node(i));
                for (Index j = 0; j < size; ++j)
                    system(i, j) -= row[std::size_t(j)];
            }
            m_solver.compute(system);
        }

        Index size() const { return Index((m_edges.size() - 1) * order); }
        double node(Index i) const
        {
            const auto panel = std::size_t(i) / order;
            return toPanel(panel, gaussRule().x[std::size_t(i) % order]);
        }

        template <class Given>
        Eigen::VectorXd solve(Given given) const
        {
            Eigen::VectorXd right(size());
            for (Index i = 0; i < size(); ++i)
                right(i) = given(i);
            return m_solver.solve(right);
        }

        /// ∫ N(z) f(z - x) dz
        double integral(const Eigen::VectorXd &values, double x) const
        {
            const Nodes row = weights(x);
            return Eigen::Map<const Eigen::VectorXd>(row.data(), size()).dot(values);
        }

        /// Probability that the next step from x goes above the walk's upper end, or below its lower one.
        double leavesAbove(double x) const { return std::exp(-std::max(0.0, m_high - x + m_c) / m_scale); }
        double leavesBelow(double x) const { return -std::expm1(-std::max(0.0, m_low - x + m_c) / m_scale); }

    private:
        double toPanel(std::size_t panel, double local) const
        {
            return 0.5 * (m_edges[panel] + m_edges[panel + 1]) + 0.5 * (m_edges[panel + 1] - m_edges[panel]) * local;
        }

        /// Weights of ∫ N(z) f(z - x) dz on N at the nodes; f begins at z = x - c, often inside a panel.
        Nodes weights(double x) const
        {
            Nodes row(std::size_t(size()), 0.0);
            const double begin = x - m_c;
            for (std::size_t panel = 0; panel + 1 < m_edges.size(); ++panel) {
                const double from = std::max(begin, m_edges[panel]);
                const double to = m_edges[panel + 1];
                if (from >= to)
                    continue;
                for (std::size_t k = 0; k < order; ++k) {
                    const double z = 0.5 * (from + to) + 0.5 * (to - from) * gaussRule().x[k];
                    const double weight =
                        0.5 * (to - from) * gaussRule().w[k] * std::exp(-(z - begin) / m_scale) / m_scale;
                    const Nodes values = lagrange((2.0 * z - m_edges[panel] - to) / (to - m_edges[panel]));
                    for (std::size_t i = 0; i < order; ++i)
                        row[panel * order + i] += weight * values[i];
                }
            }
            return row;
        }

        double m_low;
        double m_high;
        double m_c;
        double m_scale;
        Nodes m_edges;
        Eigen::PartialPivLU<Eigen::MatrixXd> m_solver;
    };

    DeterministicSprt::Law solveWalk(const SprtBoundaries &boundaries, double c, double scale)
    {
        const Walk walk(boundaries.lnLower, boundaries.lnUpper, c, scale);
        const Eigen::VectorXd mean = walk.solve([](Index) { return 1.0; });
        const Eigen::VectorXd square = walk.solve([&](Index i) { return 2.0 * mean(i) - 1.0; });
        const Eigen::VectorXd above = walk.solve([&](Index i) { return walk.leavesAbove(walk.node(i)); });
        const Eigen::VectorXd below = walk.solve([&](Index i) { return walk.leavesBelow(walk.node(i)); });
        DeterministicSprt::Law law;
        law.meanStages = 1.0 + walk.integral(mean, 0.0);
        const double meanSquare = 2.0 * law.meanStages - 1.0 + walk.integral(square, 0.0);
        law.deviationStages = std::sqrt(std::max(0.0, meanSquare - law.meanStages * law.meanStages));
        law.acceptH1 = walk.leavesAbove(0.0) + walk.integral(above, 0.0);
        law.acceptH0 = walk.leavesBelow(0.0) + walk.integral(below, 0.0);
        return law;
    }

} // namespace

Divergences divergences(double snr)
{
    checkSnr(snr);
    return {snr - std::log1p(snr), std::log1p(snr) - snr / (1.0 + snr)};
}

Divergences mixtureDivergences(double snr, int cells)
{
    checkSnr(snr);
    if (snr > 1000.0)
        throw fieldError("SNR", formatNumber(snr), "is too high for the quadrature; at most 1000 is possible");
    if (cells < 1)
        throw Error("cells", "must be at least 1");
    const auto M = double(cells);
    // E ln W = ∫ (e^{-t} - E e^{-tW}) d ln t; the trapezoidal rule is as good as exact for such a smooth bell.
    constexpr double spacing = 0.3;
    double h0 = 0.0;
    double h1 = 0.0;
    const double first = -38.0 * std::max(1.0, snr); // until the left tail, t^{1/ρ}, is gone
    const double last = std::log(50.0 * (1.0 + snr)) + 4.0;
    for (double lnT = first; lnT < last; lnT += spacing) {
        const double none = std::exp(-std::exp(lnT));
        const double noise = cellTransform(lnT - std::log(M), snr, 1.0);
        const double target = cellTransform(lnT - std::log(M), snr, 1.0 + snr);
        const double others = std::pow(noise, M - 1.0);
        h0 += none - noise * others;
        h1 += none - target * others;
    }
    return {spacing * h1, -spacing * h0};
}

WaldBounds waldBounds(const SprtSettings &settings, double snr, int cells)
{
    checkSprt(settings, "sprt");
    const SprtBoundaries at = sprtBoundaries(settings);
    const double h1Nats = settings.miss * at.lnLower + (1.0 - settings.miss) * at.lnUpper;
    const double h0Nats = -((1.0 - settings.falseAlarm) * at.lnLower + settings.falseAlarm * at.lnUpper);
    const Divergences known = divergences(snr);
    const Divergences unknown = mixtureDivergences(snr, cells);
    return {h0Nats / known.h0, h0Nats / unknown.h0, h1Nats / known.h1, h1Nats / unknown.h1};
}

DeterministicSprt deterministicSprt(const SprtSettings &settings, double designSnr, double actualSnr)
{
    checkSprt(settings, "sprt");
    checkSnr(designSnr);
    checkSnr(actualSnr);
    const SprtBoundaries at = sprtBoundaries(settings);
    const double c = std::log1p(designSnr);
    const double scale = designSnr / (1.0 + designSnr);
    return {solveWalk(at, c, scale), solveWalk(at, c, scale * (1.0 + actualSnr))};
}

Index fixedSampleSize(const SprtSettings &settings, double snr)
{
    checkSprt(settings, "sprt");
    checkSnr(snr);
    const auto isEnough = [&](Index n) {
        const auto shape = double(n);
        const double threshold = boost::math::gamma_q_inv(shape, settings.falseAlarm);
        return boost::math::gamma_p(shape, threshold / (1.0 + snr)) <= settings.miss;
    };
    Index high = 1;
    while (!isEnough(high)) {
        high *= 2;
        if (high > 100000000)
            throw fieldError("SNR", formatNumber(snr), "needs more than 10⁸ stages of a fixed-size test");
    }
    Index low = high / 2; // not enough, or 0
    while (high - low > 1) {
        const Index middle = low + (high - low) / 2;
        (isEnough(middle) ? high : low) = middle;
    }
    return high;
}

} // namespace faintline
