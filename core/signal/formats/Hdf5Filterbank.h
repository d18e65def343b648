#pragma once

#include "signal/PowerFrames.h"
#include "signal/formats/Hdf5File.h"

namespace faintline {

/// A filterbank in HDF5 (.h5, as read by blimpy and turboSETI): a dataset "data" of shape (frames, IFs, channels) with
/// the attributes of a sigproc header: fch1, foff (MHz), tsamp (s), tstart (MJD).
///
/// Axes, time and notes are as for SigprocFile. Compressed data is unpacked chunk by chunk; at most 32 MiB of chunks
/// are cached. Thread-safe.
class Hdf5Filterbank final : public PowerFrames
{
public:
    /// Throws Error if the file has no such dataset or its attributes are invalid.
    explicit Hdf5Filterbank(const std::string &path);

    void read(const PowerPart &part, std::span<float> out) const override;

    /// Whether an HDF5 file holds a dataset "data" with fch1.
    static bool recognises(const std::string &path);

private:
    std::unique_ptr<Hdf5File> m_file;
    std::unique_ptr<Hdf5Dataset> m_data;
    bool m_descends = false;
};

} // namespace faintline
