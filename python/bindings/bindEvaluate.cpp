#include "bindings/bind.h"

#include "base/files/InputFiles.h"
#include "bindings/arrays.h"
#include "bindings/interruptible.h"
#include "bindings/jsonFromPython.h"
#include "evaluate/experiments/campaignCurve.h"
#include "exchange/CampaignFile.h"
#include "exchange/Session.h"

#include <limits>

namespace faintline::python {

namespace py = pybind11;

namespace {

    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    template <class Point, class Take>
    Column column(const std::string &name, const std::vector<Point> &points, const Take &take)
    {
        std::vector<double> values;
        for (const Point &point : points)
            values.push_back(take(point));
        return {name, arrayOf(std::move(values))};
    }

    template <class Point>
    Column trials(const std::vector<Point> &points)
    {
        std::vector<std::int64_t> values;
        for (const Point &point : points)
            values.push_back(point.trials);
        return {"trials", arrayOf(std::move(values))};
    }

    py::array curveTable(const std::vector<CurvePoint> &points)
    {
        std::vector<std::string> detectors;
        for (const CurvePoint &point : points)
            detectors.push_back(point.detector);
        return tableOf(
            {{"detector", textColumn(detectors)},
             column("snr_db", points, [](const CurvePoint &p) { return p.snrDb; }),
             column("pd", points, [](const CurvePoint &p) { return p.pd; }),
             column("pd_low", points, [](const CurvePoint &p) { return p.interval.low; }),
             column("pd_high", points, [](const CurvePoint &p) { return p.interval.high; }),
             trials(points),
             column("threshold", points, [](const CurvePoint &p) { return p.threshold.value_or(unknown); })});
    }

    py::array sweepTable(const std::vector<SweepPoint> &points)
    {
        const auto latency = [](double SweepPoint::*which) {
            return [which](const SweepPoint &p) { return p.detections > 0 ? p.*which : unknown; };
        };
        return tableOf(
            {column("value", points, [](const SweepPoint &p) { return p.value; }),
             column("pd", points, [](const SweepPoint &p) { return p.pd; }),
             column("pd_low", points, [](const SweepPoint &p) { return p.pdInterval.low; }),
             column("pd_high", points, [](const SweepPoint &p) { return p.pdInterval.high; }), trials(points),
             column("false_alarms_per_hour", points, [](const SweepPoint &p) { return p.falseAlarmsPerHour; }),
             column("false_alarms_low", points, [](const SweepPoint &p) { return p.falseAlarmInterval.low; }),
             column("false_alarms_high", points, [](const SweepPoint &p) { return p.falseAlarmInterval.high; }),
             column("latency_s", points, latency(&SweepPoint::latencySeconds)),
             column("threshold", points, [](const SweepPoint &p) { return p.threshold; })});
    }

    Campaign carriedOut(const Experiment &experiment, const std::string &out, const RunContext &context)
    {
        const std::vector<int> runs = runsOfShard(experiment, 0, 1);
        if (out.empty()) {
            Campaign campaign{experiment, {}, {}};
            carryOut(campaign, runs, context);
            return campaign;
        }
        Campaign campaign = carryOutResumably(experiment, runs, out, context);
        writeCurve(campaign, out);
        removeParts(out);
        return campaign;
    }

    py::array evaluate(const py::object &given, int seed, const py::object &out, int threads,
                       const py::object &progress)
    {
        std::string where = "experiment";
        const Json json = jsonOrFile(given, where);
        Experiment experiment = experimentFromJson(json, where);
        if (seed >= 0)
            experiment.seed = seed;
        const std::string path = out.is_none() ? std::string() : pathFromPython(out);
        std::vector<std::string> files = filesReadFor(recordingOf(experiment));
        files.push_back(where);
        const InputFiles inputs(files);
        Campaign campaign;
        runInterruptibly({threads, progress},
                         [&](const RunContext &context) { campaign = carriedOut(experiment, path, context); });
        return campaign.experiment.isSweep() ? sweepTable(sweepCurve(campaign)) : curveTable(pdCurve(campaign));
    }

} // namespace

void bindEvaluate(py::module_ &module)
{
    module.def("evaluate", &evaluate, py::arg("experiment"), py::kw_only(), py::arg("seed") = -1,
               py::arg("out") = py::none(), py::arg("threads") = 0, py::arg("progress") = py::none(),
               R"(Estimates the detection probability of an experiment by Monte Carlo simulation.

experiment: a dict, or the path of a JSON file, in the format of faintline-cli evaluate, {"kind": "lines",
"snrDb": [-3, 0, 3], "runs": 8, …}; the kind is lines, injection or sweep.
seed: replaces the experiment's.
out: a .csv file for the curve. Completed runs are stored beside it, so that a later call resumes an interrupted
experiment.

Returns a structured array with one record per point: detector, snr_db, pd, pd_low, pd_high (95 % interval), trials,
threshold; for a sweep: value, pd, pd_low, pd_high, trials, false_alarms_per_hour and its interval, latency_s,
threshold. Raises Error with the name of the key.)");
}

} // namespace faintline::python
