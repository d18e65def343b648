#pragma once

#include <vector>

namespace faintline {

/// Transforms power that is the mean of K looks at noise to the distribution of one look, for which detectors are
/// designed.
///
///   p/B ~ Gamma(K)/K,   y = -ln Q(K, K·p/B)
///
/// Q: regularised upper incomplete gamma function. y is exponential of mean 1 on noise and increases with p; K = 1
/// changes nothing. `median` is the measured median of p/B on noise; it replaces that of the gamma law and removes the
/// remaining bias of B. Uses a table over Wilson and Hilferty's cube root, |error| ≤ 1e-3 relative. Oracle: Boost.Math.
class LooksLaw
{
public:
    LooksLaw(double looks, double median);

    double looks() const { return m_looks; }
    float median() const { return m_median; }
    float operator()(float ratio) const;

    /// K and the median of noise whose 16, 50 and 84 % quantiles are the given values; 0.3 ≤ K ≤ 1e6.
    static LooksLaw fromQuantiles(double low, double middle, double high);

    /// The value that a share p of the means of K looks does not exceed, the mean being 1.
    static double quantile(double looks, double p);

private:
    double m_looks;
    float m_median;
    float m_scale;  ///< scale of a ratio
    float m_centre; ///< centre of its cube root
    float m_spread;
    std::vector<float> m_table;
};

} // namespace faintline
