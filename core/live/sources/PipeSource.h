#pragma once

#include "live/sources/SampleSource.h"

#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <string>

namespace faintline {

/// Header of a piped WAV stream. Supports RIFF and RF64, integers of 8, 16, 24 and 32 bits, and floats of 32 and 64
/// bits.
struct WavHeader {
    StreamFormat format; ///< 24-bit integers appear as 32-bit, by `expand24`
    bool isPacked24 = false;
    Index dataBytes = 0; ///< length of the samples as declared; 0 or the largest number: unknown
    bool isRf64 = false; ///< with a length of more than 32 bits
};

/// Finds the end of the samples in a WAV stream, as a file's is found (behindSamples): at the declared length if a
/// chunk or nothing follows it.
class WavSamples
{
public:
    explicit WavSamples(const WavHeader &header);

    /// Takes the next bytes of the stream and returns those that are known to be samples. `isOver`: the stream has
    /// ended.
    std::vector<std::byte> take(std::vector<std::byte> bytes, bool isOver);

private:
    Index m_left;     ///< bytes until the declared end
    bool m_isEndless; ///< no further end is declared
    bool m_isRf64;
    bool m_isOdd;
    bool m_isBehind = false;       ///< the samples have ended
    std::vector<std::byte> m_held; ///< behind the declared end, of which it is not known yet what they are
};

/// Reads up to the first sample. `read` fills the whole span, or returns false at the end of the stream. Throws
/// Error{where, what is wrong and what would be accepted}.
WavHeader readWavHeader(const std::function<bool(std::span<std::byte>)> &read, const std::string &where);

/// Converts 24-bit little-endian integers to 32-bit, three bytes to four; values relative to full scale stay the same.
std::vector<std::byte> expand24(std::span<const std::byte> bytes);

/// Reads standard input ("-"), a FIFO or a file to its end, which for a FIFO is when its last writer closes it.
///
/// The stream has a WAV header, or is raw samples of a known format. Chunks behind the samples of a WAV stream are
/// skipped (WavSamples). An incomplete last sample is dropped.
class PipeSource final : public SampleSource
{
public:
    /// `raw`: format of raw samples. If empty, waits for a WAV header until it is complete or `stop` is requested
    /// (Cancelled). Throws Error.
    PipeSource(const std::string &path, const std::optional<StreamFormat> &raw, const std::stop_token &stop = {});
    ~PipeSource() override;
    PipeSource(const PipeSource &) = delete;
    PipeSource &operator=(const PipeSource &) = delete;

    const StreamFormat &format() const override { return m_format; }
    Heard hear(std::chrono::milliseconds patience) override;
    bool isPatient() const override { return true; }

private:
    std::ptrdiff_t readSome(std::span<std::byte> bytes, std::chrono::milliseconds patience);

    std::string m_path;
    int m_descriptor = -1;
    bool m_isOwned = false;
    bool m_isPacked24 = false;
    StreamFormat m_format;
    std::optional<WavSamples> m_samples; ///< of a WAV stream
    std::vector<std::byte> m_rest;       ///< of an incomplete sample
};

} // namespace faintline
