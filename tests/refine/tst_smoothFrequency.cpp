#include "analyse/analyse.h"
#include "base/Error.h"
#include "inspect/straighten.h"
#include "refine/smoothFrequency.h"
#include "scene/SimulatedRecording.h"
#include "signal/StraightenedRecording.h"
#include "support/test.h"

#include <Eigen/Dense>

#include <cmath>
#include <limits>
#include <numbers>

using namespace faintline;

namespace {

/// Frames of 1 s, cells of 1 Hz.
AnalysisPlan planOf(Index frames)
{
    AnalysisPlan plan;
    plan.frames = std::make_shared<FrameArray>(Axis{"time", "s", 0.5, 1.0, frames, false},
                                               Grid{{{"frequency", "Hz", 100.0, 1.0, 4000, false}}},
                                               std::vector<float>(std::size_t(4000 * frames), 1.0f));
    return plan;
}

Track trackAlong(const std::vector<double> &cells, const std::vector<float> &presence = {})
{
    Track track;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        track.points.push_back({Index(i) + 3, Index(std::lround(cells[i])), 0, 0.0});
        SmoothedPoint point;
        point.position = cells[i];
        point.low = float(cells[i]) - 1.0f;
        point.high = float(cells[i]) + 1.0f;
        point.presence = presence.empty() ? 1.0f : presence[i];
        track.smoothed.push_back(point);
    }
    track.onsetFrame = 3;
    track.endFrame = 2 + std::ssize(cells);
    return track;
}

} // namespace

/// From a track to a smooth frequency.
class tst_smoothFrequency : public QObject
{
    Q_OBJECT

private slots:
    void keepsAStraightLine();
    void halvesAWanderOfItsPeriod();
    void solvesWhittakersEquations();
    void endsInAStraightLine();
    void refusesPeriodsItCannotSolve();
    void liftsADriftingLine();
};

void tst_smoothFrequency::keepsAStraightLine()
{
    std::vector<double> cells;
    for (int i = 0; i < 50; ++i)
        cells.push_back(1000.0 + 2.5 * i);
    const FrequencyCurve curve = smoothFrequency(planOf(60), trackAlong(cells), 10.0);
    for (int i = 0; i < 50; ++i)
        QVERIFY(std::abs(curve.at(3.5 + i) - (1100.0 + 2.5 * i)) < 1e-3);
    // On for half the period, and then no further.
    QVERIFY(std::abs(curve.at(3.5 - 5.0) - (1100.0 - 12.5)) < 0.01);
    QCOMPARE(curve.at(3.5 - 30.0), curve.at(3.5 - 5.0));
    QVERIFY(std::abs(curve.at(3.5 + 54.0) - (1100.0 + 2.5 * 54.0)) < 0.01);
}

void tst_smoothFrequency::halvesAWanderOfItsPeriod()
{
    for (const auto &[period, gain] :
         {std::pair(12.0, 0.5),
          std::pair(
              48.0,
              1.0 / (1.0 + std::pow(std::sin(std::numbers::pi / 48.0) / std::sin(std::numbers::pi / 12.0), 4.0)))}) {
        std::vector<double> cells;
        for (int i = 0; i < 480; ++i)
            cells.push_back(2000.0 + 4.0 * std::sin(2.0 * std::numbers::pi * i / period));
        const FrequencyCurve curve = smoothFrequency(planOf(490), trackAlong(cells), 12.0);
        double projection = 0.0; // over whole periods, away from the ends
        for (int i = 96; i < 384; ++i)
            projection += (curve.at(3.5 + i) - 2100.0) * std::sin(2.0 * std::numbers::pi * i / period) * 2.0 / 288.0;
        QVERIFY2(std::abs(projection / 4.0 - gain) < 0.01, qPrintable(QString::number(projection / 4.0)));
    }
}

