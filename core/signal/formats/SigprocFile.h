#pragma once

#include "signal/FileBytes.h"
#include "signal/PowerFrames.h"
#include "signal/formats/Hdf5File.h"

#include <span>
#include <string>

namespace faintline {

/// Spectra of a filterbank, whose channels may lie in the file from the highest to the lowest.
///
/// Channel i lies at fch1 + i·foff MHz; if foff is negative the channels are reversed, so that frequencies ascend, in Hz.
/// The time of a frame is the middle of its tsamp seconds; tstart (MJD) is the beginning of the first one.
///
/// Channels that hold a receiver's DC offset are not observed (NaN), unless the part keeps them (hasDc): the middle one
/// of each coarse channel, in files of whole coarse channels of 2²⁰ channels, with a note. A file of another number was
/// cut out, and its middle is a channel like others.
class Filterbank : public PowerFrames
{
public:
    void read(const PowerPart &part, std::span<float> out) const final;

protected:
    /// What sigproc's header says of the axes, in its units.
    struct Header {
        double fch1 = 0.0;   ///< frequency of the first channel, MHz
        double foff = 0.0;   ///< between channels, MHz; negative if they descend
        double tsamp = 0.0;  ///< s
        double tstart = 0.0; ///< MJD of the beginning of the first spectrum; 0: unknown
        Index channels = 0;
        Index frames = 0;
    };

    /// Sets axes and start time. Throws Error naming the path of m_info and the invalid value.
    void setAxes(const Header &header);

    /// Reads channels of spectra of one IF in the file's order, from its channel `first` on.
    virtual void readStored(const PowerPart &part, Index first, std::span<float> out) const = 0;

private:
    void excludeDc(const PowerPart &part, std::span<float> out) const;

    bool m_descends = false; ///< foff < 0: the file's first channel is the highest
};

/// A sigproc filterbank (.fil): consecutive spectra of 1, 2, 4, 8, 16 (unsigned) or 32 bits (float).
///
///   header   HEADER_START, then keywords with values, texts as a 32-bit length and that many characters, up to
///            HEADER_END
///   data     frames × IFs × channels; for 1, 2 and 4 bits the lowest bits come first
///
/// IFs are the channels of PowerInfo. A file that ends within a frame is read up to that frame, with a note. Source:
/// sigproc (Lorimer), read_header.c. Reads only the requested part; thread-safe.
class SigprocFile final : public Filterbank
{
public:
    /// Throws Error if the header is truncated or invalid.
    explicit SigprocFile(const std::string &path);

    /// Whether a file begins with a sigproc header.
    static bool recognises(const std::string &path);

private:
    void readStored(const PowerPart &part, Index first, std::span<float> out) const override;
    void readRow(Index row, Index firstChannel, std::span<float> out) const;

    FileBytes m_file;
    Index m_dataOffset = 0;
    int m_bits = 8;
    bool m_isSigned = false;
};

/// A filterbank in HDF5 (.h5, as read by blimpy and turboSETI): a dataset "data" of shape (frames, IFs, channels) with
/// the attributes of a sigproc header: fch1, foff (MHz), tsamp (s), tstart (MJD).
///
/// Compressed data is unpacked chunk by chunk; at most 32 MiB of chunks are cached. Thread-safe.
class Hdf5Filterbank final : public Filterbank
{
public:
    /// Throws Error if the file has no such dataset or its attributes are invalid.
    explicit Hdf5Filterbank(const std::string &path);

    /// Whether an HDF5 file holds a dataset "data" with fch1.
    static bool recognises(const std::string &path);

private:
    void readStored(const PowerPart &part, Index first, std::span<float> out) const override;

    std::unique_ptr<Hdf5File> m_file;
    std::unique_ptr<Hdf5Dataset> m_data;
};

} // namespace faintline
