#include "inspect/doppler/CorrelatedErrors.h"

#include <Eigen/Dense>
#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace faintline {

namespace {

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
