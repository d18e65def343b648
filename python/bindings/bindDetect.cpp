#include "bindings/bind.h"

#include "analyse/analyse.h"
#include "bindings/Result.h"
#include "bindings/Source.h"
#include "bindings/jsonFromPython.h"
#include "bindings/settingsFromPython.h"
#include "noise/NormalisedPower.h"
#include "noise/openFrames.h"
#include "plan/firstSettings.h"

#include <pybind11/stl.h>

#include <functional>
#include <optional>

namespace faintline::python {

namespace py = pybind11;

namespace {

    /// A Recording or Frames of whatever was given.
    py::object sourceOf(const py::object &given, const std::optional<double> &rate, double centreHz)
    {
        if (py::isinstance<HeldRecording>(given) || py::isinstance<HeldFrames>(given)) {
            if (rate)
                throw Error("rate",
                            "is known of a recording and has no place with frames; it is for samples in an array");
            return given;
        }
        if (py::isinstance<py::str>(given) || py::hasattr(given, "__fspath__"))
            return openSource(pathFromPython(given));
        if (!rate)
            throw Error("rate", "is needed with samples in an array: samples per second, Hz");
        return py::cast(recordingOfArray(given, *rate, centreHz));
    }

    /// Of a file of power the part that the settings select, normalised as they say; of recorded pings likewise.
    NormalisedFramesPointer framesFor(const HeldFrames &held, const AnalysisSettings &settings,
                                      const RunContext &context)
    {
        if (!held.power && !held.arguments.empty() && settings.pings != PingNoiseSettings()
            && holdsFrames(held.arguments.front()))
            return openFrames(held.arguments.front(), {settings.selection, settings.noise, settings.pings}, context);
        if (!held.power || (settings.selection == SelectionSettings() && settings.noise == NormaliserSettings()))
            return held.frames;
        return std::make_shared<NormalisedPower>(held.power, partOf(held.power->info(), settings.selection),
                                                 settings.noise, context);
    }

    using Open = std::function<OpenedSource(const RunContext &context)>;

    std::shared_ptr<Result> detectIn(const Open &open, const Origin &origin, const RunOptions &options)
    {
        std::shared_ptr<const Analysis> analysis;
        runInterruptibly(options, [&](const RunContext &context) {
            analysis = analyse(open(context.part(0.0, 0.1)), origin.settings, {}, context.part(0.1, 1.0));
        });
        return std::make_shared<Result>(analysis, origin);
    }

    std::shared_ptr<Result> detectIn(const HeldFrames &held, const AskedSettings &asked, const RunOptions &options)
    {
        const AnalysisSettings settings =
            settingsFromPython(asked, held.isPings ? firstSettings(held.frames->grid()) : AnalysisSettings());
        const Open open = [&](const RunContext &context) { return framesFor(held, settings, context); };
        return detectIn(open, Origin{held.arguments, settings}, options);
    }

    std::shared_ptr<Result> detectIn(const HeldRecording &held, const AskedSettings &asked, const RunOptions &options)
    {
        const AnalysisSettings settings = settingsFromPython(asked, held.recording->info());
        return detectIn([&](const RunContext &) { return held.recording; }, Origin{held.arguments, settings}, options);
    }

    std::shared_ptr<Result> detect(const py::object &x, const std::optional<double> &rate, double centreHz,
                                   const py::object &preset, const py::object &settings, int threads,
                                   const py::object &progress, const py::kwargs &keywords)
    {
        const py::object source = sourceOf(x, rate, centreHz);
        const AskedSettings asked{preset, settings, keywords};
        const RunOptions options{threads, progress};
        return py::isinstance<HeldFrames>(source) ? detectIn(py::cast<const HeldFrames &>(source), asked, options)
                                                  : detectIn(py::cast<const HeldRecording &>(source), asked, options);
    }

} // namespace

void bindDetect(py::module_ &module)
{
    module.def(
        "detect", &detect, py::arg("x"), py::arg("rate") = py::none(), py::kw_only(), py::arg("centre_hz") = 0.0,
        py::arg("preset") = py::none(), py::arg("settings") = py::none(), py::arg("threads") = 0,
        py::arg("progress") = py::none(),
        R"(Finds lines in a recording, or signals in ready-made frames; gives the same bytes as faintline-cli detect.

x: a Recording, Frames, a path, or samples in an array of shape (samples,) or (samples, channels), complex for I/Q. An
array requires rate (Hz).
preset: a name of faintline.presets().
settings: a dict by full names, {"spectrogram.windowSeconds": 0.5}.
Keywords: the same settings by short names in snake case, window_seconds=0.5, false_alarms_per_hour=1, if only one
setting has that name (faintline.describe() lists both). If no window is set, it is chosen for the recording.
threads: 0 for as many as the machine has. Results do not depend on it.
progress: called as progress(fraction, what) about ten times a second.

Returns a Result. Raises Error for settings out of range and for recordings without a finite sample. KeyboardInterrupt
stops the run.)");
}

} // namespace faintline::python
