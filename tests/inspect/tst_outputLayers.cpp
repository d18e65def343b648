#include "analyse/analyse.h"
#include "inspect/outputLayers.h"
#include "support/test.h"

#include "base/Random.h"
#include "inspect/explain.h"
#include "scene/SimulatedPings.h"
#include "support/frames.h"
#include "support/pings.h"

#include <algorithm>
#include <cmath>

using namespace faintline;

namespace {

constexpr Index frameCount = 120;
constexpr Index cellCount = 64;

/// Noise with a line that climbs a cell every third frame from frame 30 to 89.
std::shared_ptr<const Analysis> scaledInjection(SmdSettings::Reset reset, bool inhibits = true)
{
    std::vector<float> y(std::size_t(frameCount * cellCount));
    Random random(5, 1);
    random.exponentials(y);
    for (Index frame = 30; frame < 90; ++frame)
        y[std::size_t(frame * cellCount + 20 + (frame - 30) / 3)] += 5.0f;
    AnalysisSettings settings;
    settings.detector = SmdSettings{reset, 0.6};
    settings.decide.by = DecideSettings::By::Nats;
    settings.decide.thresholdNats = 14.0;
    settings.decide.inhibits = inhibits;
    settings.model.slopeChange = {0.5, 0.2, 0.05};
    return analyse(test::framesOf(cellCount, std::move(y), 0.25, 0.5), settings);
}

const std::shared_ptr<const Analysis> &analysed()
{
    static const auto result = scaledInjection(SmdSettings::Reset::Fixed);
    return result;
}

/// A target that recedes by a cell a ping and turns, on 40 × 6 cells, bearings all round.
std::shared_ptr<const Analysis> targetInPings(Motion motion)
{
    // No calibration is needed: K is Parsons' and the threshold given.
    auto analysis = std::make_shared<Analysis>();
    analysis->settings = preset("sonar").settings;
    analysis->settings.model.motion = motion;
    analysis->settings.model.lowestSlope = -1;
    analysis->settings.model.highestSlope = 1;
    analysis->frames = std::make_shared<SimulatedPings>(test::recedingTarget(18, 40, 3100.0, 3));
    analysis->calibration = std::make_shared<Calibration>();
    analysis->threshold = 22.0;
    const std::vector<MarkovModel> models = makeModels(analysis->settings.model, analysis->grid());
    analysis->model = models.front();
    for (std::size_t i = 0; i < models.size() && models.size() > 1; ++i)
        analysis->bank.push_back({models[i], analysis->calibration, i == 0 ? 0.0 : -1.0});
    return analysis;
}

} // namespace

class tst_outputLayers : public QObject
{
    Q_OBJECT

private slots:
    void ageAndRateAreThoseOfTheTracedPath_data()
    {
        QTest::addColumn<int>("reset");
        QTest::newRow("fixed") << int(SmdSettings::Reset::Fixed);
        QTest::newRow("half") << int(SmdSettings::Reset::Half);
    }

    void ageAndRateAreThoseOfTheTracedPath()
    {
        QFETCH(int, reset);
        const auto analysis = scaledInjection(static_cast<SmdSettings::Reset>(reset));
        QVERIFY(!analysis->tracks.empty()); // so some cells are a tracker's
        LayerReplay replay(analysis);
        int tracked = 0;
        int longPaths = 0;
        for (const Index frame : {0, 1, 7, 33, 50, 71, 92, 119}) {
            const CellLayers &layers = replay.at(frame);
            QCOMPARE(layers.frame, frame);
            for (Index cell = frame % 3; cell < cellCount; cell += 2) {
                const Explanation why = explain(*analysis, analysis->time().value(double(frame)),
                                                {analysis->grid().axes[0].value(double(cell))});
                const QByteArray where = QByteArray::number(frame) + " " + QByteArray::number(cell);
                const auto i = std::size_t(cell);
                QVERIFY2(double(layers.statistic[i]) == why.displayed, where);
                QVERIFY2(layers.age[i] + 1 == std::ssize(why.steps), where);
                QVERIFY2(layers.plane[i] == analysis->model.space.planeOf(why.steps.back().state), where);
                tracked += why.isTracked ? 1 : 0;
                longPaths += layers.age[i] > 20 ? 1 : 0;
            }
        }
        QVERIFY(tracked > 5);
        QVERIFY(longPaths > 5);
    }

    void pingsAreThoseOfTheTracedPath_data()
    {
        QTest::addColumn<int>("motion");
        QTest::newRow("one model") << int(Motion::Slopes);
        QTest::newRow("bank") << int(Motion::Bank);
    }

