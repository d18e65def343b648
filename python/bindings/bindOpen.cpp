#include "bindings/bind.h"

#include "bindings/Source.h"
#include "bindings/jsonFromPython.h"
#include "noise/openFrames.h"
#include "signal/openRecording.h"

#include <filesystem>

namespace faintline::python {

namespace py = pybind11;

namespace {

    OpenOptions optionsFrom(const py::kwargs &options)
    {
        OpenOptions result;
        for (const auto &[key, value] : options) {
            const auto name = py::cast<std::string>(key);
            if (name == "iq")
                result.iq = py::cast<bool>(value);
            else if (name == "raw_type")
                result.rawType = py::cast<std::string>(value);
            else if (name == "raw_rate")
                result.rawRateHz = py::cast<double>(value);
            else if (name == "raw_channels")
                result.rawChannels = py::cast<int>(value);
            else if (name == "raw_header")
                result.rawHeaderBytes = py::cast<Index>(value);
            else
                throw Error(name, "unknown option of open; known are iq, raw_type, raw_rate, raw_channels, raw_header");
        }
        return result;
    }

    std::string wholePath(const std::string &path)
    {
        return std::filesystem::absolute(path).lexically_normal().string();
    }

    /// What the command line has to be told to open the same.
    std::vector<std::string> argumentsFor(const std::string &path, const py::kwargs &given)
    {
        const OpenOptions options = optionsFrom(given);
        std::vector<std::string> arguments{wholePath(path)};
        if (options.iq)
            arguments.push_back("--iq");
        if (!options.rawType.empty())
            arguments.insert(arguments.end(),
                             {"--raw-type", options.rawType, "--raw-rate", formatNumber(options.rawRateHz),
                              "--raw-channels", std::to_string(options.rawChannels), "--raw-header",
                              std::to_string(options.rawHeaderBytes)});
        return arguments;
    }

    /// Many files that make one recording.
    py::object openTogether(const py::sequence &paths, const py::kwargs &options)
    {
        std::vector<std::string> names;
        for (const auto &path : paths)
            names.push_back(pathFromPython(py::reinterpret_borrow<py::object>(path)));
        if (names.empty())
            throw Error("path", "is an empty list; give the files of one recording");
        return py::cast(HeldRecording{openTogether(names, optionsFrom(options)), nullptr, {}});
    }

} // namespace

py::object openSource(const std::string &path, const py::kwargs &options)
{
    if (path.ends_with(".json"))
        return simulatedSource(readJsonFile(path), path);
    const bool isRaw = options.contains("raw_type");
    if (!isRaw && holdsFrames(path))
        return py::cast(HeldFrames{openFrames(path), nullptr, false, openPower(path), {wholePath(path)}});
    return py::cast(HeldRecording{openRecording(path, optionsFrom(options)), nullptr, argumentsFor(path, options)});
}

void bindOpen(py::module_ &module)
{
    module.def(
        "open",
        [](const py::object &path, const py::kwargs &options) {
            return py::isinstance<py::list>(path) || py::isinstance<py::tuple>(path)
                       ? openTogether(path, options)
                       : openSource(pathFromPython(path), options);
        },
        py::arg("path"),
        R"(Opens a recording or ready-made frames, by content; reads only headers.

path: one of
  audio (WAV, FLAC, …), SigMF, GWOSC strain (.hdf5);
  raw samples (give raw_type, such as "ci16_le", and raw_rate in Hz);
  a NumPy file of normalised frames (.npy, axes in NAME.grid.json beside it);
  recorded pings (.npy, or .h5 with a dataset "pings"), which are normalised;
  power over time and frequency (sigproc .fil, filterbank .h5);
  a scene to simulate (.json);
  a folder, a list of names (.timeline) or a Python list of names, which is one recording: its files in the order of
    their time stamps, gaps not observed.
iq: True takes two channels as I and Q.
raw_type, raw_rate, raw_channels, raw_header: format of raw samples; raw_header in bytes before the samples.

Returns a Recording, or normalised Frames if the file contains power over time and frequency. Raises Error with the
path, the reason and what would be accepted.)");
}

} // namespace faintline::python
