#pragma once

#include "base/Grid.h"

#include <array>
#include <span>
#include <string>
#include <string_view>

namespace faintline {

/// What the numbers of recorded pings are. Complex numbers, I and Q of a beam, need no such statement.
enum class PingValues {
    Automatic,  ///< as the file's grid says; otherwise guessed (guessPingValues)
    Normalised, ///< power over noise power already
    Power,
    Magnitude, ///< envelope: the root of the power
    Decibels   ///< 10 log10 of the power
};
inline constexpr std::array<std::string_view, 5> pingValuesNames{"auto", "normalised", "power", "magnitude",
                                                                 "decibels"};

/// Properties of recorded pings that are known without reading their values.
struct PingsInfo {
    std::string path;
    std::string container;                     ///< "NumPy pings", "HDF5 pings"
    std::string sampleType;                    ///< "int16", "complex64" …
    Axis time;                                 ///< of the pings, s
    Grid grid;                                 ///< of a ping: several axes, one of them range
    bool isComplex = false;                    ///< two numbers per cell, I and Q
    double quantum = 0.0;                      ///< step between the values of integers, else 0
    PingValues stated = PingValues::Automatic; ///< by the file or its grid
};

/// Pings, or other frames on several axes, in the file's own numbers: not normalised. Detectors need them normalised
/// (NormalisedPings). Random access; files may be larger than memory. Thread-safe.
class RawPings
{
public:
    virtual ~RawPings() = default;

    const PingsInfo &info() const { return m_info; }

    Index cells() const { return m_info.grid.size(); }

    /// Writes the numbers of pings first … first+count-1, one per cell, or two if complex. Throws Error if reading the
    /// file fails.
    virtual void read(Index first, Index count, std::span<double> out) const = 0;

protected:
    PingsInfo m_info;
};

} // namespace faintline
