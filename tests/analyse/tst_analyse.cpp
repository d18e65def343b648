#include "analyse/analyse.h"
#include "base/Random.h"
#include "calibrate/calibrate.h"
#include "inspect/explain.h"
#include "scene/SimulatedRecording.h"
#include "support/recordings.h"
#include "support/test.h"

#include <cmath>

using namespace faintline;

namespace {

/// Two minutes with one clear wandering line from 30 s to 90 s.
RecordingPointer recording(int seed = 1, double snrDb = 4.0)
{
    LineScene scene;
    scene.sampleRateHz = 400.0;
    scene.durationSeconds = 120.0;
    scene.seed = seed;
    LineSettings line;
    line.snrDb = snrDb;
    line.startSeconds = 30.0;
    line.durationSeconds = 60.0;
    line.frequencyHz = 90.0;
    line.wanderHz = 8.0;
    line.wanderSeconds = 60.0;
    scene.lines.push_back(line);
    return std::make_shared<SimulatedRecording>(scene);
}

AnalysisSettings settings()
{
    AnalysisSettings s = preset("billon").settings;
    s.spectrogram.windowSeconds = 0.25;
    return s;
}

std::shared_ptr<const Analysis> analysed(int threads = 1, const AnalysisSettings &s = settings(),
                                         std::vector<float> *statistic = nullptr)
{
    RunContext context;
    context.threads = threads;
    StatisticSink sink;
    if (statistic)
        sink = [statistic](Index, std::span<const float> block) {
            statistic->insert(statistic->end(), block.begin(), block.end());
        };
    return analyse(recording(), s, {.statistic = sink}, context);
}

bool sameTracks(const Analysis &a, const Analysis &b)
{
    if (a.tracks.size() != b.tracks.size())
        return false;
    for (std::size_t i = 0; i < a.tracks.size(); ++i) {
        const Track &x = a.tracks[i];
        const Track &y = b.tracks[i];
        if (x.onsetFrame != y.onsetFrame || x.endFrame != y.endFrame || x.peakStatistic != y.peakStatistic
            || x.points.size() != y.points.size())
            return false;
        for (std::size_t j = 0; j < x.points.size(); ++j)
            if (x.points[j].cell != y.points[j].cell || x.points[j].statistic != y.points[j].statistic)
                return false;
    }
    return true;
}

} // namespace

/// The pipeline as a whole: what it finds, that nothing but settings and recording counts, and its calibration.
class tst_analyse : public QObject
{
    Q_OBJECT

private slots:
    void findsTheLine();
    void sameBytesOnAnyThreads();
    void lentPartsChangeNothing();
    void statisticSinkIsThePyramid();
    void explanationAddsUp();
    void calibratedKHalvesNoise();
    void aKOutOfReachIsAnError();
    void falseAlarmsAsOrdered_data();
    void falseAlarmsAsOrdered();
    void noLinesInNoiseOfAnyKind_data();
    void noLinesInNoiseOfAnyKind();
    void aConstantIsNoLine();
    void thresholdsAgree();
    void cancels();
    void readyMadeFrames();
    void readyMadeTracksEndWithTheirLine();
    void aLineBetweenBinsIsMeasured();
};

void tst_analyse::findsTheLine()
{
    const auto analysis = analysed();
    const auto truth = std::static_pointer_cast<const SimulatedRecording>(analysis->recording)->truth().lines.at(0);
    double covered = 0.0;
    for (const Track &track : analysis->tracks)
        for (const TrackPoint &point : track.points) {
            const double t = analysis->time().value(double(point.frame));
            const double f = analysis->grid().axes[0].value(double(point.cell));
            if (t > 30.0 && t < 90.0 && std::abs(f - truth.frequencyAt(t)) < 4.0) // one resolution cell
                covered += analysis->time().step;
        }
    QVERIFY2(covered > 45.0, qPrintable(QString("%1 s of 60 s").arg(covered)));
    QVERIFY(analysis->tracks.size() <= 4);
    for (const Event &event : events(*analysis)) {
        QVERIFY(event.onsetSeconds <= event.detectSeconds && event.detectSeconds <= event.endSeconds + 1e-9);
        QVERIFY(event.statistic > analysis->threshold);
    }
}

void tst_analyse::sameBytesOnAnyThreads()
{
    std::vector<float> one;
    std::vector<float> two;
    std::vector<float> five;
    const auto a = analysed(1, settings(), &one);
    const auto b = analysed(2, settings(), &two);
    const auto c = analysed(5, settings(), &five);
    QVERIFY(one == two && one == five);
    QVERIFY(sameTracks(*a, *b) && sameTracks(*a, *c));
}

