#pragma once

#include "live/SampleSource.h"

#include <optional>
#include <span>
#include <stop_token>
#include <string>

namespace faintline {

/// Standard input ("-"), a FIFO or any file, from its beginning to its end, which comes when its last writer closes it.
///
/// With a WAV header of any length, or bare samples of a format that is known. A last sample that is cut in the middle
/// is left out.
class PipeSource final : public SampleSource
{
public:
    /// `raw`: the format of bare samples; none: a WAV header comes first, and is waited for until it is there or `stop`
    /// is asked for (Cancelled). Throws Error.
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
    std::vector<std::byte> m_rest; ///< of a sample that is not whole yet
};

} // namespace faintline
