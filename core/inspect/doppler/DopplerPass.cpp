#include "inspect/doppler/DopplerPass.h"

#include "base/numberText.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

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

namespace {

    constexpr double suspiciousScale = 3.0;
    constexpr double fewPoints = 10.0;

    /// Four digits exceed the accuracy of all these numbers.
    std::string shown(double value)
    {
        char digits[32];
        std::snprintf(digits, sizeof digits, "%.4g", value);
        return digits;
    }

    /// Least-squares slope of the points in the fit divided by its standard error.
    double riseInErrors(const DopplerFit &fit, const std::vector<DopplerPoint> &points)
    {
        double n = 0.0, t = 0.0, f = 0.0, tt = 0.0, tf = 0.0, ff = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (fit.isLeftOut[i])
                continue;
            const double seconds = points[i].seconds - points.front().seconds;
            const double hz = points[i].hz - points.front().hz;
            n += 1.0;
            t += seconds;
            f += hz;
            tt += seconds * seconds;
            tf += seconds * hz;
            ff += hz * hz;
        }
        const double varianceT = tt - t * t / n;
        const double slope = (tf - t * f / n) / varianceT;
        const double rest = std::max(1e-300, ff - f * f / n - slope * slope * varianceT);
        return slope / std::sqrt(rest / ((n - 2.0) * varianceT));
    }

    /// Position of the closest approach as heard, over its whole interval, relative to the track's time.
    struct HeardApproach {
        bool mayBeBefore, mayBeIn, mayBeAfter;

        HeardApproach(const DopplerFit &fit, const std::vector<DopplerPoint> &points)
        {
            const double delay = fit.heardSeconds() - fit.pass.closestSeconds;
            const double first = points.front().seconds - delay;
            const double last = points.back().seconds - delay;
            const DopplerBounds &closest = fit.closestSeconds;
            mayBeBefore = !closest.low || *closest.low < first;
            mayBeAfter = !closest.high || *closest.high > last;
            mayBeIn = (!closest.low || *closest.low <= last) && (!closest.high || *closest.high >= first);
        }
        bool isSurelyIn() const { return !mayBeBefore && !mayBeAfter; }
    };

    std::string whereNotSeen(const HeardApproach &heard, const DopplerFit &fit)
    {
        const double beta = fit.pass.metresPerSecond / fit.propagation;
        if (!heard.mayBeIn && heard.mayBeAfter)
            return "The source was still approaching; only f0/(1 - v/c), about "
                   + formatToStep(fit.pass.restHz / (1.0 - beta), fit.rmsHz, 4) + " Hz, is determined.";
        if (!heard.mayBeIn)
            return "The source was already going away; only f0/(1 + v/c), about "
                   + formatToStep(fit.pass.restHz / (1.0 + beta), fit.rmsHz, 4) + " Hz, is determined.";
        if (!heard.mayBeBefore)
            return "It may be later: the source may still have been approaching.";
        if (!heard.mayBeAfter)
            return "It may be earlier: the source may already have been going away.";
        return "It may be earlier or later.";
    }

    /// v²/R of a slow source from the mean slope of the fitted curve, known from a linear fall.
    std::string accelerationText(const DopplerFit &fit, const std::vector<DopplerPoint> &points)
    {
        const double first = receivedHz(fit.pass, fit.propagation, points.front().seconds);
        const double last = receivedHz(fit.pass, fit.propagation, points.back().seconds);
        const double slope = (last - first) / (points.back().seconds - points.front().seconds);
        return shown(-slope * fit.propagation / (0.5 * (first + last))) + " m/s²";
    }

    void addOpen(std::vector<std::string> &sentences, const DopplerFit &fit, const std::vector<DopplerPoint> &points)
    {
        if (!fit.metresPerSecond.low) {
            sentences.emplace_back(
                "No Doppler shift exceeds the errors: the frequency is constant, as that of a source at rest.");
            return;
        }
        if (!fit.isBent)
            sentences.emplace_back("A straight line fits the track nearly as well as a pass; the intervals are widened "
                                   "accordingly, and the estimates are of little use.");
        const HeardApproach heard(fit, points);
        if (!heard.isSurelyIn())
            sentences.emplace_back(
                "The closest approach may lie outside the track, so rest frequency, speed and range cannot be "
                "determined separately. "
                + whereNotSeen(heard, fit));
        if (heard.mayBeIn && !fit.metresPerSecond.high)
            sentences.emplace_back(
                "Speed and range cannot be determined separately, because the track ends before the frequency "
                "levels off: for a slow source only v²/R, about "
                + accelerationText(fit, points) + ", is determined.");
        else if (!fit.metresPerSecond.high)
            sentences.emplace_back("The speed has no upper limit below the speed of propagation.");
        if (fit.metresPerSecond.high && !fit.rangeMetres.high)
            sentences.emplace_back("The range has no upper limit.");
        if (!fit.rangeMetres.low)
            sentences.emplace_back(
                "The range has no lower limit: the frequency changes faster than the track resolves.");
    }

    void addDoubts(std::vector<std::string> &sentences, const DopplerFit &fit)
    {
        if (fit.deviationScale > suspiciousScale)
            sentences.emplace_back("The residuals are " + shown(fit.deviationScale)
                                   + " times as large as the track's own errors: the source may not have moved on a "
                                     "straight line at constant speed.");
        if (fit.effectivePoints < fewPoints)
            sentences.emplace_back("The residuals keep their sign for long stretches; the track counts as "
                                   + shown(fit.effectivePoints)
                                   + " independent points. A source that turns or changes its speed causes this.");
        const auto count = std::count(fit.isLeftOut.begin(), fit.isLeftOut.end(), char(1));
        if (count > 0)
            sentences.emplace_back("Points left out because they lie more than four standard deviations off: "
                                   + std::to_string(count) + " of " + std::to_string(fit.isLeftOut.size()) + ".");
    }

} // namespace

std::vector<std::string> dopplerSentences(const DopplerFit &fit, const std::vector<DopplerPoint> &points)
{
    std::vector<std::string> sentences;
    constexpr double sureDeviations = 6.0;
    if (riseInErrors(fit, points) > sureDeviations)
        sentences.emplace_back(
            "The frequency rises, but that of a source passing at constant speed only falls. The numbers do "
            "not describe a pass.");
    addOpen(sentences, fit, points);
    addDoubts(sentences, fit);
    sentences.emplace_back("Speed and range are in proportion to the speed of propagation, " + shown(fit.propagation)
                           + " m/s here.");
    sentences.emplace_back(
        "One sensor cannot tell on which side the source passed, its course, or how much of the range "
        "is height or depth.");
    return sentences;
}

} // namespace faintline
