#pragma once

#include "live/sources/SampleSource.h"

#include <memory>

namespace faintline {

/// Combines pairs of a source's channels into I/Q. Leaves a complex source unchanged.
class IqSource final : public SampleSource
{
public:
    /// Throws Error if the number of channels is odd.
    explicit IqSource(std::unique_ptr<SampleSource> source);

    const StreamFormat &format() const override { return m_format; }
    Heard hear(std::chrono::milliseconds patience) override { return m_source->hear(patience); }
    bool isPatient() const override { return m_source->isPatient(); }

private:
    std::unique_ptr<SampleSource> m_source;
    StreamFormat m_format;
};

} // namespace faintline