    void pingsAreThoseOfTheTracedPath()
    {
        QFETCH(int, motion);
        const auto analysis = targetInPings(static_cast<Motion>(motion));
        const Grid &grid = analysis->grid();
        LayerReplay replay(analysis);
        int tracked = 0;
        int longPaths = 0;
        int turning = 0;
        int models[2] = {0, 0};
        for (const Index ping : {0, 1, 4, 17, 12}) { // backwards, too
            const CellLayers &layers = replay.at(ping);
            for (Index cell = 1 + ping % 2; cell < grid.size(); cell += ping == 17 ? 7 : 31) {
                const std::vector<Index> c = grid.coordinates(cell);
                const Explanation why = explain(*analysis, analysis->time().value(double(ping)),
                                                {grid.axes[0].value(double(c[0])), grid.axes[1].value(double(c[1]))});
                const QByteArray where = QByteArray::number(ping) + " " + QByteArray::number(cell);
                const auto i = std::size_t(cell);
                const StateSpace &space = analysis->modelAt(why.model).space;
                QVERIFY2(double(layers.statistic[i]) == why.displayed, where);
                QVERIFY2(std::abs(why.statistic - why.displayed) < 1e-3, where);
                QVERIFY2(layers.model[i] == why.model, where);
                QVERIFY2(layers.age[i] + 1 == std::ssize(why.steps), where);
                QVERIFY2(layers.plane[i] == space.planeOf(why.steps.back().state), where);
                QVERIFY2(layers.isInhibited[i] || !why.inhibitedFor,
                         where); // a new track's box counts from the next ping on
                QVERIFY2(layers.resetFraction[i] >= 0.0f && layers.resetFraction[i] <= 1.0f, where);
                tracked += why.isTracked ? 1 : 0;
                longPaths += layers.age[i] > 5 ? 1 : 0;
                turning += space.ratesOfPlane(layers.plane[i])[1] != 0 ? 1 : 0;
                ++models[why.model];
            }
        }
        QVERIFY(tracked > 3);
        QVERIFY(longPaths > 5);
        QVERIFY(turning > 5);
        QVERIFY2(analysis->bank.empty() || (models[0] > 2 && models[1] > 2),
                 qPrintable(QString("%1 %2").arg(models[0]).arg(models[1])));
    }

    void aPingsPicture()
    {
        const auto analysis = targetInPings(Motion::Slopes);
        LayerReplay replay(analysis);
        const LayerPicture picture = layerPictureOf(replay, 15, {0, 40, 0, 6, 1000, 1000});
        QCOMPARE(picture.rows, Index(40));
        QCOMPARE(picture.columns, Index(6));
        const CellLayers &layers = replay.at(15);
        for (Index cell = 0; cell < 240; ++cell) {
            const CellReading reading = readCell(*analysis, layers, cell);
            const CellReading pixel = readPixel(picture, picture.pixelAt(cell / 6, cell % 6));
            QVERIFY(std::abs(pixel.ratePerSecond - reading.ratePerSecond) < 1e-5);
            QVERIFY(std::abs(pixel.secondRatePerSecond - reading.secondRatePerSecond) < 1e-5);
            QVERIFY(std::abs(pixel.ageSeconds - reading.ageSeconds) < 1e-4);
            QCOMPARE(pixel.isInhibited, reading.isInhibited);
        }
        // The target: a cell, 10 m, a ping, since ping 3 or so, and kept from the detector as its track has it.
        const std::size_t target = (10 + 15 - 3) * 6 + 5;
        QVERIFY(layers.age[target] >= 10);
        QVERIFY(picture.inhibited[target] > 0.0f);
        QVERIFY(std::abs(double(picture.rate[target]) - 10.0 / analysis->time().step) < 1e-5);
        QVERIFY(std::abs(largestRate(*analysis, 0) - 10.0 / analysis->time().step) < 1e-9);
        // Coarser, by 4 × 3: the cell of the largest D speaks for all.
        const LayerPicture coarse = layerPictureOf(replay, 15, {0, 40, 0, 6, 10, 2});
        QCOMPARE(coarse.rows * coarse.columns, Index(20));
        QCOMPARE(coarse.age[std::size_t(coarse.pixelAt(22, 5))], picture.age[target]);
        QCOMPARE(coarse.pixelAt(40, 0), Index(-1));
        // What is seen of a part begins on a whole pixel.
        const LayerPicture part = layerPictureOf(replay, 15, {21, 30, 4, 6, 5, 2});
        QCOMPARE(part.perRow, Index(2));
        QCOMPARE(part.firstRow, Index(10));
        QCOMPARE(part.age[std::size_t(part.pixelAt(22, 5))], picture.age[target]);
    }

