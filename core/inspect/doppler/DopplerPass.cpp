#include "inspect/doppler/DopplerPass.h"

#include <cmath>

namespace faintline {

double emissionSeconds(const DopplerPass &pass, double propagation, double seconds)
{
    const double beta = pass.metresPerSecond / propagation;
    const double delay = pass.rangeMetres / propagation;
    const double sinceClosest = seconds - pass.closestSeconds;
    const double rest = 1.0 - beta * beta;
    return (sinceClosest - std::sqrt(beta * beta * sinceClosest * sinceClosest + rest * delay * delay)) / rest;
}

double receivedHz(const DopplerPass &pass, double propagation, double seconds)
{
    const double v = pass.metresPerSecond;
    const double sent = emissionSeconds(pass, propagation, seconds);
    return pass.restHz / (1.0 + v * v * sent / (propagation * std::hypot(pass.rangeMetres, v * sent)));
}

} // namespace faintline
