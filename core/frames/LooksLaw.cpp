#include "frames/LooksLaw.h"

#include <boost/math/special_functions/gamma.hpp>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr double tableLowest = -8.0;
    constexpr double tableStep = 1.0 / 64.0;
    constexpr double tableHighest = 36.0;
    constexpr double preciseProbability = 1e-290; ///< smallest probability with full precision

} // namespace

double LooksLaw::quantile(double looks, double p)
{
    return boost::math::gamma_p_inv(looks, p) / looks;
}

LooksLaw::LooksLaw(double looks, double median)
    : m_looks(looks), m_median(float(median)), m_scale(float(quantile(looks, 0.5) / median)),
      m_centre(float(1.0 - 1.0 / (9.0 * looks))), m_spread(float(std::sqrt(9.0 * looks)))
{
    for (double z = tableLowest; z <= tableHighest; z += tableStep) {
        const double root = std::max(0.0, double(m_centre) + z / double(m_spread));
        const double q = boost::math::gamma_q(looks, looks * root * root * root);
        if (!(q > preciseProbability))
            break; // extrapolated beyond this with the last step
        m_table.push_back(float(-std::log(q)));
    }
}

float LooksLaw::operator()(float ratio) const
{
    const float z = (std::cbrt(ratio * m_scale) - m_centre) * m_spread;
    const float place = std::max(0.0f, (z - float(tableLowest)) / float(tableStep));
    const auto last = m_table.size() - 2;
    const std::size_t lower = place < float(last) ? std::size_t(place) : last;
    return m_table[lower] + (place - float(lower)) * (m_table[lower + 1] - m_table[lower]);
}

LooksLaw LooksLaw::fromQuantiles(double low, double middle, double high)
{
    const double spread = (high - low) / middle;
    double least = std::log(0.3);
    double most = std::log(1e6);
    constexpr int halvings = 40;
    for (int i = 0; i < halvings; ++i) {
        const double looks = std::exp(0.5 * (least + most));
        const double own = (quantile(looks, 0.84) - quantile(looks, 0.16)) / quantile(looks, 0.5);
        (own > spread ? least : most) = 0.5 * (least + most);
    }
    return LooksLaw(std::exp(0.5 * (least + most)), middle);
}

} // namespace faintline
