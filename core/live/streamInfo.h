#pragma once

#include "live/sources/SampleSource.h"
#include "signal/Recording.h"
#include "signal/endless.h"

namespace faintline {

/// Describes a stream of this format as a recording of `endlessSamples`, without a start time.
inline RecordingInfo streamInfo(const StreamFormat &format)
{
    RecordingInfo info;
    info.path = format.origin;
    info.container = "stream";
    info.sampleType = format.type.name();
    info.sampleRateHz = format.sampleRateHz;
    info.sampleCount = endlessSamples;
    info.channelCount = format.channelCount;
    info.isComplex = format.type.isComplex;
    info.centreHz = format.centreHz;
    return info;
}

} // namespace faintline
