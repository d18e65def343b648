#include "evaluate/peers.h"

#include "base/Error.h"

namespace faintline {

namespace {

    Contestant contestant(const char *name, const DetectorSettings &detector)
    {
        Contestant result{name, {}};
        result.settings.model = laws::billon();
        result.settings.detector = detector;
        return result;
    }

} // namespace

std::vector<Contestant> peers(double durationWindows)
{
    std::vector<Contestant> list{
        contestant("SMD 5 slopes", SmdSettings()),
        contestant("SMD stable", SmdSettings()),
        contestant("3 of 4", PofNSettings{3, 4}),
        contestant("6 of 8", PofNSettings{6, 8}),
        contestant("integrator", IntegratorSettings{IntegratorSettings::Shape::Boxcar, durationWindows}),
        contestant("energy", EnergySettings()),
        contestant("block Viterbi", BlockViterbiSettings{durationWindows}),
    };
    list[1].settings.model = laws::steady();
    return list;
}

Contestant peer(std::string_view name, double durationWindows)
{
    std::string names;
    for (const Contestant &one : peers(durationWindows)) {
        if (one.name == name)
            return one;
        names += (names.empty() ? "" : ", ") + one.name;
    }
    throw Error("detector " + std::string(name), "is not known; there are " + names);
}

} // namespace faintline
