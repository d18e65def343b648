#include "signal/fileFormats.h"

#include "base/Error.h"
#include "base/files/fileName.h"
#include "signal/formats/AudioRecording.h"
#include "signal/formats/Hdf5Recordings.h"
#include "signal/formats/KiwiRecording.h"
#include "signal/formats/NumPy.h"
#include "signal/formats/PingFiles.h"
#include "signal/formats/RawRecording.h"
#include "signal/formats/SigmfRecording.h"
#include "signal/formats/SigprocFile.h"
#include "signal/formats/gridFile.h"

#include <algorithm>
#include <filesystem>
#include <type_traits>

namespace faintline {

namespace {

    template <class Kind, class... Arguments>
    RecordingPointer completed(const Arguments &...arguments)
    {
        const auto recording = std::make_shared<Kind>(arguments...);
        recording->completeByName();
        return recording;
    }

    template <class Kind>
    RecordingPointer openAs(const std::string &path, [[maybe_unused]] const OpenOptions &options)
    {
        if constexpr (std::is_constructible_v<Kind, std::string, bool>)
            return completed<Kind>(path, options.iq);
        else
            return std::make_shared<Kind>(path);
    }

    template <class Kind>
    bool isFileOf(const std::string &path)
    {
        return isFile(path) && Kind::recognises(path);
    }

    template <class Frames, class Kind>
    std::shared_ptr<const Frames> framesOf(const std::string &path, [[maybe_unused]] const std::string &gridPath)
    {
        if constexpr (std::is_constructible_v<Kind, std::string, std::string>)
            return std::make_shared<Kind>(path, gridPath);
        else
            return std::make_shared<Kind>(path);
    }

    std::shared_ptr<const PowerFrames> numPyPower(const std::string &path, const std::string &gridPath)
    {
        return NumPyPower::recognises(path, gridPath) ? framesOf<PowerFrames, NumPyPower>(path, gridPath) : nullptr;
    }

    /// The shape of a NumPy file; empty if it cannot be read, of which the next reader reports why.
    std::vector<Index> shapeOf(const std::string &path)
    {
        try {
            return readNumPyHeader(path).shape;
        } catch (const Error &) {
            return {};
        }
    }

    std::shared_ptr<const RawPings> numPyPings(const std::string &path, const std::string &gridPath)
    {
        const std::vector<Index> shape = shapeOf(path);
        constexpr std::size_t pingDimensionMinimum = 3;
        if (shape.size() < pingDimensionMinimum
            || (!gridPath.empty() && readGridFile(gridPath, shape).grid.isSpectrum()))
            return nullptr;
        return framesOf<RawPings, NumPyPings>(path, gridPath);
    }

    RecordingPointer openNamedRaw(const std::string &path, const OpenOptions &options)
    {
        const std::string typeName = *rawTypeOfExtension(path);
        if (typeName.empty())
            throw Error(path, "appears to contain raw samples; give their type and rate in Hz (such as --raw-type "
                              "ci16_le --raw-rate 48000); types are "
                                  + sampleTypeList());
        if (!(options.rawRateHz > 0.0))
            throw Error(path, "appears to contain raw samples (" + typeName
                                  + " according to its name); give their rate in Hz (such as --raw-rate 48000), and "
                                    "--raw-type if the type differs");
        OpenOptions named = options;
        named.rawType = typeName;
        return openRaw(path, named);
    }

