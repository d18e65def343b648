#pragma once

#include "signal/FileBytes.h"
#include "signal/RawPings.h"
#include "signal/formats/NumPy.h"

namespace faintline {

/// Recorded pings in a NumPy file of shape (pings, cells…), with axes from a grid file:
///
///   integers of 8, 16 or 32 bits, signed or not; float32, float64; complex64, complex128
///   the same real types with a last axis of two, I and Q, if the grid says "values": "iq"
///
/// The file may be larger than memory. Thread-safe.
class NumPyPings final : public RawPings
{
public:
    /// `gridPath` may be empty: axes without units. Throws Error if one of the files is damaged or they do not match.
    NumPyPings(const std::string &path, const std::string &gridPath);

    void read(Index first, Index count, std::span<double> out) const override;

private:
    FileBytes m_file;
    NumPyHeader m_header;
    double m_scale = 1.0;
    double m_offset = 0.0;
};

} // namespace faintline
