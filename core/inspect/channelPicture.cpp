#include "inspect/channelPicture.h"

#include "analyse/preparePlan.h"
#include "analyse/usable.h"
#include "base/Error.h"
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
    if (const Spectrogram *spectrogram = alone.frames->spectrogram(); spectrogram && alone.background)
        if (const std::string silence = silenceWords(*spectrogram, *alone.background, context); !silence.empty())
            throw Error(recording->info().path, silence);
    const FrameStretch all{0, alone.time().count};
    return {inputCloseup(alone, all, byteBudget, context.part(noiseShare, 1.0)), alone.grid().axes.back()};
}

} // namespace faintline
