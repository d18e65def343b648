#include "exchange/writeDoppler.h"

#include "base/Error.h"
#include "base/Field.h"
#include "base/files/AtomicFile.h"
#include "base/files/fileName.h"
#include "base/json.h"
#include "base/oneLine.h"
#include "inspect/doppler/dopplerFit.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace faintline {

namespace {

    /// Decimals that show a number to a tenth of the first digit of `width`.
    int decimalsFor(double width)
    {
        return std::clamp(1 - int(std::floor(std::log10(width))), 0, 9);
    }

    std::string rounded(double value, double width)
    {
        char digits[64];
        if (std::isfinite(width) && width > 0.0 && std::abs(value) < 1e15)
            std::snprintf(digits, sizeof digits, "%.*f", decimalsFor(width), value);
        else
            std::snprintf(digits, sizeof digits, "%.4g", value);
        return digits;
    }

    Json jsonOf(const std::optional<double> &value)
    {
        return value ? Json(*value) : Json();
    }

    Json jsonOf(const DopplerRow &row)
    {
        return {{"unit", row.unit},
                {"estimate", row.value},
                {"low", jsonOf(row.bounds.low)},
                {"high", jsonOf(row.bounds.high)}};
    }

    double fittedHz(const DopplerReport &report, std::size_t point)
    {
        return report.track.points[point].hz - report.fit.residualHz[point];
    }

    Curve::Point frequencyPoint(const DopplerPoint &point)
    {
        constexpr double deviations = 1.645; // 5 and 95 % of a normal law
        const double half = deviations * point.deviationHz;
        return {point.seconds, point.hz, {point.hz - half, point.hz + half}};
    }

    /// The measured points, those used in the fit first.
    std::vector<Curve> measuredCurves(const DopplerReport &report, bool isResidual)
    {
        std::vector<Curve> curves{{"track", Curve::Kind::Paper, {}}, {"left out", Curve::Kind::Paper, {}}};
        for (std::size_t i = 0; i < report.track.points.size(); ++i) {
            const DopplerPoint &point = report.track.points[i];
            curves[report.fit.isLeftOut[i] ? 1 : 0].points.push_back(
                isResidual ? Curve::Point{point.seconds, report.fit.residualHz[i], {}} : frequencyPoint(point));
        }
        if (curves.back().points.empty())
            curves.pop_back();
        return curves;
    }

    Chart frequencyChart(const DopplerReport &report)
    {
        constexpr int steps = 400;
        Chart chart;
        chart.title =
            (report.events.size() == 1 ? "Doppler fit, event " : "Doppler fit, events ") + eventNumbers(report);
        chart.xLabel = "Time (s)";
        chart.yLabel = "Frequency (Hz)";
        chart.curves = measuredCurves(report, false);
        Curve fitted{"fit", Curve::Kind::Theory, {}};
        const double from = report.track.points.front().seconds;
        const double to = report.track.points.back().seconds;
        for (int i = 0; i <= steps; ++i) {
            const double t = from + (to - from) * i / steps;
            fitted.points.push_back({t, receivedHz(report.fit.pass, report.fit.propagation, t), {}});
        }
        chart.curves.push_back(std::move(fitted));
        return chart;
    }

    Chart residualChart(const DopplerReport &report)
    {
        Chart chart;
        chart.xLabel = "Time (s)";
        chart.yLabel = "Residual (Hz)";
        chart.curves = measuredCurves(report, true);
        chart.curves.push_back(
            {"fit",
             Curve::Kind::Theory,
             {{report.track.points.front().seconds, 0.0, {}}, {report.track.points.back().seconds, 0.0, {}}}});
        return chart;
    }

} // namespace

std::optional<double> centreOfFrames(const AnalysisPlan &plan)
{
    if (!plan.recording || !plan.recording->info().isComplex)
        return 0.0;
    const double centreHz = plan.recording->info().centreHz;
    return centreHz > 0.0 ? std::optional(centreHz) : std::nullopt;
}

DopplerReport dopplerReport(const Analysis &analysis, std::vector<Event> events, double centreHz, double propagation)
{
    DopplerReport report;
    report.events = std::move(events);
    report.centreHz = centreHz;
    std::vector<DopplerTrack> tracks;
    for (const Event &event : report.events)
        tracks.push_back(dopplerTrack(analysis, *trackOfId(analysis.tracks, event.id), centreHz));
    report.track = joined(tracks);
    report.fit = fitDopplerPass(report.track.points, propagation);
    return report;
}

