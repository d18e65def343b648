#include "support/test.h"
#include "widgets/base/cellsOf.h"

using namespace faintline;

using Cells = std::pair<Index, Index>;

/// Which whole cells of an axis a span covers.
class tst_cellsOf : public QObject
{
    Q_OBJECT

private slots:
    void endsAreRoundedToTheNearestCell()
    {
        QCOMPARE(cellsOf(m_axis, {104.0, 110.0}), Cells(2, 6));
        QCOMPARE(cellsOf(m_axis, {104.9, 110.9}), Cells(2, 6));
        QCOMPARE(cellsOf(m_axis, {105.1, 111.1}), Cells(3, 7));
    }

    void aSpanOfNoWidthHasOneCell() { QCOMPARE(cellsOf(m_axis, {120.3, 120.3}), Cells(10, 11)); }

    void besideTheAxisAreItsEnds()
    {
        QCOMPARE(cellsOf(m_axis, {-1e9, 1e9}), Cells(0, 50));
        QCOMPARE(cellsOf(m_axis, {500.0, 600.0}), Cells(49, 50));
        QCOMPARE(cellsOf(m_axis, {0.0, 1.0}), Cells(0, 1));
    }

    void aCyclicAxisDoesNotWrap()
    {
        QCOMPARE(cellsOf(m_bearing, {180.0, 355.0}), Cells(18, 36)); // to the edge of its last cell
        QCOMPARE(cellsOf(m_bearing, {-5.1, 90.0}), Cells(0, 10));
    }

private:
    const Axis m_axis{"frequency", "Hz", 100.0, 2.0, 50, false};
    const Axis m_bearing{"bearing", "deg", 0.0, 10.0, 36, true};
};

FAINTLINE_TEST(tst_cellsOf)
#include "tst_cellsOf.moc"
