#include "bindings/bind.h"

#include "base/files/AtomicFile.h"
#include "base/files/InputFiles.h"
#include "bindings/HeldTrack.h"
#include "bindings/Result.h"
#include "bindings/arrays.h"
#include "bindings/eventArray.h"
#include "bindings/explanation.h"
#include "bindings/jsonFromPython.h"
#include "exchange/Session.h"
#include "exchange/writeEvents.h"
#include "inspect/explain.h"
#include "signal/formats/NumPy.h"

#include <pybind11/stl.h>

#include <optional>

namespace faintline::python {

namespace py = pybind11;

namespace {

    std::vector<py::ssize_t> shapeOf(const Analysis &analysis)
    {
        std::vector<py::ssize_t> shape{analysis.time().count};
        for (const Axis &axis : analysis.grid().axes)
            shape.push_back(axis.count);
        return shape;
    }

    py::array wholeArray(const Result &self, const Result::Values &values)
    {
        return viewOf(values, values->data(), shapeOf(*self.analysis()));
    }

    py::list tracks(const Result &self)
    {
        py::list list;
        for (std::size_t i = 0; i < self.analysis()->tracks.size(); ++i)
            list.append(HeldTrack{self.analysis(), i});
        return list;
    }

    /// What the command line writes with --events, --tracks and --statistic.
    void save(const Result &self, const py::object &events, const py::object &tracks, const py::object &statistic,
              const py::object &progress)
    {
        const auto nameOf = [](const py::object &path) {
            return path.is_none() ? std::string() : pathFromPython(path);
        };
        const std::string eventsPath = nameOf(events);
        const std::string tracksPath = nameOf(tracks);
        const std::string statisticPath = nameOf(statistic);
        if (eventsPath.empty() && tracksPath.empty() && statisticPath.empty())
            throw Error("save", "no output requested; give at least one of events, tracks, statistic");
        if (!eventsPath.empty())
            checkEventsPath(eventsPath);
        if (!tracksPath.empty())
            checkTracksPath(tracksPath);
        const std::vector<std::string> source = self.origin().source;
        const InputFiles inputs(filesReadFor(source.empty() ? std::string() : source.front()));
        runInterruptibly({0, progress}, [&](const RunContext &context) {
            CommitTogether files;
            writeProvenance(self.origin(),
                            {{"--events", eventsPath}, {"--tracks", tracksPath}, {"--statistic", statisticPath}});
            if (!eventsPath.empty())
                writeEvents(*self.analysis(), eventsPath);
            if (!tracksPath.empty())
                writeTracks(*self.analysis(), tracksPath);
            if (!statisticPath.empty()) {
                const std::vector<py::ssize_t> shape = shapeOf(*self.analysis());
                NumPyWriter writer(statisticPath, {shape.begin(), shape.end()});
                self.streamStatistic([&](Index, std::span<const float> values) { writer.write(values); }, context);
                writer.finish();
            }
            files.commit();
        });
    }

    HeldExplanation explainAt(const Result &self, double time, const py::args &position, const py::object &progress)
    {
        const std::vector<Axis> &axes = self.analysis()->grid().axes;
        if (position.size() != axes.size())
            throw Error("explain",
                        "takes a time and " + std::to_string(axes.size()) + " position(s), one for each axis");
        std::vector<double> at;
        for (const py::handle each : position)
            at.push_back(py::cast<double>(each));
        std::optional<Explanation> explanation;
        runInterruptibly({0, progress}, [&](const RunContext &context) {
            explanation = explain(*self.analysis(), time, at, context);
        });
        return {self.analysis(), *explanation};
    }

    double falseAlarmsPerHour(const Result &self)
    {
        const Analysis &a = *self.analysis();
        return a.calibration->eventRateAt(a.threshold) * a.cellFramesPerHour;
    }

    py::object windowChoice(const Result &self)
    {
        return self.analysis()->choice ? py::object(py::str(windowChoiceWords(*self.analysis()->choice))) : py::none();
    }

