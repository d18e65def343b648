#pragma once

#include "base/Axis.h"

#include <vector>

namespace faintline {

/// A frequency over time: linear between equidistant knots, constant outside them.
class FrequencyCurve
{
public:
    /// `time`: knots, s; `hz`: one value per knot. Throws Error if there is none or one is not finite.
    FrequencyCurve(const Axis &time, std::vector<double> hz);

    const Axis &time() const { return m_time; }
    const std::vector<double> &hz() const { return m_hz; }
    double meanHz() const;

    double at(double seconds) const;
    /// ∫ f dt from the first knot, in cycles; negative before it. Exact for this curve.
    double cyclesAt(double seconds) const;
    /// Time at which the given number of cycles has passed: the inverse of cyclesAt. Precondition: all frequencies are
    /// positive.
    double secondsAt(double cycles) const;

private:
    Axis m_time;
    std::vector<double> m_hz;
    std::vector<double> m_cycles; ///< at each knot
};

} // namespace faintline