    /// What the first format that recognises the file as its own makes of it.
    template <class Frames>
    std::shared_ptr<const Frames> openFramesBy(std::shared_ptr<const Frames> (*FileFormat::*open)(const std::string &,
                                                                                                  const std::string &),
                                               const std::string &path, const std::string &gridPath)
    {
        for (const FileFormat &format : fileFormats())
            if (format.*open && format.recognises(path))
                if (auto frames = (format.*open)(path, gridPath))
                    return frames;
        return nullptr;
    }

} // namespace

const std::vector<FileFormat> &fileFormats()
{
    static const std::vector<FileFormat> formats{
        {"NumPy frames",
         {"npy"},
         [](const std::string &path) { return hasEnding(path, ".npy"); },
         nullptr,
         &numPyPower,
         &numPyPings},
        {"sigproc filterbank", {"fil"}, &isFileOf<SigprocFile>, nullptr, &framesOf<PowerFrames, SigprocFile>},
        {"HDF5 filterbank", {"h5"}, &isFileOf<Hdf5Filterbank>, nullptr, &framesOf<PowerFrames, Hdf5Filterbank>},
        {"HDF5 pings", {"h5"}, &isFileOf<Hdf5Pings>, nullptr, nullptr, &framesOf<RawPings, Hdf5Pings>},
        {"SigMF", {"sigmf-meta"}, &SigmfRecording::isNamedSo, &openAs<SigmfRecording>},
        {"SigMF archive",
         {},
         [](const std::string &path) { return path.ends_with(".sigmf"); },
         [](const std::string &path, const OpenOptions &) -> RecordingPointer {
             throw Error(path, "is a SigMF archive; unpack it (tar -xf) and open the .sigmf-meta file");
         }},
        {"KiwiSDR WAV", {"wav"}, &KiwiRecording::recognises, &openAs<KiwiRecording>},
        {"HDF5 strain", {"hdf5", "h5"}, &StrainRecording::recognises, &openAs<StrainRecording>},
        {"Digital RF", {"h5"}, &DigitalRfRecording::recognises, &openAs<DigitalRfRecording>},
        {"other HDF5",
         {},
         &Hdf5File::recognises,
         [](const std::string &path, const OpenOptions &) -> RecordingPointer {
             throw Error(path, "is an HDF5 file of an unsupported kind; supported are strain (strain/Strain), Digital "
                               "RF (rf_data) and filterbanks (data, with fch1)");
         }},
        {"raw samples", {}, &isNamedRaw, &openNamedRaw},
        {"sound",
         {"wav", "flac", "ogg", "oga", "opus", "mp3", "aif", "aiff", "aifc", "au", "caf", "w64", "rf64"},
         [](const std::string &) { return true; },
         &openAs<AudioRecording>}};
    return formats;
}

bool isNamedRaw(const std::string &path)
{
    return rawTypeOfExtension(path) && !AudioRecording::recognises(path);
}

RecordingPointer openRaw(const std::string &path, const OpenOptions &options)
{
    if (!(options.rawRateHz > 0.0))
        throw Error(path, "raw samples have no header; give their rate in Hz (such as --raw-rate 48000)");
    const RawLayout layout{parseSampleType(options.rawType, path), options.rawRateHz, options.rawChannels,
                           options.rawHeaderBytes, 0};
    return completed<RawRecording>(path, options.iq ? withIqPairs(path, layout) : layout);
}

std::vector<std::string> recordingEndings()
{
    std::vector<std::string> all;
    for (auto format = fileFormats().rbegin(); format != fileFormats().rend(); ++format)
        for (const std::string &ending : format->endings)
            if (std::ranges::find(all, ending) == all.end())
                all.push_back(ending);
    return all;
}

bool isNamedLikeRecording(const std::string &path, bool mayHoldFrames)
{
    return std::ranges::any_of(fileFormats(), [&](const FileFormat &format) {
        return (mayHoldFrames || format.openSamples)
               && std::ranges::any_of(format.endings,
                                      [&](const std::string &ending) { return hasEnding(path, "." + ending); });
    });
}

std::string gridPathOf(const std::string &stackPath)
{
    return stackPath.substr(0, stackPath.rfind('.')) + ".grid.json";
}

std::string gridBeside(const std::string &stackPath)
{
    return isFile(gridPathOf(stackPath)) ? gridPathOf(stackPath) : std::string();
}

std::string truthPathOf(const std::string &path)
{
    return std::filesystem::path(path).replace_extension(".truth.json").string();
}

bool holdsFrames(const std::string &path)
{
    return std::ranges::any_of(
        fileFormats(), [&](const FileFormat &format) { return !format.openSamples && format.recognises(path); });
}

std::shared_ptr<const PowerFrames> openPower(const std::string &path)
{
    return openFramesBy(&FileFormat::openPower, path, gridPathOf(path));
}

std::shared_ptr<const RawPings> openRawPings(const std::string &path, const std::string &gridPath)
{
    return openFramesBy(&FileFormat::openPings, path, gridPath);
}

} // namespace faintline
