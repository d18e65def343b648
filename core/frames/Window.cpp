#include "frames/Window.h"

#include "base/logmath.h"

#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/sinc.hpp>
#include <boost/math/special_functions/sinhc.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>

namespace faintline {

namespace {

    constexpr double kaiserBeta = 14.0;

    /// aₖ of a cosine-sum window Σ aₖ cos(2πk t), |t| ≤ ½; empty for others.
    std::span<const double> cosinesOf(WindowShape shape)
    {
        static constexpr double rectangular[] = {1.0};
        static constexpr double hann[] = {0.5, 0.5};
        static constexpr double hamming[] = {0.54, 0.46};
        static constexpr double blackman[] = {0.42, 0.5, 0.08};
        static constexpr double blackmanHarris[] = {0.35875, 0.48829, 0.14128, 0.01168};
        switch (shape) {
        case WindowShape::Rectangular:
            return rectangular;
        case WindowShape::Hann:
            return hann;
        case WindowShape::Hamming:
            return hamming;
        case WindowShape::Blackman:
            return blackman;
        case WindowShape::BlackmanHarris:
            return blackmanHarris;
        case WindowShape::Kaiser:
            break;
        }
        return {};
    }

    double shapeAt(WindowShape shape, double fraction)
    {
        if (shape == WindowShape::Kaiser) {
            const double x = 2.0 * fraction - 1.0;
            return boost::math::cyl_bessel_i(0, kaiserBeta * std::sqrt(std::max(0.0, 1.0 - x * x)))
                   / boost::math::cyl_bessel_i(0, kaiserBeta);
        }
        const double phase = 2.0 * std::numbers::pi * fraction;
        double value = 0.0;
        double sign = 1.0;
        double k = 0.0;
        for (const double coefficient : cosinesOf(shape)) {
            value += sign * coefficient * std::cos(k * phase);
            sign = -sign;
            k += 1.0;
        }
        return value;
    }

    /// W(Δ)/W(0).
    double transformAt(WindowShape shape, double distance)
    {
        using std::numbers::pi;
        if (shape == WindowShape::Kaiser) {
            const double square = kaiserBeta * kaiserBeta - pi * pi * distance * distance;
            const double root = std::sqrt(std::abs(square));
            const double value = square > 0.0 ? boost::math::sinhc_pi(root) : boost::math::sinc_pi(root);
            return value / boost::math::sinhc_pi(kaiserBeta);
        }
        const std::span<const double> cosines = cosinesOf(shape);
        double value = 0.0;
        for (std::size_t k = 0; k < cosines.size(); ++k)
            value += 0.5 * cosines[k]
                     * (boost::math::sinc_pi(pi * (distance - double(k)))
                        + boost::math::sinc_pi(pi * (distance + double(k))));
        return value / cosines.front();
    }

    struct Leakage {
        double halfWidthCells;
        double mainLobeDb; ///< -Δ² times this many dB bounds the main lobe: its curvature at the peak
        double highestSideLobeDb;
        double tailDb;          ///< side lobes stay below this line at the half width …
        double fallDbPerOctave; ///< … which falls with this slope
    };

    // From the windows' transforms, sin(πΔ)/π · Σₖ (-1)ᵏ (aₖ/a₀) Δ/(Δ² - k²), rounded up.
    Leakage leakage(WindowShape shape)
    {
        switch (shape) {
        case WindowShape::Rectangular:
            return {1.0, 14.28, -13.2, -9.9, 6.0};
        case WindowShape::Hann:
            return {2.0, 5.60, -31.4, -26.4, 18.0};
        case WindowShape::Hamming:
            return {2.0, 6.88, -42.6, -32.6, 6.0};
        case WindowShape::Blackman:
            return {3.0, 4.36, -58.1, -46.1, 18.0};
        case WindowShape::BlackmanHarris:
            return {4.0, 3.28, -92.0, -87.6, 6.0};
        case WindowShape::Kaiser:
            return {std::hypot(1.0, kaiserBeta / std::numbers::pi), 2.84, -105.0, -105.0, 6.0};
        }
        return {1.0, 0.0, 0.0, 0.0, 0.0};
    }

} // namespace

std::vector<float> sampleWindow(WindowShape shape, int length)
{
    std::vector<double> window(static_cast<std::size_t>(length));
    double energy = 0.0;
    for (int n = 0; n < length; ++n) {
        // Symmetric about the middle sample pair, so that a single sample is not zero.
        const double value = shapeAt(shape, (n + 0.5) / length);
        window[std::size_t(n)] = value;
        energy += value * value;
    }
    std::vector<float> scaled(window.size());
    for (std::size_t n = 0; n < window.size(); ++n)
        scaled[n] = float(window[n] / std::sqrt(energy));
    return scaled;
}

double cellLikeness(const std::vector<float> &window)
{
    double fourth = 0.0;
    for (const float w : window)
        fourth += std::pow(double(w), 4.0);
    return fourth * double(window.size());
}

double overlapFactor(const std::vector<float> &window, int steps)
{
    double likenesses = 1.0;
    for (std::ptrdiff_t shift = 1; shift < steps; ++shift) {
        const std::ptrdiff_t lag = shift * std::ssize(window) / steps;
        const double product = std::inner_product(window.begin() + lag, window.end(), window.begin(), 0.0);
        likenesses += 2.0 * product * product;
    }
    return std::sqrt(likenesses);
}

double noiseBandwidthCells(WindowShape shape)
{
    constexpr int length = 4096; // of unit energy; long enough for any shape's sum to have converged
    const std::vector<float> window = sampleWindow(shape, length);
    const double sum = std::accumulate(window.begin(), window.end(), 0.0);
    return length / (sum * sum);
}

double mainLobeHalfWidth(WindowShape shape)
{
    return leakage(shape).halfWidthCells;
}

double leakageBound(WindowShape shape, double distanceCells)
{
    const Leakage l = leakage(shape);
    const double distance = std::max(distanceCells, 0.0);
    double db = l.highestSideLobeDb;
    if (distance < l.halfWidthCells)
        db = std::max(db, -l.mainLobeDb * distance * distance);
    else
        db = std::min(db, l.tailDb - l.fallDbPerOctave * std::log2(distance / l.halfWidthCells));
    return ratioFromDb(db);
}

double leakageAt(WindowShape shape, double distanceCells)
{
    const double distance = std::abs(distanceCells);
    if (distance > mainLobeHalfWidth(shape) + 1.0)
        return leakageBound(shape, distance);
    const double transform = transformAt(shape, distance);
    return transform * transform;
}

} // namespace faintline