std::vector<DopplerRow> dopplerRows(const DopplerFit &fit)
{
    return {{"rest frequency", "Hz", fit.pass.restHz, fit.restHz},
            {"speed", "m/s", fit.pass.metresPerSecond, fit.metresPerSecond},
            {"closest range", "m", fit.pass.rangeMetres, fit.rangeMetres},
            {"closest approach", "s", fit.pass.closestSeconds, fit.closestSeconds}};
}

std::string boundsText(const DopplerBounds &bounds)
{
    if (bounds.isBounded()) {
        const double width = *bounds.high - *bounds.low;
        return rounded(*bounds.low, width) + " … " + rounded(*bounds.high, width);
    }
    if (bounds.low)
        return "above " + rounded(*bounds.low, 0.0);
    return bounds.high ? "below " + rounded(*bounds.high, 0.0) : "open";
}

std::string valueText(double value, const DopplerBounds &bounds)
{
    return rounded(value, bounds.isBounded() ? *bounds.high - *bounds.low : 0.0);
}

std::string eventNumbers(const DopplerReport &report)
{
    return listed(report.events, [](const Event &event) { return std::to_string(event.id); });
}

std::vector<std::string> dopplerNotes(const DopplerReport &report)
{
    std::vector<std::string> notes;
    if (report.track.steepCount > 0)
        notes.push_back("Points left out where the path is as steep as the model allows: "
                        + std::to_string(report.track.steepCount) + "; it falls at most by "
                        + rounded(report.track.steepestHzPerSecond, 0.0)
                        + " Hz/s, and the line may fall faster. A shorter window or steeper slopes can follow it.");
    notes.insert(notes.end(), report.fit.sentences.begin(), report.fit.sentences.end());
    return notes;
}

std::string dopplerJson(const DopplerReport &report)
{
    const DopplerFit &fit = report.fit;
    const std::vector<DopplerRow> rows = dopplerRows(fit);
    Json json;
    for (const Event &event : report.events)
        json["events"].push_back(event.id);
    json["propagation_m_per_s"] = fit.propagation;
    json["centre_hz"] = report.centreHz;
    json["interval"] = 0.9;
    json["rest_frequency"] = jsonOf(rows[0]);
    json["speed"] = jsonOf(rows[1]);
    json["closest_range"] = jsonOf(rows[2]);
    json["closest_approach"] = jsonOf(rows[3]);
    json["heard_s"] = fit.heardSeconds();
    json["slope_hz_per_s"] = fit.slopeHzPerSecond();
    json["rms_hz"] = fit.rmsHz;
    json["deviation_scale"] = fit.deviationScale;
    json["effective_points"] = fit.effectivePoints;
    json["notes"] = dopplerNotes(report);
    json["points"] = Json::array();
    for (std::size_t i = 0; i < report.track.points.size(); ++i) {
        const DopplerPoint &point = report.track.points[i];
        json["points"].push_back({{"t", point.seconds},
                                  {"f", point.hz},
                                  {"deviation", point.deviationHz},
                                  {"fitted", fittedHz(report, i)},
                                  {"residual", fit.residualHz[i]},
                                  {"left_out", fit.isLeftOut[i] != 0}});
    }
    return json.dump(2) + "\n";
}

std::string dopplerCsv(const DopplerReport &report)
{
    std::string csv = "t,f,deviation,fitted,residual,left_out\n";
    for (std::size_t i = 0; i < report.track.points.size(); ++i) {
        const DopplerPoint &point = report.track.points[i];
        for (const double number : {point.seconds, point.hz, point.deviationHz, fittedHz(report, i)})
            csv += formatNumber(number) + ",";
        csv += formatNumber(report.fit.residualHz[i]) + (report.fit.isLeftOut[i] ? ",1\n" : ",0\n");
    }
    return csv;
}

void writeDoppler(const DopplerReport &report, const std::string &path)
{
    checkEnding(path, {".json", ".csv"});
    writeTextFile(path, hasEnding(path, ".csv") ? dopplerCsv(report) : dopplerJson(report));
}

std::vector<Chart> dopplerCharts(const DopplerReport &report)
{
    return {frequencyChart(report), residualChart(report)};
}

} // namespace faintline
