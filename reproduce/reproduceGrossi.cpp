#include "reproduce/reproduceGrossi.h"

#include "reproduce/grossiParts.h"

namespace faintline {

std::vector<Reproducible> grossiReproducibles()
{
    return {grossiStages(), grossiTrajectories(), grossiRadar()};
}

} // namespace faintline
