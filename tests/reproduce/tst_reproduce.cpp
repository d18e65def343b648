#include "base/Random.h"
#include "reproduce/reproduce.h"
#include "support/test.h"

using namespace faintline;

namespace {

/// A table of frequencies of which all are what they should be, but for the first, by so much.
Reproduction tableOf(int cells, double shift, std::uint64_t seed)
{
    Random random(17, seed);
    Reproduction made;
    const int trials = 90;
    for (int i = 0; i < cells; ++i) {
        const double reference = 0.05 + 0.9 * i / std::max(1, cells - 1);
        int successes = 0;
        for (int trial = 0; trial < trials; ++trial)
            successes += random.uniform() < reference ? 1 : 0;
        ReproducedCell cell;
        cell.reference = i == 0 ? reference + shift : reference;
        cell.ours = double(successes) / trials;
        cell.interval = wilsonInterval(successes, trials);
        made.cells.push_back(cell);
    }
    judgeTogether(made);
    return made;
}

} // namespace

/// The verdict on a reproduction, and a few runs of the tables that take little time.
class tst_reproduce : public QObject
{
    Q_OBJECT

private slots:
    // 400 tables of 40 cells: by the 95 % of single cells nine tenths of them would fail.
    void chanceDoesNotFail()
    {
        int outside = 0;
        int outsideAlone = 0;
        for (std::uint64_t seed = 0; seed < 400; ++seed) {
            const Reproduction made = tableOf(40, 0.0, seed);
            outside += made.isInside() ? 0 : 1;
            outsideAlone +=
                std::all_of(made.cells.begin(), made.cells.end(),
                            [](const ReproducedCell &cell) { return cell.interval.contains(*cell.reference); })
                    ? 0
                    : 1;
        }
        QVERIFY2(outside <= 4, qPrintable(QString::number(outside))); // one is expected
        QVERIFY(outsideAlone > 200);
    }

    void aWrongCellFails()
    {
        int outside = 0;
        for (std::uint64_t seed = 0; seed < 50; ++seed)
            outside += tableOf(40, 0.25, seed).isInside() ? 0 : 1;
        QVERIFY2(outside >= 48, qPrintable(QString::number(outside)));
        // The scatter of a dozen runs is not known as well as that of many.
        ReproducedCell few = tableOf(1, 0.0, 1).cells.front();
        const Interval many = few.jointInterval();
        few.runs = 12;
        QVERIFY(few.jointInterval().high > many.high && few.jointInterval().low < many.low);
        // What is exact has no interval to be excused by.
        ReproducedCell exact;
        exact.reference = 1.0;
        exact.ours = 1.0 + 1e-6;
        exact.tolerance = 1e-9;
        QVERIFY(!exact.isInside());
    }

    void fewRuns_data()
    {
        QTest::addColumn<QString>("name");
        for (const char *name : {"billon:table2", "grossi:figure4", "parsons:figure2"})
            QTest::newRow(name) << name;
    }

    // A tenth of the trials. All tables with all of them: faintline-cli reproduce billon grossi parsons.
    void fewRuns()
    {
        QFETCH(QString, name);
        ReproduceOptions options;
        options.quick = true;
        const Reproduction made = reproducible(name.toStdString()).run(options, {});
        const auto judged = std::count_if(made.cells.begin(), made.cells.end(),
                                          [](const ReproducedCell &cell) { return cell.isJudged(); });
        QVERIFY(judged >= 4);
        for (const ReproducedCell &cell : made.cells)
            QVERIFY2(cell.isInside(),
                     qPrintable(QString("%1, %2: %3, not %4")
                                    .arg(QString::fromStdString(cell.row), QString::fromStdString(cell.column))
                                    .arg(cell.ours)
                                    .arg(cell.reference.value_or(0.0))));
    }
};

FAINTLINE_TEST(tst_reproduce)
#include "tst_reproduce.moc"
