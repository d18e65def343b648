#include "evaluate/experiments/campaignCharts.h"

#include "base/Field.h"
#include "base/logmath.h"
#include "evaluate/theory/theory.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr double snrStep = 0.25; ///< dB, of theory curves

    /// Whether a frame has one power. Where frames overlap, those between two windows hold parts of two powers.
    bool hasWholeFrames(const Experiment &lines)
    {
        return lines.stepsPerWindow == 1 || !changesFromFrameToFrame(lines.fluctuation);
    }

    bool hasTheory(const Experiment &lines, const DetectorUnderTest &detectorUnderTest)
    {
        const auto *integrator = std::get_if<IntegratorSettings>(&detectorUnderTest.settings.detector);
        return lines.isLines() && integrator && integrator->shape == IntegratorSettings::Shape::Boxcar
               && integrator->durationWindows == lines.durationSeconds && lines.durationSeconds >= 1.0
               && lines.wanderHz == 0.0 && lines.driftHzPerSecond == 0.0 && lines.fading == Fading::None
               && lines.window == WindowShape::Rectangular && hasWholeFrames(lines);
    }

    /// Name of the law that theory assumes of a line's power.
    std::string theoryName(const Experiment &lines)
    {
        const auto number = int(lines.fluctuation);
        return lines.fluctuation == Fluctuation::None ? "Marcum Q" : "Swerling " + std::to_string(number);
    }

    /// Pd of the integrator for a mean number of false alarms per block.
    double integratorPd(const Experiment &lines, double falseAlarms, double snrDb)
    {
        const int looks = int(std::lround(lines.durationSeconds));
        const double cells = double(lines.blockFrames) / lines.stepsPerWindow * lines.blockBins / lines.binsPerCell;
        const double pfa = std::min(1.0, falseAlarms * lines.durationSeconds / cells);
        if (pfa >= 1.0)
            return 1.0;
        return pdOfMeanPower(thresholdOfMeanPower(pfa, looks), looks, ratioFromDb(snrDb), lines.fluctuation);
    }

    Curve theoryAgainstSnr(const Experiment &lines, const std::string &name)
    {
        Curve curve{name + ", " + theoryName(lines), Curve::Kind::Theory, {}};
        const auto [low, high] = std::minmax_element(lines.snrDb.begin(), lines.snrDb.end());
        for (double db = *low; db <= *high + 1e-9; db += snrStep)
            curve.points.push_back({db, integratorPd(lines, 1.0, db), {}});
        return curve;
    }

    Curve theoryAgainstFalseAlarms(const Experiment &lines, const std::string &name, double snrDb, double low,
                                   double high)
    {
        constexpr int points = 60;
        Curve curve{name + ", " + theoryName(lines), Curve::Kind::Theory, {}};
        for (int i = 0; i <= points; ++i) {
            const double falseAlarms = low * std::pow(high / low, double(i) / points);
            curve.points.push_back({falseAlarms, integratorPd(lines, falseAlarms, snrDb), {}});
        }
        return curve;
    }

    /// Measured curves of all detectors. The lowest and the highest threshold cannot be drawn on a logarithmic axis.
    void addMeasured(Chart &chart, const Campaign &campaign, std::size_t snr)
    {
        const std::vector<DetectorUnderTest> &detectors = campaign.experiment.detectors;
        for (std::size_t d = 0; d < detectors.size(); ++d) {
            Curve curve{detectors[d].name, Curve::Kind::Measured, {}};
            for (const RocPoint &point : rocPoints(campaign, d, snr))
                if (std::isfinite(point.falseAlarms) && point.falseAlarms > 0.0)
                    curve.points.push_back({point.falseAlarms, point.pd, point.interval});
            chart.curves.push_back(std::move(curve));
        }
    }

    /// Theory over the false alarms that were measured.
    void addTheory(Chart &chart, const Experiment &lines, std::size_t snr)
    {
        double low = 1.0;
        double high = 1.0;
        for (const Curve &curve : chart.curves)
            for (const Curve::Point &point : curve.points) {
                low = std::min(low, point.x);
                high = std::max(high, point.x);
            }
        for (const DetectorUnderTest &detectorUnderTest : lines.detectors)
            if (hasTheory(lines, detectorUnderTest) && low < high)
                chart.curves.push_back(
                    theoryAgainstFalseAlarms(lines, detectorUnderTest.name, lines.snrDb[snr], low, high));
    }

    /// The detector of the campaign that equals the current settings.
    std::optional<std::size_t> detectorLike(const Campaign &campaign, const AnalysisSettings &current)
    {
        if (campaign.outcomes.empty() || campaign.experiment.isSweep())
            return {};
        const std::vector<DetectorUnderTest> &detectors = campaign.experiment.detectors;
        for (std::size_t d = 0; d < detectors.size(); ++d)
            if (!detectors[d].isWhole && detectors[d].settings.model == current.model
                && detectors[d].settings.detector == current.detector)
                return d;
        return {};
    }

    std::string nameAt(const Campaign &campaign, std::size_t detector, double threshold)
    {
        return campaign.experiment.detectors[detector].name
               + ", T = " + formatNumber(std::round(100.0 * threshold) / 100.0);
    }

    constexpr double unseen = 0.7; ///< events: median of the posterior after a count of zero, ln 2

    /// Whether values increase by factors rather than by steps.
    bool isLogarithmic(const std::vector<double> &values)
    {
        if (values.size() < 3 || std::any_of(values.begin(), values.end(), [](double value) { return value <= 0.0; }))
            return false;
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        const double middle = values[values.size() / 2];
        const double fromGeometric = std::abs(std::log(middle * middle / (*low * *high)));
        const double fromArithmetic = std::abs(std::log(2.0 * middle / (*low + *high)));
        return *high / *low > 5.0 && fromGeometric < fromArithmetic;
    }

    std::string labelOf(const Experiment &experiment)
    {
        const FieldInfo &field = parameterInfo(experiment.parameter);
        return field.name + (field.unit.empty() ? "" : " (" + field.unit + ")");
    }

    /// The chart with its only curve, which needs no name.
    Chart withCurve(Chart chart, std::vector<Curve::Point> points)
    {
        if (!points.empty())
            chart.curves.push_back({{}, Curve::Kind::Measured, std::move(points)});
        return chart;
    }

    double shownFalseAlarms(const SweepPoint &point)
    {
        return point.falseAlarms > 0 ? point.falseAlarmsPerHour : unseen / point.hours;
    }

} // namespace

