#pragma once

#include "live/SampleSource.h"

#include <memory>

namespace faintline {

/// A source whose channels are taken in pairs, as I and Q. One that is complex already stays as it is.
class IqSource final : public SampleSource
{
public:
    /// Throws Error of an odd number of channels.
    explicit IqSource(std::unique_ptr<SampleSource> source);

    const StreamFormat &format() const override { return m_format; }
    Heard hear(std::chrono::milliseconds patience) override { return m_source->hear(patience); }
    bool isPatient() const override { return m_source->isPatient(); }

private:
    std::unique_ptr<SampleSource> m_source;
    StreamFormat m_format;
};

} // namespace faintline