void tst_analyse::lentPartsChangeNothing()
{
    const RecordingPointer r = recording();
    const auto before = analyse(r, settings());
    AnalysisSettings changed = settings();
    changed.decide.falseAlarmsPerHour = 50.0;
    const auto lent = analyse(r, changed, {.previous = before.get()});
    const auto fresh = analyse(r, changed);
    QVERIFY(lent->background == before->background && lent->input == before->input); // shared, not copied
    QVERIFY(sameTracks(*lent, *fresh));
    changed.spectrogram.windowSeconds = 0.5;
    QVERIFY(analyse(r, changed, {.previous = before.get()})->time().step != before->time().step);
}

void tst_analyse::statisticSinkIsThePyramid()
{
    std::vector<float> statistic;
    const auto analysis = analysed(1, settings(), &statistic);
    const Index cells = analysis->grid().size();
    QCOMPARE(std::ssize(statistic), cells * analysis->time().count);
    for (Index frame : {Index(0), Index(400), analysis->time().count - 1}) {
        std::vector<std::uint8_t> bytes(static_cast<std::size_t>(cells));
        analysis->statistic->scale().encode(std::span(statistic).subspan(std::size_t(frame * cells), bytes.size()),
                                            bytes);
        QVERIFY(std::equal(bytes.begin(), bytes.end(), analysis->statistic->row(0, frame).begin()));
    }
    for (float value : statistic)
        QVERIFY(std::isfinite(value));
}

void tst_analyse::explanationAddsUp()
{
    std::vector<float> statistic;
    const auto analysis = analysed(1, settings(), &statistic);
    QVERIFY(!analysis->tracks.empty());
    const Track &track = analysis->tracks.front();
    const Index cells = analysis->grid().size();
    std::vector<std::pair<Index, Index>> places{{0, 5}, {100, 20}, {700, 3}}; // frame, cell
    places.emplace_back(track.detectFrame, track.points[std::size_t(track.detectFrame - track.onsetFrame)].cell);
    places.emplace_back(track.endFrame, track.points.back().cell);
    for (const auto &[frame, cell] : places) {
        const Explanation why =
            explain(*analysis, analysis->time().value(double(frame)), {analysis->grid().axes[0].value(double(cell))});
        double sum = 0.0;
        for (const PathStep &step : why.steps)
            sum += step.logLikelihoodRatio + step.lnTransition + step.lnK;
        QVERIFY(std::abs(sum - why.statistic) < 1e-6);
        const auto shown = double(statistic[std::size_t(frame * cells + cell)]);
        QVERIFY2(std::abs(why.statistic - shown) < 1e-3,
                 qPrintable(QString("frame %1: terms %2, shown %3").arg(frame).arg(why.statistic).arg(shown)));
        QCOMPARE(why.steps.back().frame, frame);
        QCOMPARE(analysis->model.space.cellOf(why.steps.back().state), cell);
    }
}

void tst_analyse::calibratedKHalvesNoise()
{
    // Billon's five slopes on his frames: ln K = +0.6997 by his rule, -0.0794 for stable lines (independent programs'
    // values).
    const auto five = calibrate(settings());
    QVERIFY2(std::abs(five->lnK - 0.6997) < 0.015, qPrintable(QString::number(five->lnK)));
    QVERIFY(std::abs(five->continuedFraction - 0.5) < 0.01);
    AnalysisSettings stable = settings();
    stable.model.lowestSlope = stable.model.highestSlope = 0;
    stable.model.slopeChange = {1.0};
    QVERIFY2(std::abs(calibrate(stable)->lnK + 0.0794) < 0.01, qPrintable(QString::number(calibrate(stable)->lnK)));
}

void tst_analyse::aKOutOfReachIsAnError()
{
    AnalysisSettings s = settings();
    s.model.snr = 50.0;
    const std::string said = test::errorOf([&] { calibrate(s); });
    QVERIFY2(said.starts_with("model.snr = 50: permits no ln K at which half of the states continue on noise: at 20 "
                              "nat "),
             said.c_str());
    QVERIFY2(said.ends_with("% do; choose a lower one"), said.c_str());
}

void tst_analyse::falseAlarmsAsOrdered_data()
{
    QTest::addColumn<int>("likelihood");
    QTest::newRow("rice") << int(LikelihoodKind::Rice);
    QTest::newRow("swerling4") << int(LikelihoodKind::Swerling4);
}

