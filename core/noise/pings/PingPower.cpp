#include "noise/pings/PingPower.h"

#include "base/logmath.h"
#include "noise/dither.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace faintline {

PingPower::PingPower(std::shared_ptr<const RawPings> pings, PingValues values)
    : m_pings(std::move(pings)), m_values(values)
{
    constexpr Index mostPings = 8;
    const Index count = m_pings->info().time.count;
    std::vector<double> some;
    for (Index i = 0; i < std::min(count, mostPings); ++i)
        for (const double power : powers(i, 1))
            if (power > 0.0)
                some.push_back(power);
    if (some.empty())
        return;
    const auto middle = some.begin() + std::ssize(some) / 2;
    std::nth_element(some.begin(), middle, some.end());
    m_unit = *middle;
}

double PingPower::powerOf(double value) const
{
    switch (m_values) {
    case PingValues::Magnitude:
        return value * value;
    case PingValues::Decibels:
        return ratioFromDb(value);
    case PingValues::Automatic:
    case PingValues::Normalised:
    case PingValues::Power:
        break;
    }
    return std::max(value, 0.0);
}

std::vector<double> PingPower::powers(Index first, Index count) const
{
    const PingsInfo &info = m_pings->info();
    const auto parts = std::size_t(info.isComplex ? 2 : 1);
    const auto cells = std::size_t(count * m_pings->cells());
    std::vector<double> values(parts * cells);
    m_pings->read(first, count, values);
    if (info.quantum > 0.0) {
        const std::uint64_t before = std::uint64_t(first) * std::uint64_t(m_pings->cells()) * parts;
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] += info.quantum * (double(uniformAt(before + i)) - 0.5);
    }
    std::vector<double> power(cells);
    for (std::size_t i = 0; i < cells; ++i) {
        const double p =
            info.isComplex ? values[2 * i] * values[2 * i] + values[2 * i + 1] * values[2 * i + 1] : powerOf(values[i]);
        power[i] = std::isfinite(p) ? p : std::numeric_limits<double>::quiet_NaN();
    }
    return power;
}

void PingPower::read(Index first, Index count, std::span<float> out) const
{
    const std::vector<double> power = powers(first, count);
    std::transform(power.begin(), power.end(), out.begin(), [this](double p) { return float(p / m_unit); });
}

} // namespace faintline
