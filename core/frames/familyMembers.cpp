#include "frames/familyMembers.h"

#include "frames/familyLaw.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline {

std::vector<Index> memberBins(const FamilySettings &settings, double hz, const Axis &band, bool hasRealEnds)
{
    const Index first = settings.firstBin(hasRealEnds);
    const Index last = band.count - 1 - first;
    std::vector<Index> bins;
    for (const double member : memberFrequencies(familyOrLine(settings), hz)) {
        const Index bin = std::lround(band.position(member));
        bins.push_back(bin >= first && bin <= last ? bin : -1);
    }
    return bins;
}

namespace {

    float powerTogether(std::span<const float> values)
    {
        float sum = 0.0f;
        std::size_t count = 0;
        for (const float y : values)
            if (!std::isnan(y)) {
                sum += y;
                ++count;
            }
        if (count == 0)
            return std::numeric_limits<float>::quiet_NaN();
        return count == 1 ? sum : powerOfSum(sum, count);
    }

} // namespace

float familyPower(FamilySettings::Present present, std::span<const float> members, std::size_t channels)
{
    if (present == FamilySettings::Present::Together)
        return powerTogether(members);
    float largest = 0.0f;
    std::size_t count = 0;
    for (; !members.empty(); members = members.subspan(channels))
        if (const float y = powerTogether(members.first(channels)); !std::isnan(y)) {
            largest = std::max(largest, y);
            ++count;
        }
    if (count == 0)
        return std::numeric_limits<float>::quiet_NaN();
    return count == 1 ? largest : powerOfLargest(largest, count);
}

std::string memberName(const FamilySettings &settings, double member)
{
    if (settings.relation == FamilySettings::Relation::Harmonics)
        return formatNumber(member) + "×";
    const std::string hz = formatNumber(member) + " Hz";
    return member > 0.0 ? '+' + hz : hz;
}

} // namespace faintline
