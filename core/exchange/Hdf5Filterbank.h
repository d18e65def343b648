#pragma once

#include "recording/Hdf5File.h"
#include "spectrum/PowerFrames.h"

namespace faintline {

/// A filterbank in HDF5 (.h5, as blimpy and turboSETI read it): a dataset "data" of shape (frames, IFs, channels) with
/// the attributes of a sigproc header: fch1, foff (MHz), tsamp (s), tstart (MJD).
///
/// Axes, time and notes as of SigprocFile. Packed data is unpacked chunk by chunk, with at most 32 MiB of chunks kept.
/// Thread-safe.
class Hdf5Filterbank final : public PowerFrames
{
public:
    /// Throws Error where the file holds no such dataset, or says of it what cannot be.
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
