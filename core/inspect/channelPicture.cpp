#include "inspect/channelPicture.h"

#include "analysis/preparePlan.h"
#include "inspect/closeup.h"

namespace faintline {

ChannelPicture channelPicture(const RecordingPointer &recording, const AnalysisSettings &settings, int channel,
                              std::size_t byteBudget, const RunContext &context)
{
    constexpr double noiseShare = 0.5; // of the work
    Analysis alone;
    alone.settings = settings;
    alone.settings.selection.channel = channel;
    alone.settings.selection.channels.clear();
    alone.settings.family = {};
    alone.recording = recording;
    normalisePlan(alone, std::make_shared<Spectrogram>(recording, alone.settings.spectrogram, alone.settings.selection),
                  context.part(0.0, noiseShare));
    const FrameStretch all{0, alone.time().count};
    return {inputCloseup(alone, all, byteBudget, context.part(noiseShare, 1.0)), alone.grid().axes.back()};
}

} // namespace faintline
