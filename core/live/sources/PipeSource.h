#pragma once

#include "live/sources/SampleSource.h"
#include "live/sources/wavHeader.h"

#include <optional>
#include <span>
#include <stop_token>
#include <string>

namespace faintline {

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
