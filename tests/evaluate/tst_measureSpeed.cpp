#include "app/cli/speed/measureSpeed.h"
#include "base/Error.h"
#include "base/json.h"
#include "support/test.h"

using namespace faintline;

/// What a run of the benchmarks says; how fast anything is, no test can judge.
class tst_measureSpeed : public QObject
{
    Q_OBJECT

private slots:
    void everyGoalNamesForms()
    {
        for (const char *name : {"likelihood", "background", "noise", "sum-product"}) // small ones: they are made here
            for (const SpeedKernel &kernel : speedKernels(name)) {
                std::vector<SpeedForm> forms = kernel.make();
                for (const SpeedGoal &goal : kernel.goals)
                    for (const std::string &wanted : {goal.faster, goal.slower})
                        QVERIFY(std::any_of(forms.begin(), forms.end(),
                                            [&](const SpeedForm &form) { return form.name == wanted; }));
            }
    }

    void namesAndWhatTheyBeginWith()
    {
        QCOMPARE(speedKernels("recursion").size(), std::size_t(3));
        QCOMPARE(speedKernels("noise").size(), std::size_t(1));
        QCOMPARE(speedKernels("all").size(), speedKernels().size());
    }

    void unknownName() { QVERIFY_THROWS_EXCEPTION(Error, speedKernels("recursio")); }

    void ratiosAndChecks()
    {
        int fastRuns = 0;
        int slowRuns = 0;
        const SpeedKernel kernel{"k",
                                 "title",
                                 "thing",
                                 {{"fast", "slow", 1e9}, {"slow", "fast", 0.0}},
                                 [&] {
                                     return std::vector<SpeedForm>{{"fast", 1.0, 1, [&] { ++fastRuns; }},
                                                                   {"slow", 1.0, 1, [&] { ++slowRuns; }}};
                                 },
                                 {{"error", 1.0, [] { return 0.5; }}}};
        const SpeedResult result = measureSpeed(kernel, {3, 1e-4});
        QVERIFY(fastRuns >= 4 && slowRuns >= 4); // once to warm up, then each round
        QCOMPARE(result.ratios.size(), std::size_t(2));
        QVERIFY(result.ratios[1].measured > 0.0);
        QVERIFY(speedText(result).find("MISSED") != std::string::npos);
        const Json json = Json::parse(speedJson({result}, {3, 1e-4}));
        QCOMPARE(json["kernels"][0]["ratios"][0]["met"].get<bool>(), false);
        QCOMPARE(json["kernels"][0]["checks"][0]["met"].get<bool>(), true);
    }
};

FAINTLINE_TEST(tst_measureSpeed)
#include "tst_measureSpeed.moc"
