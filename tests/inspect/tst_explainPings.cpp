// Why a cell of a ping has its statistic: Parsons' law of K, trackers and banks of models included.

#include "inspect/explain.h"
#include "support/test.h"

#include "scene/SimulatedPings.h"
#include "support/errors.h"
#include "support/pings.h"

#include <cmath>

using namespace faintline;

namespace {

PingScene scene()
{
    return test::recedingTarget(18, 60, 3200.0, 3);
}

/// All that a chain is made from; no calibration is needed, since K is Parsons' and the threshold given.
Analysis plan(Motion motion, double bankOffset = 0.0)
{
    Analysis analysis;
    analysis.settings = preset("sonar").settings;
    analysis.settings.model.motion = motion;
    analysis.settings.model.lowestSlope = -1;
    analysis.settings.model.highestSlope = 1;
    analysis.frames = std::make_shared<SimulatedPings>(scene());
    analysis.calibration = std::make_shared<Calibration>();
    analysis.threshold = 22.0;
    const std::vector<MarkovModel> models = makeModels(analysis.settings.model, analysis.grid());
    analysis.model = models.front();
    if (models.size() > 1)
        for (const MarkovModel &model : models)
            analysis.bank.push_back({model, analysis.calibration, analysis.bank.empty() ? 0.0 : bankOffset});
    return analysis;
}

void check(const Analysis &analysis, Index ping, Index range, Index beam, bool isTracked)
{
    const Grid &grid = analysis.grid();
    const Explanation why = explain(analysis, analysis.time().value(double(ping)),
                                    {grid.axes[0].value(double(range)), grid.axes[1].value(double(beam))});
    QCOMPARE(why.isTracked, isTracked);
    double sum = why.offset;
    for (const PathStep &step : why.steps)
        sum += step.logLikelihoodRatio + step.lnTransition + step.lnK;
    QVERIFY(std::abs(sum - why.statistic) < 1e-6);
    QVERIFY2(std::abs(why.displayed - why.statistic) < 1e-3,
             qPrintable(QString("shown %1, explained %2, of which %3 offset, model %4")
                            .arg(why.displayed)
                            .arg(why.statistic)
                            .arg(why.offset)
                            .arg(why.model)));
    QCOMPARE(why.steps.back().frame, ping);
    const StateSpace &space = analysis.modelAt(why.model).space;
    QCOMPARE(space.cellOf(why.steps.back().state), grid.cell({range, beam}));
}

} // namespace

class tst_explainPings : public QObject
{
    Q_OBJECT

private slots:
    void noiseAndTarget()
    {
        const Analysis analysis = plan(Motion::Slopes);
        check(analysis, 6, 40, 2, false);
        check(analysis, 0, 10, 0, false);
        // Cells 3200 m + 10 m a ping from ping 3 on: cell 20 + (ping - 3).
        check(analysis, 17, 34, 5, true);
        check(analysis, 17, 33, 5, true);
    }

    void ofABank()
    {
        const Analysis analysis = plan(Motion::Bank, 2.5);
        check(analysis, 5, 40, 2, false);
        check(analysis, 3, 20, 5, false);
        check(analysis, 14, 31, 5, true);
    }

    void refusalsNameTheAxis()
    {
        const Analysis analysis = plan(Motion::Slopes);
        const auto refusal = [&](const std::vector<double> &at) {
            return test::errorOf([&] { explain(analysis, 40.0, at); });
        };
        QVERIFY(refusal({9000.0, 0.0}).starts_with("range 9000 m"));
        QVERIFY(test::contains(refusal({2000.0, 0.0}), "must lie in 3000 … 3590 m"));
        QVERIFY(test::contains(refusal({3100.0, std::nan("")}), "bearing"));
        QVERIFY(refusal({3100.0, 720.0}).empty()); // bearings go round
    }
};

FAINTLINE_TEST(tst_explainPings)
#include "tst_explainPings.moc"
