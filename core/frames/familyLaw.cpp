#include "frames/familyLaw.h"

#include "frames/LooksLaw.h"

#include <array>
#include <cmath>
#include <mutex>
#include <optional>

namespace faintline {

namespace {

    constexpr float singlePrecisionNats =
        12.0f; ///< beyond this maximum, 1 - (1 - e^-m)^K is K·e^-m to single precision

    LooksLaw sumLaw(std::size_t members)
    {
        const auto looks = double(members);
        return {looks, LooksLaw::quantile(looks, 0.5)};
    }

} // namespace

const LooksLaw &lawOfSum(std::size_t members)
{
    struct SumLawTable {
        std::once_flag isMade;
        std::optional<LooksLaw> law; // a table, computed on first use
    };
    static std::array<SumLawTable, mostSummed> laws;
    SumLawTable &law = laws[members - 1];
    std::call_once(law.isMade, [&] { law.law = sumLaw(members); });
    return *law.law;
}

float powerOfSum(float sum, std::size_t members)
{
    return lawOfSum(members)(sum / float(members));
}

float powerOfLargest(float maximum, std::size_t members)
{
    const auto K = float(members);
    if (maximum > singlePrecisionNats)
        return maximum - std::log(K);
    return -std::log(-std::expm1(K * std::log1p(-std::exp(-maximum))));
}

} // namespace faintline
