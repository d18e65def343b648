#include "evaluate/reproduce/reproduceGrossi.h"

#include "evaluate/reproduce/grossiParts.h"

namespace faintline {

std::vector<Reproducible> grossiReproducibles()
{
    return {grossiStages(), grossiTrajectories(), grossiRadar()};
}

} // namespace faintline
