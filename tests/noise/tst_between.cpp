#include "noise/between.h"
#include "support/test.h"

#include <utility>

using namespace faintline;

/// Which two cells a value lies between, and how near to the upper one: by hand.
class tst_between : public QObject
{
    Q_OBJECT

private slots:
    void weightsBetweenCells()
    {
        const Axis axis{"frequency", "Hz", 100.0, 10.0, 4, false};
        const auto at = [&](double value) {
            const Between found = between(axis, value);
            return std::pair(found.lower, found.fraction);
        };
        QCOMPARE(at(100.0), std::pair(Index(0), 0.0));
        QCOMPARE(at(112.5), std::pair(Index(1), 0.25));
        QCOMPARE(at(130.0), std::pair(Index(2), 1.0)); // the last cell has no upper neighbour
        QCOMPARE(at(-1e9), std::pair(Index(0), 0.0));
        QCOMPARE(at(1e9), std::pair(Index(2), 1.0));
        const Axis single{"frequency", "Hz", 100.0, 10.0, 1, false};
        QCOMPARE(between(single, 500.0).lower, Index(0));
        QCOMPARE(between(single, 500.0).fraction, 0.0);
    }
};

FAINTLINE_TEST(tst_between)
#include "tst_between.moc"
