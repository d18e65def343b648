#include "evaluate/experiments/peers.h"

#include "base/Error.h"
#include "base/oneLine.h"

#include <algorithm>

namespace faintline {

namespace {

    DetectorUnderTest detectorUnderTest(const char *name, const DetectorSettings &detector)
    {
        DetectorUnderTest result{name, {}};
        result.settings.model = laws::billon();
        result.settings.detector = detector;
        return result;
    }

} // namespace

std::vector<DetectorUnderTest> peers(double durationWindows)
{
    std::vector<DetectorUnderTest> list{
        detectorUnderTest("SMD 5 slopes", SmdSettings()),
        detectorUnderTest("SMD stable", SmdSettings()),
        detectorUnderTest("3 of 4", PofNSettings{3, 4}),
        detectorUnderTest("6 of 8", PofNSettings{6, 8}),
        detectorUnderTest("integrator", IntegratorSettings{IntegratorSettings::Shape::Boxcar, durationWindows}),
        detectorUnderTest("energy", EnergySettings()),
        detectorUnderTest("block Viterbi", BlockViterbiSettings{durationWindows}),
    };
    list[1].settings.model = laws::steady();
    return list;
}

DetectorUnderTest peer(std::string_view name, double durationWindows)
{
    const std::vector<DetectorUnderTest> all = peers(durationWindows);
    const auto found = std::ranges::find(all, name, &DetectorUnderTest::name);
    if (found == all.end())
        throw Error("detector " + std::string(name), "unknown; choose one of " + listed(all, &DetectorUnderTest::name));
    return *found;
}

} // namespace faintline
