#include "base/memoryShares.h"
#include "support/test.h"

using namespace faintline;

/// How much memory is kept, by hand.
class tst_memoryShares : public QObject
{
    Q_OBJECT

private slots:
    void orSomeAndInTheEnd()
    {
        QCOMPARE(memoryShares::orSome(10, 7), std::size_t(10));
        QCOMPARE(memoryShares::orSome(10, 70), std::size_t(70));
        // Sixteen frames of ten cells with their summaries, 16 + 4 + 1 rows; merged by four, 4 + 1.
        QCOMPARE(memoryShares::inTheEnd(1000, 16, 10), std::size_t(210));
        QCOMPARE(memoryShares::inTheEnd(210, 16, 10), std::size_t(210));
        QCOMPARE(memoryShares::inTheEnd(209, 16, 10), std::size_t(50));
        QCOMPARE(memoryShares::inTheEnd(49, 16, 10), std::size_t(10));
        QCOMPARE(memoryShares::inTheEnd(9, 16, 10), std::size_t(9)); // not even one row fits
    }
};

FAINTLINE_TEST(tst_memoryShares)
#include "tst_memoryShares.moc"