std::optional<Curve> pdAtOperatingPoint(const Campaign &campaign, const AnalysisSettings &current, double threshold)
{
    const std::optional<std::size_t> detector = detectorLike(campaign, current);
    if (!detector)
        return {};
    Curve curve{nameAt(campaign, *detector, threshold), Curve::Kind::Theory, {}};
    const std::vector<double> &snrs = campaign.experiment.snrDb;
    for (std::size_t s = 0; s < snrs.size(); ++s)
        curve.points.push_back({snrs[s], pdAbove(campaign, *detector, s, threshold).pd, {}});
    return curve;
}

std::optional<Curve> operatingPoint(const Campaign &campaign, std::size_t snr, const AnalysisSettings &current,
                                    double threshold)
{
    const std::optional<std::size_t> detector = detectorLike(campaign, current);
    if (!detector)
        return {};
    std::ptrdiff_t above = 0, all = 0;
    for (const RunOutcome &outcome : campaign.outcomes) {
        above += std::ranges::count_if(outcome.noise[*detector], [&](float d0) { return double(d0) > threshold; });
        all += std::ssize(outcome.noise[*detector]);
    }
    // None or all cannot be drawn on a logarithmic axis: half a block is added or subtracted.
    const double share = std::clamp(double(above), 0.5, double(all) - 0.5) / double(all);
    const bool isInBlocks = campaign.experiment.isLines();
    const CurvePoint pd = pdAbove(campaign, *detector, snr, threshold);
    return Curve{nameAt(campaign, *detector, threshold),
                 Curve::Kind::Paper,
                 {{isInBlocks ? -std::log1p(-share) : share, pd.pd, pd.interval}}};
}

std::vector<Curve> curvesOf(const std::vector<CurvePoint> &points)
{
    std::vector<Curve> curves;
    for (const CurvePoint &point : points) {
        if (curves.empty() || curves.back().name != point.detector)
            curves.push_back({point.detector, Curve::Kind::Measured, {}});
        curves.back().points.push_back({point.snrDb, point.pd, point.interval});
    }
    return curves;
}