/// (W + λ DᵀD) z = W f, with dense matrices.
void tst_smoothFrequency::solvesWhittakersEquations()
{
    constexpr int n = 40;
    std::vector<double> cells;
    std::vector<float> presence;
    for (int i = 0; i < n; ++i) {
        cells.push_back(1500.0 + 3.0 * std::sin(1.7 * i) + 0.2 * i);
        presence.push_back(i % 5 == 0 ? 0.1f : 0.9f);
    }
    const FrequencyCurve curve = smoothFrequency(planOf(50), trackAlong(cells, presence), 8.0);
    Eigen::MatrixXd difference = Eigen::MatrixXd::Zero(n - 2, n);
    Eigen::VectorXd weights(n), values(n);
    double mean = 0.0;
    for (int i = 0; i < n; ++i)
        mean += double(presence[std::size_t(i)]) / n;
    for (int i = 0; i < n; ++i) {
        weights[i] = double(presence[std::size_t(i)]) / mean;
        values[i] = 100.0 + cells[std::size_t(i)];
        if (i + 2 < n)
            difference.row(i).segment(i, 3) << 1.0, -2.0, 1.0;
    }
    const double stiffness = std::pow(2.0 * std::sin(std::numbers::pi / 8.0), -4.0);
    const Eigen::MatrixXd matrix =
        Eigen::MatrixXd(weights.asDiagonal()) + stiffness * difference.transpose() * difference;
    const Eigen::VectorXd z = matrix.fullPivLu().solve(Eigen::VectorXd(weights.asDiagonal() * values));
    for (int i = 0; i < n; ++i)
        QVERIFY(std::abs(curve.at(3.5 + i) - z[i]) < 1e-5);
}

/// A period far longer than the track leaves the straight line of least squares, to the last digit that matters, and
/// the curve goes on for no more than half the track's length.
void tst_smoothFrequency::endsInAStraightLine()
{
    std::vector<double> cells;
    for (int i = 0; i < 40; ++i)
        cells.push_back(2000.0 + 0.5 * i + (i % 2 == 0 ? 0.25 : -0.25));
    const FrequencyCurve curve = smoothFrequency(planOf(50), trackAlong(cells), 4096.0);
    const double slope = (curve.at(3.5 + 39) - curve.at(3.5)) / 39.0;
    QVERIFY(std::abs(slope - 0.5) < 0.002);
    for (int i = 0; i < 40; ++i)
        QVERIFY(std::abs(curve.at(3.5 + i) - curve.at(3.5) - slope * i) < 1e-4);
    QCOMPARE(curve.time().count, Index(40 + 2 * 20));
}

void tst_smoothFrequency::refusesPeriodsItCannotSolve()
{
    const Track track = trackAlong(std::vector<double>(40, 1000.0));
    const AnalysisPlan plan = planOf(50);
    for (const double seconds :
         {-1.0, 1.9, 4097.0, 1e9, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
        QVERIFY_EXCEPTION_THROWN(smoothFrequency(plan, track, seconds), Error);
    QCOMPARE(smoothFrequency(plan, trackAlong({1000.0})).meanHz(), 1100.0); // of a single frame
}

namespace {

RecordingPointer driftingLine(double snrDb)
{
    LineScene scene;
    scene.sampleRateHz = 500.0;
    scene.durationSeconds = 600.0;
    scene.noise.deviation = 0.1;
    scene.seed = 11;
    LineSettings line;
    line.snrDb = snrDb;
    line.referenceSeconds = 1.0;
    line.frequencyHz = 100.0;
    line.driftHzPerSecond = 0.1;
    scene.lines = {line};
    return std::make_shared<SimulatedRecording>(scene);
}

} // namespace

/// Found at the usual settings, and brought out of the noise of one transform.
void tst_smoothFrequency::liftsADriftingLine()
{
    const RecordingPointer recording = driftingLine(3.0);
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = 2.0;
    settings.selection.lowHz = 60.0;
    settings.selection.highHz = 160.0;
    const auto analysis = analyse(recording, settings);
    QCOMPARE(analysis->tracks.size(), std::size_t(1));
    const FrequencyCurve curve = smoothFrequency(*analysis, analysis->tracks.front(), 300.0);
    const StraightenedRecording straight(recording, 0, curve, curve.meanHz());
    const LineHeight before = lineHeight(*recording, {0, 0.0, 600.0, curve.meanHz(), 20.0});
    const LineHeight after = lineHeight(straight, {0, 0.0, 600.0, curve.meanHz(), 20.0});
    QVERIFY2(after.db > before.db + 10.0,
             qPrintable(QString("%1 dB before, %2 dB after").arg(before.db).arg(after.db)));
    QVERIFY(std::abs(after.hz - curve.meanHz()) < 0.1);
}

FAINTLINE_TEST(tst_smoothFrequency)
#include "tst_smoothFrequency.moc"
