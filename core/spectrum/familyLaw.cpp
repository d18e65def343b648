#include "spectrum/familyLaw.h"

#include "spectrum/NormalisedPower.h"

#include <boost/math/special_functions/gamma.hpp>

#include <cmath>
#include <vector>

namespace faintline {

namespace {

    constexpr float exact = 12.0f; ///< beyond this maximum, 1 - (1 - e^-m)^K is K·e^-m to single precision

    LooksLaw sumLaw(std::size_t members)
    {
        const auto looks = double(members);
        return {looks, boost::math::gamma_p_inv(looks, 0.5) / looks};
    }

    const LooksLaw &sumLawOf(std::size_t members)
    {
        static const std::vector<LooksLaw> laws = [] {
            std::vector<LooksLaw> all;
            for (std::size_t i = 1; i <= mostMembers; ++i)
                all.push_back(sumLaw(i));
            return all;
        }();
        return laws[members - 1];
    }

} // namespace

float powerOfSum(float sum, std::size_t members)
{
    return sumLawOf(members)(sum / float(members));
}

float powerOfLargest(float maximum, std::size_t members)
{
    const auto K = float(members);
    if (maximum > exact)
        return maximum - std::log(K);
    return -std::log(-std::expm1(K * std::log1p(-std::exp(-maximum))));
}

} // namespace faintline
