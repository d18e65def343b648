#include "signal/openRecording.h"

#include "base/Error.h"
#include "signal/Timeline.h"
#include "signal/fileHash.h"
#include "signal/formats/AudioRecording.h"
#include "signal/formats/DigitalRfRecording.h"
#include "signal/formats/KiwiRecording.h"
#include "signal/formats/RawRecording.h"
#include "signal/formats/SigmfRecording.h"
#include "signal/formats/StrainRecording.h"
#include "signal/timeInName.h"

namespace faintline {

namespace {

    template <class Kind, class... Arguments>
    RecordingPointer completed(const Arguments &...arguments)
    {
        const auto recording = std::make_shared<Kind>(arguments...);
        recording->completeByName();
        return recording;
    }

    RecordingPointer openRaw(const std::string &path, const std::string &typeName, const OpenOptions &options)
    {
        if (!(options.rawRateHz > 0.0))
            throw Error(path, "raw samples have no header; give their rate in Hz (such as --raw-rate 48000)");
        const RawLayout layout{parseSampleType(typeName, path), options.rawRateHz, options.rawChannels,
                               options.rawHeaderBytes, 0};
        return completed<RawRecording>(path, options.iq ? withIqPairs(path, layout) : layout);
    }

    /// Opens a file as raw samples if its name says so and its content does not contradict.
    RecordingPointer openByRawExtension(const std::string &path, const std::string &typeName,
                                        const OpenOptions &options)
    {
        if (typeName.empty())
            throw Error(path, "appears to contain raw samples; give their type and rate in Hz (such as --raw-type "
                              "ci16_le --raw-rate 48000); types are "
                                  + sampleTypeList());
        if (!(options.rawRateHz > 0.0))
            throw Error(path, "appears to contain raw samples (" + typeName
                                  + " according to its name); give their rate in Hz (such as --raw-rate 48000), and "
                                    "--raw-type if the type differs");
        return openRaw(path, typeName, options);
    }

} // namespace

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
        return openRaw(path, options.rawType, options);
    if (SigmfRecording::isNamedSo(path))
        return completed<SigmfRecording>(path, options.iq);
    if (path.ends_with(".sigmf"))
        throw Error(path, "is a SigMF archive; unpack it (tar -xf) and open the .sigmf-meta file");
    if (KiwiRecording::recognises(path))
        return std::make_shared<KiwiRecording>(path);
    if (Hdf5File::recognises(path)) {
        if (StrainRecording::recognises(path))
            return std::make_shared<StrainRecording>(path);
        if (DigitalRfRecording::recognises(path))
            return std::make_shared<DigitalRfRecording>(path);
        throw Error(path, "is an HDF5 file of an unsupported kind; supported are strain (strain/Strain), Digital RF "
                          "(rf_data) and filterbanks (data, with fch1)");
    }
    if (const auto rawType = rawTypeOfExtension(path); rawType && !AudioRecording::recognises(path))
        return openByRawExtension(path, *rawType, options);
    return completed<AudioRecording>(path, options.iq);
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
