#include "bindings/bind.h"

#include "base/files/InputFiles.h"
#include "bindings/Source.h"
#include "bindings/arrays.h"
#include "bindings/interruptible.h"
#include "bindings/jsonFromPython.h"
#include "exchange/Session.h"
#include "signal/ArrayRecording.h"
#include "signal/formats/writeRecording.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <complex>

namespace faintline::python {

namespace py = pybind11;

namespace {

    template <class T>
    std::shared_ptr<const float> floatsOf(const py::array_t<T, py::array::c_style | py::array::forcecast> &array)
    {
        // The last owner may be a thread without the GIL.
        const auto owner = std::shared_ptr<py::object>(new py::object(array), [](py::object *object) {
            const py::gil_scoped_acquire held;
            delete object;
        });
        return {owner, reinterpret_cast<const float *>(array.data())};
    }

    /// Integers are scaled to ±1 at full scale, as those of files are.
    py::object scaled(const py::array &samples)
    {
        const py::dtype type = samples.dtype();
        const int bits = 8 * int(type.itemsize());
        if (type.kind() != 'i' || bits > 32)
            return samples;
        const auto fullScale = py::float_(std::ldexp(1.0, bits - 1));
        return (samples.attr("astype")("f8") / fullScale).attr("astype")("f4");
    }

    py::array readSamples(const HeldRecording &self, Index first, std::optional<Index> count, int channel)
    {
        const RecordingInfo &info = self.recording->info();
        if (channel < 0 || channel >= info.channelCount)
            throw Error("channel = " + std::to_string(channel),
                        "the recording has " + std::to_string(info.channelCount) + " channel(s), counted from 0");
        if (first < 0 || first > info.sampleCount)
            throw Error("first = " + std::to_string(first),
                        "the recording has the samples 0 … " + std::to_string(info.sampleCount - 1));
        const Index wanted = std::clamp<Index>(count.value_or(info.sampleCount), 0, info.sampleCount - first);
        std::vector<float> samples(std::size_t(wanted * info.floatsPerSample()));
        {
            const py::gil_scoped_release released;
            self.recording->read(channel, first, wanted, samples);
        }
        if (!info.isComplex)
            return arrayOf(std::move(samples));
        const auto owner = std::make_shared<const std::vector<float>>(std::move(samples));
        return viewOf(owner, reinterpret_cast<const std::complex<float> *>(owner->data()), {wanted});
    }

    void saveRecording(const HeldRecording &self, const py::object &path, const std::string &type, int threads,
                       const py::object &progress)
    {
        if (type != "float32" && type != "int16")
            throw Error("type = " + type, "must be float32 or int16");
        const std::string name = pathFromPython(path);
        const InputFiles inputs(filesReadFor(self.arguments.empty() ? std::string() : self.arguments.front()));
        runInterruptibly({threads, progress}, [&](const RunContext &context) {
            writeRecording(*self.recording, name, type == "int16" ? WrittenType::Int16 : WrittenType::Float32, context);
        });
    }

    std::string recordingText(const HeldRecording &self)
    {
        const RecordingInfo &info = self.recording->info();
        return py::str("<faintline.Recording {!r}, {}, {} samples at {:g} Hz, {} channel(s){}>")
            .format(pythonPath(info.path), info.container, info.sampleCount, info.sampleRateHz, info.channelCount,
                    info.isComplex ? ", I/Q" : "");
    }

    /// A member of RecordingInfo as a property.
    template <class T>
    auto info(T RecordingInfo::*member)
    {
        return [member](const HeldRecording &self) { return self.recording->info().*member; };
    }

} // namespace

HeldRecording recordingOfArray(const py::object &given, double rateHz, double centreHz)
{
    const py::array samples = scaled(py::array::ensure(given));
    if (!samples)
        throw Error("samples", "must be an array of real or complex numbers");
    if (samples.ndim() < 1 || samples.ndim() > 2)
        throw Error("samples", "must have the shape (samples,) or (samples, channels), not "
                                   + std::to_string(samples.ndim()) + " axes");
    ArrayLayout layout;
    layout.sampleRateHz = rateHz;
    layout.sampleCount = samples.shape(0);
    layout.channelCount = samples.ndim() == 2 ? int(std::min<py::ssize_t>(samples.shape(1), 1 << 20)) : 1;
    layout.isComplex = samples.dtype().kind() == 'c';
    layout.centreHz = centreHz;
    const auto floats = layout.isComplex ? floatsOf<std::complex<float>>(samples) : floatsOf<float>(samples);
    return {std::make_shared<ArrayRecording>("samples", floats, layout), nullptr};
}

void bindRecording(py::module_ &module)
{
    py::class_<HeldRecording>(module, "Recording",
                              R"(A recording with random access to its samples, which are not held in memory.

Created by faintline.open, faintline.simulate, or as Recording(samples, rate) from an array of shape (samples,) or
(samples, channels). Complex samples are I/Q. Signed integers are scaled to ±1 at full scale; floats keep their unit.
Single-precision arrays are not copied.)")
        .def(py::init(&recordingOfArray), py::arg("samples"), py::arg("rate"), py::arg("centre_hz") = 0.0)
        .def_property_readonly("path",
                               [](const HeldRecording &self) { return pythonPath(self.recording->info().path); })
        .def_property_readonly("container", info(&RecordingInfo::container), "'WAV', 'FLAC', 'SigMF', 'array' …")
        .def_property_readonly("sample_type", info(&RecordingInfo::sampleType))
        .def_property_readonly("rate", info(&RecordingInfo::sampleRateHz), "Samples per second, Hz.")
        .def_property_readonly("channels", info(&RecordingInfo::channelCount))
        .def_property_readonly("is_complex", info(&RecordingInfo::isComplex), "True for I/Q.")
        .def_property_readonly("centre_hz", info(&RecordingInfo::centreHz),
                               "Frequency to which 0 Hz of the samples corresponds, Hz.")
        .def_property_readonly("start", info(&RecordingInfo::startUnixSeconds),
                               "UTC of the first sample, seconds since 1970, or None.")
        .def_property_readonly("notes", info(&RecordingInfo::notes), "Repairs and assumptions made on opening.")
        .def_property_readonly(
            "duration", [](const HeldRecording &self) { return self.recording->info().durationSeconds(); }, "s")
        .def_property_readonly(
            "truth", [](const HeldRecording &self) { return pythonFromJson(self.truth); },
            "Truth of a simulated recording: its lines, a dict; otherwise None.")
        .def("__len__", info(&RecordingInfo::sampleCount), "Number of samples per channel.")
        .def("read", &readSamples, py::arg("first") = 0, py::arg("count") = py::none(), py::arg("channel") = 0,
             R"(Returns samples first … first+count-1 of one channel, fewer at the end: float32, or complex64 for I/Q.

Samples that are not finite read as 0. Raises Error if the channel or the first sample does not exist.)")
        .def(
            "save", &saveRecording, py::arg("path"), py::kw_only(), py::arg("type") = "float32", py::arg("threads") = 0,
            py::arg("progress") = py::none(),
            R"(Writes the recording in the format of the extension: .wav, .flac, .w64, .aiff, .caf, .au, or a SigMF pair
(.sigmf-meta).

type: "float32" or "int16" (clipped at ±1). The file appears only when it is complete. Raises Error.)")
        .def("__repr__", &recordingText);
}

} // namespace faintline::python
