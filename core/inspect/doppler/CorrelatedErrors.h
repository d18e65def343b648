#pragma once

#include <Eigen/Core>

#include <vector>

namespace faintline {

/// Correlated errors of a sequence: an autoregressive process of a low order p, stationary within stretches and
/// independent between stretches.
///
/// It is parametrised by its partial correlations κ_1 … κ_p, each within -1 … 1, as any stationary process can be. The
/// Levinson-Durbin recursion turns them into the best predictors of an error from the k before it, k ≤ p, and the
/// variance that remains, v_k = Π_{i≤k} (1 - κ_i²). Whitening subtracts the prediction from each value and divides by
/// √v_k: W with WᵀW = P⁻¹, P the correlation matrix, exact from the first value of each stretch.
class CorrelatedErrors
{
public:
    /// `isFirst`: one per value, 1 where a stretch begins.
    CorrelatedErrors(std::vector<char> isFirst, const std::vector<double> &partial);

    std::size_t order() const { return m_predictors.size() - 1; }
    /// W·values, in place; one value per point.
    void whiten(Eigen::Ref<Eigen::VectorXd> values) const;
    /// Number of uncorrelated points equally informative about a constant: 1ᵀP⁻¹1.
    double effectiveCount() const;
    /// ln |P|.
    double logDeterminant() const;

private:
    std::vector<std::size_t> m_known;              ///< preceding values in the stretch, at most p
    std::vector<std::vector<double>> m_predictors; ///< from k = 0 … p preceding values; nearest first
    std::vector<double> m_variances;
};

/// Maximum-likelihood errors for the residuals r of a fit with derivatives J (one column per parameter).
///
/// The partial correlations maximise the restricted likelihood, which ignores what the parameters removed from the
/// residuals:  -2 ln L = (n - p_J) ln RSS + ln|P| + ln|JᵀP⁻¹J|,  with the scale maximised out. The order, at most 5,
/// minimises the Akaike criterion, -2 ln L + 2·order. Source: Patterson and Thompson 1971; Akaike 1974.
CorrelatedErrors likeliestErrors(const Eigen::VectorXd &r, const Eigen::MatrixXd &J, const std::vector<char> &isFirst);

} // namespace faintline
