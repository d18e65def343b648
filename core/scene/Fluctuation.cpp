#include "scene/Fluctuation.h"

namespace faintline {

double relativePower(Fluctuation fluctuation, Random &random)
{
    switch (fluctuation) {
    case Fluctuation::None:
        break;
    case Fluctuation::Swerling1:
    case Fluctuation::Swerling2:
        return random.exponential();
    case Fluctuation::Swerling3:
    case Fluctuation::Swerling4: {
        const double first = random.exponential();
        return 0.5 * (first + random.exponential());
    }
    }
    return 1.0;
}

} // namespace faintline