void tst_analyse::falseAlarmsAsOrdered()
{
    QFETCH(int, likelihood);
    // An hour of noise at 60 false alarms an hour; the Poisson interval at 1 in 10⁴ is 33 … 93.
    LineScene scene;
    scene.sampleRateHz = 2000.0;
    scene.durationSeconds = 3600.0;
    scene.seed = 41;
    AnalysisSettings s = settings();
    s.decide.falseAlarmsPerHour = 60.0;
    s.model.likelihood = static_cast<LikelihoodKind>(likelihood);
    const auto analysis = analyse(std::make_shared<SimulatedRecording>(scene), s);
    const auto count = int(analysis->tracks.size());
    QVERIFY2(count >= 33 && count <= 93, qPrintable(QString::number(count)));
}

void tst_analyse::noLinesInNoiseOfAnyKind_data()
{
    QTest::addColumn<double>("slopeDb");
    QTest::addColumn<double>("driftDb");
    QTest::newRow("falling") << -3.0 << 0.0;
    QTest::newRow("falling fast") << -6.0 << 0.0;
    QTest::newRow("rising fast") << 6.0 << 0.0;
    QTest::newRow("drifting level") << 0.0 << 1.5;
}

void tst_analyse::noLinesInNoiseOfAnyKind()
{
    // Ten minutes at 60 false alarms an hour, so 10 are ordered; more than 25 come once in 30000 times. Below 20 Hz
    // belongs a tenth of one; more than two come once in 6000 times.
    QFETCH(double, slopeDb);
    QFETCH(double, driftDb);
    LineScene scene;
    scene.sampleRateHz = 4000.0;
    scene.durationSeconds = 600.0;
    scene.seed = 43;
    scene.noise.slopeDbPerOctave = slopeDb;
    scene.noise.levelDriftDb = driftDb;
    scene.noise.levelDriftSeconds = 60.0;
    AnalysisSettings s = settings();
    s.spectrogram.window = WindowShape::Hann;
    s.spectrogram.binsPerCell = 2;
    s.decide.falseAlarmsPerHour = 60.0;
    const auto analysis = analyse(std::make_shared<SimulatedRecording>(scene), s);
    QVERIFY2(analysis->tracks.size() <= 25, qPrintable(QString::number(analysis->tracks.size())));
    const std::vector<Event> found = events(*analysis);
    QVERIFY(std::count_if(found.begin(), found.end(), [](const Event &event) { return event.position[0] < 20.0; })
            <= 2);
}

void tst_analyse::aConstantIsNoLine()
{
    // 30 deviations of constant beside the noise: nothing at 0 Hz nor beside it, unless that band was asked for.
    const auto noise = std::make_shared<SimulatedRecording>([] {
        LineScene scene;
        scene.sampleRateHz = 400.0;
        scene.durationSeconds = 60.0;
        scene.noise.deviation = 0.01;
        return scene;
    }());
    std::vector<float> samples(std::size_t(noise->info().sampleCount));
    noise->read(0, 0, noise->info().sampleCount, samples);
    for (float &sample : samples)
        sample += 0.3f;
    const auto recording = std::make_shared<test::MemoryRecording>(samples, 400.0);
    AnalysisSettings s = settings();
    QCOMPARE(analyse(recording, s)->tracks.size(), std::size_t(0));
    s.selection.highHz = 100.0;
    QVERIFY(!analyse(recording, s)->tracks.empty());
}

void tst_analyse::thresholdsAgree()
{
    const auto calibration = calibrate(settings());
    const double t = calibration->thresholdForEventRate(1e-7);
    QVERIFY(std::abs(calibration->eventRateAt(t) / 1e-7 - 1.0) < 1e-9);
    QVERIFY(calibration->thresholdForEventRate(1e-8) > t);
    const double p = calibration->thresholdForPfa(1e-3);
    QVERIFY(std::abs(calibration->exceedanceAt(p) / 1e-3 - 1.0) < 1e-6);
    QVERIFY(calibration->thresholdUncertainty(1e-7) > 0.0 && calibration->thresholdUncertainty(1e-7) < 2.0);
    for (std::size_t i = 1; i < calibration->levelCount(); ++i)
        QVERIFY(calibration->exceedance(i) <= calibration->exceedance(i - 1));
}

