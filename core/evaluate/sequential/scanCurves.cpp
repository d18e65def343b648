#include "evaluate/sequential/scanCurves.h"

#include "base/logmath.h"
#include "evaluate/theory/walkOnLine.h"

#include <algorithm>
#include <limits>

namespace faintline {

namespace {

    const std::string onNoise = "H0, noise only";
    const std::string withTarget = "H1, a target";

    void sortBySnr(std::vector<ScanPoint> &points)
    {
        std::sort(points.begin(), points.end(),
                  [](const ScanPoint &a, const ScanPoint &b) { return a.snrDb < b.snrDb; });
    }

    Curve::Point pointAt(double x, const Estimate &estimate)
    {
        return {x, estimate.value, estimate.interval()};
    }

    /// The curves of both hypotheses.
    std::vector<Curve> measured(const std::vector<ScanPoint> &points, Estimate SequentialOutcome::*what)
    {
        Curve h0{onNoise, Curve::Kind::Measured, {}};
        Curve h1{withTarget, Curve::Kind::Measured, {}};
        for (const ScanPoint &point : points) {
            h0.points.push_back(pointAt(point.snrDb, point.h0.*what));
            h1.points.push_back(pointAt(point.snrDb, point.h1.*what));
        }
        return {std::move(h0), std::move(h1)};
    }

    struct Bound {
        const char *name;
        double WaldBounds::*value;
        bool isOfTarget;
    };
    constexpr Bound bounds[] = {{", (8b) lower", &WaldBounds::h0Low, false},
                                {", (8b) upper", &WaldBounds::h0High, false},
                                {", (8a) lower", &WaldBounds::h1Low, true},
                                {", (8a) upper", &WaldBounds::h1High, true}};

    std::string boundName(const Bound &bound)
    {
        return (bound.isOfTarget ? withTarget : onNoise) + bound.name;
    }

    /// Bound for designs at the true SNR; with a single design, a target's bounds are a short dash there.
    Curve boundCurve(const std::vector<ScanPoint> &points, const Bound &bound)
    {
        constexpr double halfDashDb = 0.6;
        Curve curve{boundName(bound), Curve::Kind::Theory, {}};
        const bool isOneDesign = points.front().designSnrDb == points.back().designSnrDb;
        if (isOneDesign && bound.isOfTarget) {
            const double at = points.front().designSnrDb;
            const double value = points.front().bounds.*bound.value;
            curve.points = {{at - halfDashDb, value, {}}, {at + halfDashDb, value, {}}};
            return curve;
        }
        for (const ScanPoint &point : points)
            curve.points.push_back({point.snrDb, point.bounds.*bound.value, {}});
        return curve;
    }

} // namespace

std::vector<double> curveSnrs(const ScanTest &test)
{
    std::vector<double> snrs;
    for (double step = -12.0; step <= 4.0; step += 2.0)
        if (!test.designFollows || test.designSnrDb + step <= highestDesignDb)
            snrs.push_back(test.designSnrDb + step);
    return snrs;
}

ScanPoint measureScanPoint(const ScanTest &test, double snrDb, const ScanPoint *before, const RunContext &context)
{
    ScanPoint point;
    point.snrDb = snrDb;
    point.designSnrDb = test.designFollows ? snrDb : test.designSnrDb;
    const bool isKnown = before && before->designSnrDb == point.designSnrDb;
    point.bounds = isKnown ? before->bounds
                           : waldBounds(test.sprt, ratioFromDb(point.designSnrDb), int(scanGrid(test.scene).size()));
    point.h0 = isKnown ? before->h0 : simulate(studyOf(test, point.designSnrDb, {}), context.part(0.0, 0.5));
    SequentialStudy study = studyOf(test, point.designSnrDb, snrDb);
    study.seed += std::uint64_t(1) << 32; // not the noise of H0 again
    point.h1 = simulate(study, context.part(0.5, 1.0));
    return point;
}

Chart stagesChart(std::vector<ScanPoint> points)
{
    Chart chart{"Stages against the SNR", "true SNR (dB)", "average sample number (stages)", false, false, {}};
    if (points.empty())
        return chart;
    sortBySnr(points);
    chart.curves = measured(points, &SequentialOutcome::stages);
    for (const Bound &bound : bounds)
        chart.curves.push_back(boundCurve(points, bound));
    return chart;
}

Chart variationChart(std::vector<ScanPoint> points)
{
    Chart chart{"Their coefficient of variation", "true SNR (dB)", "standard deviation / mean", false, false, {}};
    if (points.empty())
        return chart;
    sortBySnr(points);
    chart.curves = measured(points, &SequentialOutcome::variation);
    return chart;
}

PriorCurve startPriorCurve(const ScanTest &test)
{
    PriorCurve curve;
    curve.cells = std::min(test.scene.rangeCells, 1000);
    curve.bounds = waldBounds(test.sprt, ratioFromDb(test.designSnrDb), curve.cells);
    return curve;
}

const std::vector<double> &priorDeviations()
{
    static const std::vector<double> deviations{0.0, 0.3, 0.5, 1.0, 2.0, 5.0, std::numeric_limits<double>::infinity()};
    return deviations;
}

PriorPoint measurePriorPoint(const ScanTest &test, const PriorCurve &curve, double deviation, const RunContext &context)
{
    const double snr = ratioFromDb(test.designSnrDb);
    SequentialStudy study;
    study.model = walkOnLine(curve.cells, deviation, snr);
    study.sprt = test.sprt;
    study.sprt.cutOffStage = 0;
    study.trials = test.trials;
    study.seed = std::uint64_t(test.scene.seed);
    PriorPoint point{deviation, relativeEntropyRate(curve.cells, deviation), {}, {}};
    point.h0 = simulate(study, context.part(0.0, 0.5));
    study.actualSnr = snr;
    study.seed += std::uint64_t(1) << 32;
    point.h1 = simulate(study, context.part(0.5, 1.0));
    return point;
}

Chart priorChart(const PriorCurve &curve)
{
    Chart chart{"Stages against the prior", "entropy rate / ln M", "average sample number (stages)", false, false, {}};
    if (curve.points.empty())
        return chart;
    Curve h0{onNoise, Curve::Kind::Measured, {}};
    Curve h1{withTarget, Curve::Kind::Measured, {}};
    for (const PriorPoint &point : curve.points) {
        h0.points.push_back(pointAt(point.entropyRate, point.h0.stages));
        h1.points.push_back(pointAt(point.entropyRate, point.h1.stages));
    }
    chart.curves = {std::move(h0), std::move(h1)};
    for (const Bound &bound : bounds) {
        const double value = curve.bounds.*bound.value;
        chart.curves.push_back({boundName(bound), Curve::Kind::Theory, {{0.0, value, {}}, {1.0, value, {}}}});
    }
    return chart;
}

std::optional<Overshoot> overshoot(const PriorCurve &curve)
{
    for (const PriorPoint &point : curve.points)
        if (point.entropyRate == 1.0)
            return Overshoot{point.h0.stages.value / curve.bounds.h0High - 1.0,
                             point.h1.stages.value / curve.bounds.h1High - 1.0};
    return {};
}

} // namespace faintline
