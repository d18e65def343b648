#include "widgets/base/scaleTicks.h"

#include <qwt_scale_engine.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace faintline {

namespace {

    struct Step {
        double major;
        int minors; ///< parts
    };

    Step timeStep(double smallest)
    {
        if (smallest <= 5.0) {
            const double decade = std::pow(10.0, std::floor(std::log10(smallest)));
            for (const Step step : {Step{1.0, 5}, Step{2.0, 4}, Step{5.0, 5}, Step{10.0, 5}})
                if (step.major * decade >= smallest * (1.0 - 1e-9))
                    return {step.major * decade, step.minors};
        }
        for (const Step step : {Step{10, 5}, Step{15, 3}, Step{30, 3}, Step{60, 4}, Step{120, 4}, Step{300, 5},
                                Step{600, 5}, Step{900, 3}, Step{1800, 3}, Step{3600, 4}, Step{7200, 4}, Step{10800, 3},
                                Step{21600, 6}, Step{43200, 4}, Step{86400, 4}})
            if (step.major >= smallest)
                return step;
        return {std::ceil(smallest / 86400.0) * 86400.0, 4};
    }

} // namespace

double majorStep(const QwtScaleDiv &div)
{
    const QList<double> ticks = div.ticks(QwtScaleDiv::MajorTick);
    return ticks.size() > 1 ? std::abs(ticks[1] - ticks[0]) : std::max(std::abs(div.range()), 1e-12);
}

QwtScaleDiv timeScaleDiv(const Span &span, int majorTicks, double origin)
{
    if (span.isEmpty())
        return QwtScaleDiv(span.low, span.low + 1.0);
    const Step step = timeStep(span.width() / std::max(majorTicks, 1));
    QList<double> ticks[QwtScaleDiv::NTickTypes];
    const double minor = step.major / step.minors;
    const double slack = 1e-9 * step.major;
    constexpr double day = 86400.0;
    const double offset = std::fmod(origin, day);
    for (double i = std::ceil((span.low + offset - slack) / minor); i * minor - offset <= span.high + slack; ++i) {
        const bool isMajor = std::fmod(std::abs(i), step.minors) < 0.5;
        ticks[isMajor ? QwtScaleDiv::MajorTick : QwtScaleDiv::MinorTick] << i * minor - offset;
    }
    return QwtScaleDiv(span.low, span.high, ticks);
}

QwtScaleDiv linearScaleDiv(const Span &span, int majorTicks, double origin)
{
    if (origin != 0.0) {
        const QwtScaleDiv there = linearScaleDiv({span.low + origin, span.high + origin}, majorTicks);
        QList<double> ticks[QwtScaleDiv::NTickTypes];
        for (int type = 0; type < QwtScaleDiv::NTickTypes; ++type)
            for (const double tick : there.ticks(type))
                ticks[type] << tick - origin;
        return QwtScaleDiv(span.low, span.high, ticks);
    }
    // A single number does not define a scale: if there is room for two but steps are too wide, they are reduced; so they
    // are if there would be none.
    const auto divided = [&](int most) { return QwtLinearScaleEngine().divideScale(span.low, span.high, most, 5); };
    QwtScaleDiv div = divided(std::max(majorTicks, 1));
    if (div.ticks(QwtScaleDiv::MajorTick).size() < std::clamp(majorTicks, 1, 2))
        div = divided(majorTicks + 1);
    div.setInterval(span.low, span.high);
    return div;
}

QwtScaleDiv logarithmicScaleDiv(const Span &span, int majorTicks)
{
    const auto ticksAt = [&](std::initializer_list<int> digits) {
        QList<double> ticks;
        for (double exponent = std::floor(std::log10(span.low)); exponent <= std::log10(span.high); exponent += 1.0)
            for (const int digit : digits)
                if (const double value = digit * std::pow(10.0, exponent); span.contains(value))
                    ticks << value;
        return ticks;
    };
    QList<double> major = ticksAt({1, 2, 5});
    if (major.size() < 3)
        return linearScaleDiv(span, majorTicks);
    if (major.size() > majorTicks)
        major = ticksAt({1, 3});
    if (major.size() > majorTicks)
        major = ticksAt({1});
    return QwtScaleDiv(span.low, span.high, ticksAt({1, 2, 3, 4, 5, 6, 7, 8, 9}), {}, major);
}

QwtScaleDiv decadeScaleDiv(const Span &exponents, int most)
{
    const double low = std::ceil(exponents.low - 1e-9), high = std::floor(exponents.high + 1e-9);
    const double step = std::max(std::ceil((high - low) / std::max(most, 1)), 1.0);
    QList<double> ticks;
    for (double exponent = std::ceil(low / step) * step; exponent <= high + 1e-9; exponent += step)
        ticks << exponent;
    return QwtScaleDiv(exponents.low, exponents.high, {}, {}, ticks);
}

QwtScaleDiv digitScaleDiv(const Span &exponents)
{
    QList<double> major;
    QList<double> minor;
    for (double exponent = std::floor(exponents.low); exponent <= std::ceil(exponents.high); exponent += 1.0) {
        major << exponent;
        for (int digit = 2; digit <= 9; ++digit)
            minor << exponent + std::log10(digit);
    }
    return QwtScaleDiv(exponents.low, exponents.high, minor, {}, major);
}

} // namespace faintline