    std::string resultText(const Result &self)
    {
        const Analysis &a = *self.analysis();
        return py::str("<faintline.Result: {} event(s) in {} frames of {} cells, threshold {:.4g} {}>")
            .format(a.tracks.size(), a.time().count, a.grid().size(), a.threshold,
                    std::string(statisticUnit(a.settings.detector)));
    }

} // namespace

void bindResult(py::module_ &module)
{
    py::class_<Result, std::shared_ptr<Result>>(module, "Result",
                                                "Result of faintline.detect. Immutable; its arrays are read-only.")
        .def_property_readonly(
            "events", [](const Result &self) { return eventArray(*self.analysis()); },
            R"(The detected signals, a structured array with one record per event, ordered by onset, then frequency.

The fields are the columns of the command line's CSV: event, t_onset, t_detect, t_end (s), f (Hz, in the
middle between onset and end; with several axes, one field for each, at detection), drift_hz_per_s, statistic (unit: statistic_unit), confirmed, open, and, if tracks had
a second pass, snr_db, band_hz, noise_probability, window_s, keyed, spread (0 or 1) and call, the number of the
strongest event among the overtones of one source, or 0. With subtract.lines, subtracted follows; with two models
in parallel (preset sonarBank), model, which found the event, and model_changes, "t:name;…". f is an offset from the
recording's centre_hz.)")
        .def_property_readonly(
            "areas", [](const Result &self) { return areaArray(*self.analysis()); },
            R"(Areas of raised level without a line: bursts, clouds, hums. A structured array, ordered by onset.

Fields: t_onset, t_end (s), f_low, f_high (Hz), level_db (minimum level above the noise, 1 dB or more).)")
        .def_property_readonly("tracks", &tracks, "A Track for each event, in order of detection.")
        .def_property_readonly(
            "input",
            [](Result &self) {
                return wholeArray(self, self.input({0, py::none()}));
            },
            R"(Normalised power, float32 of shape (frames, cells…): noise has mean 1; cells not observed are NaN.

Computed on first access, then kept by the result; the array is a view of it. Raises Error for more than 2**31
values.)")
        .def_property_readonly(
            "statistic",
            [](Result &self) {
                return wholeArray(self, self.statistic({0, py::none()}));
            },
            R"(The detector's statistic, float32 of shape (frames, cells…), in statistic_unit; -inf if undecided.

Computed by a second run of the detector on first access, then kept by the result; the array is a view of it. The values
are those of the command line's --statistic. Raises Error for more than 2**31 values.)")
        .def_property_readonly(
            "time", [](const Result &self) { return self.analysis()->time(); },
            "The time axis: middle of each window, s.")
        .def_property_readonly(
            "axes", [](const Result &self) { return self.analysis()->grid().axes; }, "The cells' axes, slowest first.")
        .def_property_readonly(
            "frequency", [](const Result &self) { return self.analysis()->grid().axes.back(); },
            "The last axis; Hz for recordings.")
        .def_property_readonly(
            "threshold", [](const Result &self) { return self.analysis()->threshold; }, "Threshold, in statistic_unit.")
        .def_property_readonly(
            "statistic_unit",
            [](const Result &self) { return std::string(statisticUnit(self.analysis()->settings.detector)); })
        .def_property_readonly(
            "ln_k", [](const Result &self) { return self.analysis()->calibration->lnK; },
            "Calibrated ln K: bonus for continuing a path instead of restarting it, nat.")
        .def_property_readonly("false_alarms_per_hour", &falseAlarmsPerHour,
                               "False alarms per hour on noise at the threshold.")
        .def_property_readonly(
            "settings",
            [](const Result &self) {
                return pythonFromJson(parseJson(settingsToJson(self.analysis()->settings, false), "settings"));
            },
            "All settings in use, a dict by full names, with the chosen window.")
        .def_property_readonly("window_choice", &windowChoice,
                               "Reason for the window if it was chosen automatically; otherwise None.")
        .def("explain", &explainAt, py::arg("time"), py::kw_only(), py::arg("progress") = py::none(),
             R"(Explains the statistic of a cell: explain(time, frequency), or explain(time, position, position, …).

time in s, frequency in Hz (the last axis's unit). The nearest frame and cell are used. Returns an Explanation. Raises
Error for a time outside the recording.)")
        .def("save", &save, py::kw_only(), py::arg("events") = py::none(), py::arg("tracks") = py::none(),
             py::arg("statistic") = py::none(), py::arg("progress") = py::none(),
             R"(Writes the same files as the command line, byte for byte, in the format of the extension.

events: .csv, .json, .txt (Audacity labels) or .sigmf-meta.
tracks: .csv or .json.
statistic: .npy.

The files appear together when all are complete. If the source is a file, NAME.provenance.json is written beside each,
from which faintline-cli replay reproduces it. Raises Error.)")
        .def("__repr__", &resultText);
}

} // namespace faintline::python
