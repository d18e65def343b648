#include "app/cli/CommandLineTest.h"
#include "signal/formats/NumPy.h"
#include "support/test.h"

using namespace faintline;
using namespace faintline::test;

/// compare: two settings on one recording.
class tst_cliCompare : public CommandLineTest
{
    Q_OBJECT

private slots:
    void initTestCase() { simulateLine(); }

    void comparesTwoSettings()
    {
        const QStringList options{
            "compare", "line.wav", "--set-b", "detector.kind=energy", "--set-b", "decide.thresholdNats=500"};
        const Outcome one =
            run(options + QStringList{"--threads", "1", "--events", "compared1.csv", "--difference", "compared1.npy"}
                + lineSettings);
        QCOMPARE(one.err, QByteArray());
        QCOMPARE(one.code, 0);
        QVERIFY2(one.out.contains("  detector.kind: smd in A, energy in B\n"), one.out.data());
        QVERIFY2(one.out.contains("only in A: 1"), one.out.data());
        QVERIFY(content("compared1.csv").startsWith("in,event_a,event_b,t_onset,"));
        QVERIFY(content("compared1.csv").contains("\nA,1,,"));
        const NumPyArray difference = readNumPy(pathOf("compared1.npy"));
        QCOMPARE(difference.shape, (std::vector<Index>{119, 501}));

        const Outcome two =
            run(options + QStringList{"--threads", "2", "--events", "compared2.csv", "--difference", "compared2.npy"}
                + lineSettings);
        QCOMPARE(two.out, one.out);
        QVERIFY(content("compared2.csv") == content("compared1.csv"));
        QVERIFY(content("compared2.npy") == content("compared1.npy"));

        // The same on both sides: everything in both, no difference.
        const Outcome same = run(QStringList{"compare", "line.wav", "--difference", "same.npy"} + lineSettings);
        QVERIFY2(same.out.contains("their settings are the same\nin both: 1, only in A: 0, only in B: 0\n"),
                 same.out.data());
        for (const float value : readNumPy(pathOf("same.npy")).values)
            QCOMPARE(value, 0.0f);
    }
};

FAINTLINE_TEST(tst_cliCompare)
#include "tst_cliCompare.moc"