    void backwardsIsTheSame()
    {
        LayerReplay straight(analysed());
        std::vector<CellLayers> all;
        for (Index frame = 0; frame < frameCount; ++frame)
            all.push_back(straight.at(frame));
        LayerReplay back(analysed(),
                         2 * 6 * std::size_t(cellCount * 5) * sizeof(float)); // six checkpoints
        for (const Index frame : {119, 118, 70, 40, 39, 60, 61, 20, 5, 0, 90}) {
            const CellLayers &layers = back.at(frame);
            const CellLayers &expected = all[std::size_t(frame)];
            QCOMPARE(layers.statistic, expected.statistic);
            QCOMPARE(layers.plane, expected.plane);
            QCOMPARE(layers.age, expected.age);
            QCOMPARE(layers.resetFraction, expected.resetFraction);
            QCOMPARE(layers.isInhibited, expected.isInhibited);
        }
    }

    void farIntoARunItBeginsWhereTheRunLeftACheckpoint()
    {
        const auto &analysis = analysed();
        QCOMPARE(analysis->checkpoints.count(), std::size_t(1)); // before frame 64
        Analysis alone = *analysis;
        alone.checkpoints.clear();
        LayerReplay straight(std::make_shared<const Analysis>(alone));
        int once = 0;
        int twice = 0;
        const auto compare = [&](Index frame, Index cell) {
            LayerReplay replay(analysis);
            int steps = 0;
            RunContext context;
            context.progress = [&](double, std::string_view) { ++steps; };
            const CellLayers &layers = replay.at(frame, context, {cell, cell + 1});
            const auto i = std::size_t(cell);
            const CellLayers &expected = straight.at(frame);
            QCOMPARE(layers.age[i], expected.age[i]);
            QCOMPARE(layers.plane, expected.plane);
            QCOMPARE(layers.statistic, expected.statistic);
            QCOMPARE(layers.resetFraction, expected.resetFraction);
            QCOMPARE(layers.isInhibited, expected.isInhibited);
            const bool isOlder = expected.age[i] > frame - 64; // once more, from the start
            QCOMPARE(Index(steps), frame + 1 - 64 + (isOlder ? frame + 1 : 0));
            ++(isOlder ? twice : once);
        };
        for (Index frame = 64; frame < frameCount; frame += 5)
            for (Index cell = 0; cell < cellCount; cell += 9)
                compare(frame, cell);
        QVERIFY2(once > 0 && twice > 0, qPrintable(QStringLiteral("%1 %2").arg(once).arg(twice)));
    }

    void resetFractionsAddUpToTheRuns()
    {
        // No track, nothing inhibited: the mean over all cells is what the run counted.
        AnalysisSettings settings = analysed()->settings;
        settings.decide.thresholdNats = 1000.0;
        const auto analysis = analyse(analysed()->frames, settings);
        LayerReplay replay(analysis);
        for (Index frame = 1; frame < frameCount; frame += 13) {
            const CellLayers &layers = replay.at(frame);
            double sum = 0.0;
            for (const float fraction : layers.resetFraction)
                sum += double(fraction);
            const double continued = 1.0 - sum / double(cellCount);
            QVERIFY(std::abs(continued - double(analysis->continuedFraction[std::size_t(frame)])) < 1e-6);
        }
    }

    void aLineOfOneBinSurvives()
    {
        LayerReplay replay(analysed());
        const LayerPicture fine = layerPicture(replay, {0, frameCount, 0, cellCount, 1000, 1000});
        QCOMPARE(fine.rows, frameCount);
        QCOMPARE(fine.columns, cellCount);
        const LayerPicture coarse = layerPicture(replay, {0, frameCount, 0, cellCount, 12, 8});
        QCOMPARE(coarse.perRow, Index(10));
        QCOMPARE(coarse.perColumn, Index(8));
        QCOMPARE(coarse.rows, Index(12));
        QCOMPARE(coarse.columns, Index(8));
        for (Index row = 0; row < coarse.rows; ++row)
            for (Index column = 0; column < coarse.columns; ++column) {
                std::size_t best = std::size_t(10 * row * cellCount + 8 * column);
                float inhibited = 0.0f;
                for (Index frame = 10 * row; frame < 10 * row + 10; ++frame)
                    for (Index cell = 8 * column; cell < 8 * column + 8; ++cell) {
                        const auto i = std::size_t(frame * cellCount + cell);
                        best = fine.statistic[i] > fine.statistic[best] ? i : best;
                        inhibited = std::max(inhibited, fine.inhibited[i]);
                    }
                const auto pixel = std::size_t(row * 8 + column);
                QCOMPARE(coarse.statistic[pixel], fine.statistic[best]);
                QCOMPARE(coarse.rate[pixel], fine.rate[best]);
                QCOMPARE(coarse.age[pixel], fine.age[best]);
                QCOMPARE(coarse.resetFraction[pixel], fine.resetFraction[best]);
                QCOMPARE(coarse.inhibited[pixel], inhibited);
            }
        // The line has lived for seconds, and climbs.
        const auto onLine = std::size_t(8 * 8 + 4); // frames 80 … 89, cells 32 … 39
        QVERIFY(coarse.age[onLine] > 8.0f);
        QVERIFY(coarse.statistic[onLine] > 14.0f);
        QCOMPARE(coarse.inhibited[onLine], 1.0f);
        QCOMPARE(coarse.values(OutputLayer::Age), coarse.age);
    }