Chart pdChart(const Campaign &campaign)
{
    if (campaign.experiment.isSweep())
        return sweepChart(campaign, SweepMeasure::Pd);
    const Experiment &experiment = campaign.experiment;
    Chart chart{"Detection probability", "SNR (dB), at 1 false alarm per block", "Pd", false, false, {}};
    if (!experiment.isLines()) {
        chart.title = "Detection probability in this recording";
        chart.xLabel = "SNR (dB), at " + formatNumber(experiment.falseAlarmsPerHour)
                       + (experiment.falseAlarmsPerHour == 1.0 ? " false alarm/h" : " false alarms/h");
    }
    chart.curves = curvesOf(pdCurve(campaign));
    if (!campaign.outcomes.empty())
        for (const DetectorUnderTest &detectorUnderTest : experiment.detectors)
            if (hasTheory(experiment, detectorUnderTest))
                chart.curves.push_back(theoryAgainstSnr(experiment, detectorUnderTest.name));
    return chart;
}

Chart rocChart(const Campaign &campaign, std::size_t snr)
{
    if (campaign.experiment.isSweep())
        return tradeOffChart(campaign);
    const bool isLines = campaign.experiment.isLines();
    Chart chart{"Receiver operating characteristic at " + formatNumber(campaign.experiment.snrDb.at(snr)) + " dB",
                isLines ? "False alarms per block" : "P(path without the line exceeds)",
                "Pd",
                true,
                false,
                {}};
    if (campaign.outcomes.empty())
        return chart;
    addMeasured(chart, campaign, snr);
    addTheory(chart, campaign.experiment, snr);
    return chart;
}

Chart sweepChart(const Campaign &campaign, SweepMeasure measure)
{
    const auto &experiment = campaign.experiment;
    Chart chart{"Detection probability", labelOf(experiment), "Pd", isLogarithmic(experiment.values), false, {}};
    if (measure == SweepMeasure::FalseAlarms) {
        chart.title = "False alarms";
        chart.yLabel = "false alarms per hour";
        chart.isLogarithmicY = true;
    } else if (measure == SweepMeasure::Latency) {
        chart.title = "Latency";
        chart.yLabel = "start to detection (s)";
    }
    std::vector<Curve::Point> points;
    for (const SweepPoint &point : sweepCurve(campaign)) {
        if (measure == SweepMeasure::Pd)
            points.push_back({point.value, point.pd, point.pdInterval});
        else if (measure == SweepMeasure::FalseAlarms)
            points.push_back(
                {point.value,
                 shownFalseAlarms(point),
                 {std::max(point.falseAlarmInterval.low, 0.1 / point.hours), point.falseAlarmInterval.high}});
        else if (point.detections > 0)
            points.push_back({point.value, point.latencySeconds, point.latencyInterval});
    }
    return withCurve(std::move(chart), std::move(points));
}

Chart tradeOffChart(const Campaign &campaign)
{
    const std::string &parameter = campaign.experiment.parameter;
    std::vector<Curve::Point> points;
    for (const SweepPoint &point : sweepCurve(campaign)) {
        const Curve::Point shown{shownFalseAlarms(point), point.pd, point.pdInterval, formatNumber(point.value)};
        const auto same = std::ranges::find_if(
            points, [&](const Curve::Point &other) { return other.x == shown.x && other.y == shown.y; });
        if (same == points.end()) {
            points.push_back(shown);
            continue;
        }
        same->label += ", " + shown.label; // coincident points share a label
        points.push_back({shown.x, shown.y, shown.interval});
    }
    return withCurve({"Trade-off of " + parameter, "false alarms per hour", "Pd", true, false, {}}, std::move(points));
}

Chart costChart(const Experiment &experiment, const std::vector<double> &seconds)
{
    std::vector<Curve::Point> points;
    for (std::size_t i = 0; i < std::min(seconds.size(), experiment.values.size()); ++i)
        points.push_back({experiment.values[i], seconds[i], {}});
    return withCurve({"Cost",
                      labelOf(experiment),
                      "processor time per hour of recording (s)",
                      isLogarithmic(experiment.values),
                      false,
                      {}},
                     std::move(points));
}

} // namespace faintline
