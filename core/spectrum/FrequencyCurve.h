#pragma once

#include "base/Axis.h"

#include <vector>

namespace faintline {

/// A frequency over time: linear between equidistant knots, constant before the first and after the last.
class FrequencyCurve
{
public:
    /// `time`: of the knots, s; `hz`: one value a knot. Throws Error where there is none, or one that is not finite.
    FrequencyCurve(const Axis &time, std::vector<double> hz);

    const Axis &time() const { return m_time; }
    const std::vector<double> &hz() const { return m_hz; }
    double meanHz() const;

    double at(double seconds) const;
    /// ∫ f dt from the first knot on: whole turns and their fraction, negative before it. Exact for this curve.
    double cyclesAt(double seconds) const;
    /// When so many turns have passed: the inverse of cyclesAt. Precondition: all frequencies lie above 0.
    double secondsAt(double cycles) const;

private:
    Axis m_time;
    std::vector<double> m_hz;
    std::vector<double> m_cycles; ///< at every knot
};

} // namespace faintline
