#include "signal/openRecording.h"

#include "signal/Timeline.h"
#include "signal/fileHash.h"
#include "signal/formats/SigmfRecording.h"
#include "signal/timeInName.h"

#include <algorithm>

namespace faintline {

OpenOptions withNamedFormat(const std::string &path, OpenOptions options)
{
    const std::optional<ReceiverName> name = receiverName(path);
    if (!name || name->rawType.empty())
        return options;
    if (options.rawType.empty())
        options.rawType = name->rawType;
    if (!(options.rawRateHz > 0.0))
        options.rawRateHz = name->rateHz;
    return options;
}

RecordingPointer openRecording(const std::string &path, const OpenOptions &given)
{
    const OpenOptions options = withNamedFormat(path, given);
    if (Timeline::isNamedSo(path))
        return std::make_shared<Timeline>(std::vector{path},
                                          [options](const std::string &file) { return openRecording(file, options); });
    if (!options.rawType.empty())
        return openRaw(path, options);
    const auto format = std::ranges::find_if(
        fileFormats(), [&](const FileFormat &each) { return each.openSamples && each.recognises(path); });
    const bool isTold = given.rawRateHz > 0.0 || given.rawChannels != 1 || given.rawHeaderBytes != 0;
    RecordingPointer recording = format->openSamples(path, options);
    if (isTold && !isNamedRaw(path))
        throw Error(path, "describes its samples itself; --raw-rate, --raw-channels and --raw-header are for raw ones, "
                          "whose type must be given (such as --raw-type ci16_le)");
    return recording;
}

std::string recordingHash(const std::string &path)
{
    if (Timeline::isNamedSo(path))
        return filesHash(filesBehind({path}));
    return fileHash(path.ends_with(".sigmf-meta") ? SigmfRecording::dataPath(path) : path);
}

RecordingPointer openTogether(const std::vector<std::string> &names, const OpenOptions &options)
{
    return std::make_shared<Timeline>(names,
                                      [options](const std::string &path) { return openRecording(path, options); });
}

} // namespace faintline
