#pragma once

#include "live/StreamBuffer.h"
#include "signal/Recording.h"

#include <memory>
#include <optional>

namespace faintline {

/// A buffer's stream as a recording; released samples read as 0.
///
/// Its length is `endlessSamples` unless the stream ended before construction. Floats are assumed to lie within 2^±30.
class StreamRecording final : public Recording
{
public:
    StreamRecording(std::shared_ptr<const StreamBuffer> buffer, std::optional<double> startUnixSeconds);

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    bool isWhole(Index first, Index count) const override { return m_buffer->isWhole(first, count); }
    bool isFinite(int channel, Index first, Index count) const override
    {
        return m_buffer->format().type.number != SampleType::Number::Float
               || nonFiniteCountIn(channel, first, count) == 0;
    }

private:
    std::shared_ptr<const StreamBuffer> m_buffer;
};

} // namespace faintline
