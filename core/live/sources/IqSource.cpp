#include "live/sources/IqSource.h"

#include "base/Error.h"

namespace faintline {

namespace {

    StreamFormat withIq(StreamFormat format)
    {
        if (format.type.isComplex)
            return format;
        if (format.channelCount % 2 != 0)
            throw Error(format.origin,
                        "has " + std::to_string(format.channelCount) + " channel(s); I/Q needs an even number");
        format.type.isComplex = true;
        format.channelCount /= 2;
        return format;
    }

} // namespace

IqSource::IqSource(std::unique_ptr<SampleSource> source)
    : m_source(std::move(source)), m_format(withIq(m_source->format()))
{
}

} // namespace faintline