    void aWindowIsAPartOfTheWhole()
    {
        LayerReplay replay(analysed());
        const LayerPicture whole = layerPicture(replay, {0, frameCount, 0, cellCount, 60, 32}); // by 2 × 2
        const LayerPicture part = layerPicture(replay, {41, 60, 11, 30, 10, 10});
        QCOMPARE(part.perRow, Index(2));
        QCOMPARE(part.perColumn, Index(2));
        QCOMPARE(part.firstRow, Index(20));
        QCOMPARE(part.firstColumn, Index(5));
        for (Index row = 0; row < part.rows; ++row)
            for (Index column = 0; column < part.columns; ++column)
                QCOMPARE(part.age[std::size_t(row * part.columns + column)],
                         whole.age[std::size_t((part.firstRow + row) * whole.columns + part.firstColumn + column)]);
    }

    void presenceLiesOnTheBands()
    {
        Analysis analysis = *analysed();
        // Wide and uncertain, from the middle of cell 9 to that of cell 12; narrow and certain, within cell 11; and a
        // track without a second pass.
        const auto track = [](Index frame, Index cell, std::vector<SmoothedPoint> smoothed) {
            Track made;
            made.points = {{frame, cell, 0, 20.0}};
            made.smoothed = std::move(smoothed);
            return made;
        };
        analysis.tracks = {track(3, 10, {{10.2, 9.0f, 12.0f, 0.6f, 1.0f}}),
                           track(3, 11, {{11.1, 11.0f, 11.2f, 0.9f, 1.0f}}), track(4, 20, {})};
        const LayerPicture fine = presencePicture(analysis, {0, frameCount, 0, cellCount, 1000, 1000});
        const auto at = [&](Index frame, Index cell) { return fine.presence[std::size_t(fine.pixelAt(frame, cell))]; };
        const float expected[] = {0.0f, 0.3f, 0.6f, 0.9f, 0.3f, 0.0f}; // cells 8 … 13
        for (Index cell = 8; cell <= 13; ++cell)
            QVERIFY(std::abs(at(3, cell) - expected[cell - 8]) < 1e-6f);
        QCOMPARE(at(4, 20), 1.0f);
        QCOMPARE(std::count_if(fine.presence.begin(), fine.presence.end(), [](float v) { return v > 0.0f; }), 5);
        QCOMPARE(fine.values(OutputLayer::Presence), fine.presence);
        // A pixel of many cells shows the largest value; a part of the window, that part.
        const LayerPicture coarse = presencePicture(analysis, {0, frameCount, 0, cellCount, 12, 8});
        QCOMPARE(coarse.presence[std::size_t(coarse.pixelAt(3, 9))], 0.9f);
        const LayerPicture part = presencePicture(analysis, {4, 10, 16, 32, 100, 100});
        QCOMPARE(part.rows, Index(6));
        QCOMPARE(part.presence[std::size_t(part.pixelAt(4, 20))], 1.0f);
        QCOMPARE(std::count_if(part.presence.begin(), part.presence.end(), [](float v) { return v > 0.0f; }), 1);
    }

    void nothingIsInhibitedWhereThatIsSwitchedOff()
    {
        for (const bool inhibits : {true, false}) {
            const auto analysis = scaledInjection(SmdSettings::Reset::Fixed, inhibits);
            LayerReplay replay(analysis);
            const Index cell = 20 + 50 / 3;
            QCOMPARE(readCell(*analysis, replay.at(80), cell).isInhibited, inhibits);
            const Axis &axis = analysis->grid().axes[0];
            const Explanation why = explain(*analysis, analysis->time().value(80.0), {axis.value(double(cell))});
            QCOMPARE(why.inhibitedFor.has_value(), inhibits);
        }
    }

    void aCellsReading()
    {
        LayerReplay replay(analysed());
        const CellReading reading = readCell(*analysed(), replay.at(80), 20 + 50 / 3);
        QVERIFY(reading.ageSeconds > 8.0);
        QVERIFY(reading.isInhibited);
        const double slope = 0.5 / 0.25 / analysed()->settings.model.slopesPerBin; // Hz/s between neighbours
        QVERIFY(std::abs(std::remainder(reading.ratePerSecond, slope)) < 1e-12);
        QVERIFY(std::abs(reading.ratePerSecond - 0.5 / 0.25 / 3.0)
                < 2.0 * slope); // the line climbs a cell in three frames
    }
};

FAINTLINE_TEST(tst_outputLayers)
#include "tst_outputLayers.moc"