void tst_analyse::cancels()
{
    std::stop_source stop;
    stop.request_stop();
    RunContext context;
    context.stop = stop.get_token();
    QVERIFY_EXCEPTION_THROWN(analyse(recording(), settings(), {}, context), Cancelled);
}

void tst_analyse::readyMadeFrames()
{
    // Independent exponential cells with a constant line: found on the grid's own axes.
    const Grid grid{{{"range", "m", 100.0, 10.0, 40, false}}};
    Random random(8, 1);
    std::vector<float> y(40 * 200);
    for (std::size_t i = 0; i < y.size(); ++i)
        y[i] = float(random.exponential()) + (i / 40 >= 50 && i / 40 < 150 && i % 40 == 12 ? 8.0f : 0.0f);
    const auto frames = std::make_shared<FrameArray>(Axis{"time", "s", 0.0, 2.0, 200, false}, grid, std::move(y));
    AnalysisSettings s;
    const auto analysis = analyse(frames, s, {.model = makeModel(s.model, grid)});
    QCOMPARE(analysis->tracks.size(), std::size_t(1));
    const Event event = events(*analysis).front();
    QVERIFY(std::abs(event.position[0] - 220.0) <= 10.0);
    QVERIFY(std::abs(event.onsetSeconds - 100.0) <= 6.0 && std::abs(event.endSeconds - 298.0) <= 10.0);
}

// The tracker follows noise after the line for as long as it costs nothing; its track does not.
void tst_analyse::readyMadeTracksEndWithTheirLine()
{
    constexpr Index cells = 200;
    constexpr Index frames = 120;
    const Grid grid{{{"frequency", "Hz", 0.0, 1.0, cells, false}}};
    AnalysisSettings counting;
    setSetting(counting, "detector.kind", "pOfN");
    for (const AnalysisSettings &s : {AnalysisSettings(), preset("billon").settings, counting})
        for (int seed = 1; seed <= 6; ++seed) {
            Random random(std::uint64_t(seed), 3);
            std::vector<float> y(std::size_t(cells * frames));
            for (Index i = 0; i < cells * frames; ++i) {
                const Index frame = i / cells;
                const bool isLine = frame >= 30 && frame < 60 && i % cells == 20;
                y[std::size_t(i)] = float(random.exponential()) + (isLine ? 10.0f : 0.0f);
            }
            const Axis time{"time", "s", 0.0, 1.0, frames, false};
            const auto analysis = analyse(std::make_shared<FrameArray>(time, grid, std::move(y)), s);
            QVERIFY(!analysis->tracks.empty());
            const Track &track = analysis->tracks.front();
            QVERIFY2(std::abs(track.onsetFrame - 30) <= 3, qPrintable(QString::number(track.onsetFrame)));
            QVERIFY2(std::abs(track.endFrame - 59) <= 3, qPrintable(QString::number(track.endFrame)));
            QVERIFY(!track.isOpen);
        }
}

// A mean along the track, to a small part of a bin, whether it is looked at once or twice; the drift is beside it.
void tst_analyse::aLineBetweenBinsIsMeasured()
{
    LineScene scene;
    scene.sampleRateHz = 400.0;
    scene.durationSeconds = 100.0;
    LineSettings line;
    line.snrDb = 10.0;
    line.referenceSeconds = 0.25;
    line.frequencyHz = 90.7;
    line.driftHzPerSecond = 0.2;
    line.startSeconds = 20.0;
    line.durationSeconds = 60.0;
    scene.lines = {line};
    for (const bool bothWays : {false, true}) {
        AnalysisSettings s;
        s.spectrogram.windowSeconds = 0.25;
        s.track.bothWays = bothWays;
        const auto analysis = analyse(std::make_shared<SimulatedRecording>(scene), s);
        QCOMPARE(analysis->tracks.size(), std::size_t(1));
        const Event event = events(*analysis).front();
        const double middle = 0.5 * (event.onsetSeconds + event.endSeconds);
        const double truth = 90.7 + 0.2 * (middle - 20.0);
        const double bin = analysis->grid().axes.front().step;
        QVERIFY2(std::abs(event.position.back() - truth) < 0.1 * bin,
                 qPrintable(QString("%1 for %2").arg(event.position.back()).arg(truth)));
        QVERIFY2(std::abs(event.driftPerSecond - 0.2) < 0.01, qPrintable(QString::number(event.driftPerSecond)));
        QVERIFY(event.detectedPosition.back() < event.position.back() - 2.0 * bin);
    }
}

FAINTLINE_TEST(tst_analyse)
#include "tst_analyse.moc"
