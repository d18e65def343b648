#include "reproduce/reproduce.h"
#include "support/test.h"

using namespace faintline;

/// What of Parsons' paper can be checked within a second. The figures take seconds to minutes: `faintline-cli reproduce
/// parsons`.
class tst_reproduceParsons : public QObject
{
    Q_OBJECT

private slots:
    void allAreListed()
    {
        for (const char *name : {"figure1", "figure2", "figure3", "figure4", "figure5", "table2"})
            QVERIFY(!reproducible(std::string("parsons:") + name).title.empty());
    }

    void table2()
    {
        const Reproduction made = reproducible("parsons:table2").run({}, {});
        QCOMPARE(made.cells.size(), std::size_t(3));
        QVERIFY(made.isInside());
        // P(noise > 9.2 - 10^0.5), by hand.
        QVERIFY(std::abs(made.cells[0].ours - 100.0 * std::exp(-9.2 + std::sqrt(10.0))) < 1e-9);
        QCOMPARE(made.cells[2].paper.value(), 30.1); // printed beside ours, 28.46
        QVERIFY(std::abs(made.cells[2].ours - 28.46) < 0.01);
    }
};

FAINTLINE_TEST(tst_reproduceParsons)
#include "tst_reproduceParsons.moc"
