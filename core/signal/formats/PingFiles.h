#pragma once

#include "signal/FileBytes.h"
#include "signal/RawPings.h"
#include "signal/formats/Hdf5File.h"
#include "signal/formats/NumPy.h"

namespace faintline {

/// Recorded pings in a file whose axes and scale are stated by a grid file.
class PingFile : public RawPings
{
protected:
    /// What both files say of numbers of a type. `gridPath` may be empty: axes without units. Throws Error if the shape
    /// and the grid do not match.
    void describe(const std::string &path, const std::string &gridPath, const std::vector<Index> &shape, bool isComplex,
                  bool isInteger);

    double m_scale = 1.0;
    double m_offset = 0.0;
};

/// Recorded pings in a NumPy file of shape (pings, cells…):
///
///   integers of 8, 16 or 32 bits, signed or not; float32, float64; complex64, complex128
///   the same real types with a last axis of two, I and Q, if the grid says "values": "iq"
///
/// The file may be larger than memory. Thread-safe.
class NumPyPings final : public PingFile
{
public:
    /// Throws Error if one of the files is damaged or they do not match.
    NumPyPings(const std::string &path, const std::string &gridPath);

    void read(Index first, Index count, std::span<double> out) const override;

private:
    FileBytes m_file;
    NumPyHeader m_header;
};

/// Recorded pings in HDF5: a dataset "pings" of shape (pings, cells…), integers, floats, or pairs "r" and "i".
/// Compressed data is unpacked chunk by chunk. Thread-safe.
class Hdf5Pings final : public PingFile
{
public:
    /// Throws Error if one of the files is damaged or they do not match.
    Hdf5Pings(const std::string &path, const std::string &gridPath);

    void read(Index first, Index count, std::span<double> out) const override;

    /// Whether an HDF5 file holds a dataset "pings".
    static bool recognises(const std::string &path);

private:
    std::unique_ptr<Hdf5File> m_file;
    std::unique_ptr<Hdf5Dataset> m_data;
};

} // namespace faintline
