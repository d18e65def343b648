#pragma once

#include "recording/FileBytes.h"
#include "spectrum/PowerFrames.h"

namespace faintline {

/// A sigproc filterbank (.fil): spectra of 1, 2, 4, 8, 16 (unsigned) or 32 bits (float), one after the other.
///
///   header   HEADER_START, then keywords with values, texts as a length of 32 bits and as many characters, to
///            HEADER_END
///   data     frames × IFs × channels; of 1, 2 and 4 bits the lowest come first
///
/// Channel i lies at fch1 + i·foff MHz; where foff is negative the channels are turned round, so that frequencies
/// ascend. The time of a frame is the middle of its tsamp seconds, tstart (MJD) the beginning of the first. IFs are the
/// channels of PowerInfo. A file that ends within a frame is read up to it, with a note. Source: sigproc (Lorimer),
/// read_header.c. Reads nothing but what is asked for; thread-safe.
class SigprocFile final : public PowerFrames
{
public:
    /// Throws Error where the header is cut short or says what cannot be.
    explicit SigprocFile(const std::string &path);

    void read(const PowerPart &part, std::span<float> out) const override;

    /// Whether a file begins as one.
    static bool recognises(const std::string &path);

private:
    void readRow(Index row, Index firstChannel, std::span<float> out) const;

    FileBytes m_file;
    Index m_dataOffset = 0;
    int m_bits = 8;
    bool m_isSigned = false;
    bool m_descends = false; ///< foff < 0: the file's first channel is the highest
};

} // namespace faintline
