// Evidence along a path somebody names: sums one can check by hand, and the detector's own path.

#include "analyse/analyse.h"
#include "base/Error.h"
#include "inspect/explain.h"
#include "inspect/pathEvidence.h"
#include "scene/SimulatedRecording.h"
#include "support/frames.h"
#include "support/test.h"

using namespace faintline;

class tst_pathEvidence : public QObject
{
    Q_OBJECT

    /// Three frames of four cells, λ = y.
    static Analysis small()
    {
        Analysis analysis;
        analysis.frames = test::framesOf(4, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, 1.0, 10.0);
        return analysis;
    }

private slots:
    void sumsAreThoseOfTheCells()
    {
        const Analysis analysis = small();
        const PathEvidence evidence = evidenceAlong(analysis, std::vector<PathCell>{{0, 0}, {1, 2}, {2, 3}});
        QCOMPARE(evidence.frames, Index(3));
        QCOMPARE(evidence.logLikelihoodRatio, 1.0 + 7.0 + 12.0);
        QCOMPARE(evidence.meanPower, 20.0 / 3.0);
        QCOMPARE(evidence.snr(), 20.0 / 3.0 - 1.0);
        QCOMPARE(evidenceAlong(analysis, {}), PathEvidence());
    }

    void whatIsOutsideIsRefused()
    {
        const Analysis analysis = small();
        for (const PathCell at : {PathCell{3, 0}, PathCell{-1, 0}, PathCell{0, 4}, PathCell{0, -1}})
            QVERIFY_EXCEPTION_THROWN(evidenceAlong(analysis, std::span(&at, 1)), Error);
    }

    void polylinesGoThroughCells()
    {
        const Analysis analysis = small();
        using Path = std::vector<PathCell>;
        using Line = std::vector<PolylinePoint>;
        QCOMPARE(cellsAlong(analysis, Line{}), Path{});
        QCOMPARE(cellsAlong(analysis, (Line{{0.0, 100.0}, {2.0, 120.0}})), (Path{{0, 0}, {1, 1}, {2, 2}}));
        QCOMPARE(cellsAlong(analysis, (Line{{0.0, 100.0}, {1.0, 130.0}, {2.0, 100.0}})),
                 (Path{{0, 0}, {1, 3}, {2, 0}}));
        QCOMPARE(cellsAlong(analysis, (Line{{0.8, 110.0}})), (Path{{1, 1}}));
        QCOMPARE(cellsAlong(analysis, (Line{{-5.0, 110.0}, {9.0, 110.0}})), (Path{{0, 1}, {1, 1}, {2, 1}}));
        QCOMPARE(cellsAlong(analysis, (Line{{0.0, 100.0}, {2.0, 200.0}})), (Path{{0, 0}})); // the rest is off the axis
    }

    void theDetectorsOwnPathHasItsEvidence()
    {
        LineScene scene{.sampleRateHz = 1000.0, .durationSeconds = 30.0};
        LineSettings line{.snrDb = 6.0, .frequencyHz = 150.0, .driftHzPerSecond = 1.0};
        scene.lines.push_back(line);
        AnalysisSettings settings;
        settings.decide.by = DecideSettings::By::Nats;
        settings.decide.thresholdNats = 1000.0; // nothing is handed to a tracker: the path is all the detector's
        settings.detector = SmdSettings{SmdSettings::Reset::Fixed, 0.7664};
        const auto analysis = analyse(std::make_shared<SimulatedRecording>(scene), settings);
        const Explanation explanation = explain(*analysis, 20.0, {170.0});
        QVERIFY(explanation.steps.size() > 5);
        std::vector<PathCell> path;
        double sum = 0.0;
        for (const PathStep &step : explanation.steps) {
            path.push_back({step.frame, analysis->model.space.cellOf(step.state)});
            sum += step.logLikelihoodRatio;
        }
        const PathEvidence evidence = evidenceAlong(*analysis, path);
        QCOMPARE(evidence.frames, Index(std::ssize(path)));
        // The steps' λ are in single precision.
        QVERIFY(std::abs(evidence.logLikelihoodRatio - sum)
                < 1e-6 * double(path.size()) * std::max(1.0, std::abs(sum)));
    }
};

FAINTLINE_TEST(tst_pathEvidence)
#include "tst_pathEvidence.moc"
