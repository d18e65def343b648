#include "evaluate/experiments/sweepCurve.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

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

    std::string labelOf(const SweepExperiment &experiment)
    {
        const FieldInfo &field = parameterInfo(experiment.parameter);
        return field.name + (field.unit.empty() ? "" : " (" + field.unit + ")");
    }

    double shownFalseAlarms(const SweepPoint &point)
    {
        return point.falseAlarms > 0 ? point.falseAlarmsPerHour : unseen / point.hours;
    }

} // namespace

std::vector<SweepPoint> sweepCurve(const Campaign &campaign)
{
    const auto &experiment = std::get<SweepExperiment>(campaign.experiment);
    std::vector<SweepPoint> curve(experiment.values.size());
    std::vector<double> sum(curve.size()), sumOfSquares(curve.size());
    for (const RunOutcome &outcome : campaign.outcomes) {
        const auto i = std::size_t(experiment.valueOf(outcome.run));
        SweepPoint &point = curve[i];
        const auto latency = double(outcome.signal[0][0][0]);
        ++point.trials;
        point.falseAlarms += std::llround(outcome.noise[0][0]);
        point.hours += double(outcome.noise[0][1]) / 3600.0;
        if (!(latency >= 0.0))
            continue;
        ++point.detections;
        sum[i] += latency;
        sumOfSquares[i] += latency * latency;
    }
    for (std::size_t i = 0; i < curve.size(); ++i) {
        SweepPoint &point = curve[i];
        if (point.trials == 0)
            continue;
        point.value = experiment.values[i];
        point.threshold = i < campaign.thresholds.size() ? campaign.thresholds[i] : 0.0;
        point.pd = double(point.detections) / double(point.trials);
        point.pdInterval = wilsonInterval(point.detections, point.trials);
        const Interval counts = poissonInterval(point.falseAlarms);
        point.falseAlarmsPerHour = double(point.falseAlarms) / point.hours;
        point.falseAlarmInterval = {counts.low / point.hours, counts.high / point.hours};
        if (point.detections == 0)
            continue;
        const auto n = double(point.detections);
        point.latencySeconds = sum[i] / n;
        const double squares = std::max(0.0, sumOfSquares[i] - n * point.latencySeconds * point.latencySeconds);
        const double variance = n > 1.0 ? squares / (n - 1.0) : 0.0;
        point.latencyInterval = normalInterval(point.latencySeconds, std::sqrt(variance / n));
    }
    std::erase_if(curve, [](const SweepPoint &point) { return point.trials == 0; });
    return curve;
}

Chart sweepChart(const Campaign &campaign, SweepMeasure measure)
{
    const auto &experiment = std::get<SweepExperiment>(campaign.experiment);
    Chart chart{"Detection probability", labelOf(experiment), "Pd", isLogarithmic(experiment.values), false, {}};
    if (measure == SweepMeasure::FalseAlarms) {
        chart.title = "False alarms";
        chart.yLabel = "false alarms per hour";
        chart.isLogarithmicY = true;
    } else if (measure == SweepMeasure::Latency) {
        chart.title = "Latency";
        chart.yLabel = "start to detection (s)";
    }
    Curve curve{{}, Curve::Kind::Measured, {}}; // a single curve needs no name
    for (const SweepPoint &point : sweepCurve(campaign)) {
        if (measure == SweepMeasure::Pd)
            curve.points.push_back({point.value, point.pd, point.pdInterval});
        else if (measure == SweepMeasure::FalseAlarms)
            curve.points.push_back(
                {point.value,
                 shownFalseAlarms(point),
                 {std::max(point.falseAlarmInterval.low, 0.1 / point.hours), point.falseAlarmInterval.high}});
        else if (point.detections > 0)
            curve.points.push_back({point.value, point.latencySeconds, point.latencyInterval});
    }
    if (!curve.points.empty())
        chart.curves.push_back(std::move(curve));
    return chart;
}

Chart tradeOffChart(const Campaign &campaign)
{
    const auto &experiment = std::get<SweepExperiment>(campaign.experiment);
    Chart chart{"Trade-off of " + experiment.parameter, "false alarms per hour", "Pd", true, false, {}};
    Curve curve{{}, Curve::Kind::Measured, {}}; // a single curve needs no name
    for (const SweepPoint &point : sweepCurve(campaign)) {
        const Curve::Point shown{shownFalseAlarms(point), point.pd, point.pdInterval, formatNumber(point.value)};
        const auto same = std::find_if(curve.points.begin(), curve.points.end(), [&](const Curve::Point &other) {
            return other.x == shown.x && other.y == shown.y;
        });
        if (same == curve.points.end()) {
            curve.points.push_back(shown);
            continue;
        }
        same->label += ", " + shown.label; // coincident points share a label
        curve.points.push_back({shown.x, shown.y, shown.interval});
    }
    if (!curve.points.empty())
        chart.curves.push_back(std::move(curve));
    return chart;
}

Chart costChart(const SweepExperiment &experiment, const std::vector<double> &seconds)
{
    Chart chart{"Cost",
                labelOf(experiment),
                "processor time per hour of recording (s)",
                isLogarithmic(experiment.values),
                false,
                {}};
    Curve curve{{}, Curve::Kind::Measured, {}};
    for (std::size_t i = 0; i < std::min(seconds.size(), experiment.values.size()); ++i)
        curve.points.push_back({experiment.values[i], seconds[i], {}});
    if (!curve.points.empty())
        chart.curves.push_back(std::move(curve));
    return chart;
}

} // namespace faintline
