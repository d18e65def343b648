#pragma once

#include "signal/RawPings.h"
#include "signal/formats/Hdf5File.h"

namespace faintline {

/// Recorded pings in HDF5: a dataset "pings" of shape (pings, cells…), integers, floats, or pairs "r" and "i", with
/// axes from a grid file. Compressed data is unpacked chunk by chunk. Thread-safe.
class Hdf5Pings final : public RawPings
{
public:
    /// `gridPath` may be empty: axes without units. Throws Error if one of the files is damaged or they do not match.
    Hdf5Pings(const std::string &path, const std::string &gridPath);

    void read(Index first, Index count, std::span<double> out) const override;

    /// Whether an HDF5 file holds a dataset "pings".
    static bool recognises(const std::string &path);

private:
    std::unique_ptr<Hdf5File> m_file;
    std::unique_ptr<Hdf5Dataset> m_data;
    double m_scale = 1.0;
    double m_offset = 0.0;
};

} // namespace faintline
