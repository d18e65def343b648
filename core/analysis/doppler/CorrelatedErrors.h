#pragma once

#include <Eigen/Core>

#include <vector>

namespace faintline {

/// Errors of a sequence in which neighbours are alike: an autoregressive process of a low order p, stationary within
/// stretches and independent from one stretch to the next.
///
/// It is given by its partial correlations κ_1 … κ_p, each within -1 … 1, which any stationary process has. The
/// recursion of Levinson and Durbin makes of them the best predictors of an error from the k before it, k ≤ p, and what
/// variance they leave, v_k = Π_{i≤k} (1 - κ_i²). Whitening takes the prediction off each value and divides by √v_k:
/// W with WᵀW = P⁻¹, P the matrix of correlations, exactly, from the first value of each stretch on.
class CorrelatedErrors
{
public:
    /// `isFirst`: one per value, 1 where a stretch begins.
    CorrelatedErrors(std::vector<char> isFirst, const std::vector<double> &partial);

    std::size_t order() const { return m_predictors.size() - 1; }
    /// W·values, in place; one value per point.
    void whiten(Eigen::Ref<Eigen::VectorXd> values) const;
    /// Points without correlation that tell as much of a constant: 1ᵀP⁻¹1.
    double effectiveCount() const;
    /// ln |P|.
    double logDeterminant() const;

private:
    std::vector<std::size_t> m_known;              ///< values before each in its stretch, at most p
    std::vector<std::vector<double>> m_predictors; ///< of k = 0 … p values before; the nearest first
    std::vector<double> m_variances;
};

/// The errors that residuals r of a fit with derivatives J (a column per parameter) are likeliest to come from.
///
/// Partial correlations maximise the restricted likelihood, in which what the parameters took out of the residuals
/// does not count:  -2 ln L = (n - p_J) ln RSS + ln|P| + ln|JᵀP⁻¹J|,  the scale maximised out. The order, at most 5, is
/// that of the least Akaike criterion, -2 ln L + 2·order. Source: Patterson and Thompson 1971; Akaike 1974.
CorrelatedErrors likeliestErrors(const Eigen::VectorXd &r, const Eigen::MatrixXd &J, const std::vector<char> &isFirst);

} // namespace faintline
