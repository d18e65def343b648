#include "base/Grid.h"
#include "support/test.h"

#include <cmath>
#include <set>

using namespace faintline;

namespace {

const Axis frequency{"frequency", "Hz", 100.0, 0.5, 5, false}; // 100, 100.5, … 102 Hz
const Axis bearing{"bearing", "°", 0.0, 90.0, 4, true};        // 0, 90, 180, 270°, and round again

} // namespace

/// Index ↔ physical value on one axis, and flat index ↔ coordinates on a product of axes.
class tst_Axis : public QObject
{
    Q_OBJECT

private slots:
    void valuesOfIndices()
    {
        QCOMPARE(frequency.value(0.0), 100.0);
        QCOMPARE(frequency.value(3.0), 101.5);
        QCOMPARE(frequency.value(0.5), 100.25);
        QCOMPARE(frequency.value(-2.0), 99.0);
        QCOMPARE(frequency.last(), 102.0);
    }

    void positionUndoesValue()
    {
        for (const Axis &axis :
             {frequency, bearing, Axis{"f", "Hz", -0.3, 1e-3, 7, false}, Axis{"t", "s", 1e6, 0.125, 9, false}})
            for (Index i = -3; i < axis.count + 3; ++i) {
                const auto index = double(i);
                QVERIFY(std::abs(axis.position(axis.value(index)) - index)
                        < 1e-9 * std::max(1.0, std::abs(axis.first / axis.step)));
            }
    }

    void nearestClamps()
    {
        QCOMPARE(frequency.nearest(100.0), Index(0));
        QCOMPARE(frequency.nearest(100.74), Index(1));
        QCOMPARE(frequency.nearest(100.76), Index(2));
        QCOMPARE(frequency.nearest(-1e300), Index(0));
        QCOMPARE(frequency.nearest(99.0), Index(0));
        QCOMPARE(frequency.nearest(103.0), Index(4));
        QCOMPARE(frequency.nearest(INFINITY), Index(4));
    }

    void nearestWraps()
    {
        QCOMPARE(bearing.nearest(89.0), Index(1));
        QCOMPARE(bearing.nearest(314.0), Index(3));
        QCOMPARE(bearing.nearest(316.0), Index(0));
        QCOMPARE(bearing.nearest(-90.0), Index(3));
        QCOMPARE(bearing.nearest(360.0 * 1000.0 + 180.0), Index(2));
        QCOMPARE(bearing.nearest(-360.0 * 1000.0 + 180.0), Index(2));
    }

    void nearestOfFarAway()
    {
        for (const double far : {1e18, 1e300, -1e300, double(INFINITY), -double(INFINITY), double(NAN)}) {
            QVERIFY(bearing.nearest(far) >= 0 && bearing.nearest(far) < 4);
            QCOMPARE(frequency.nearest(far), far > 0.0 ? Index(4) : Index(0));
        }
        QCOMPARE(bearing.nearest(NAN), Index(0));
    }

    void nearestOfHalves()
    {
        // Half-way goes up, on either side of 0.
        const Axis axis{"x", "", -2.0, 1.0, 5, false};
        QCOMPARE(axis.nearest(-1.5), Index(1));
        QCOMPARE(axis.nearest(0.5), Index(3));
    }

    void wrappedIndices()
    {
        QCOMPARE(frequency.wrapped(0), Index(0));
        QCOMPARE(frequency.wrapped(4), Index(4));
        QCOMPARE(frequency.wrapped(5), Index(-1));
        QCOMPARE(frequency.wrapped(-1), Index(-1));
        QCOMPARE(bearing.wrapped(3), Index(3));
        QCOMPARE(bearing.wrapped(4), Index(0));
        QCOMPARE(bearing.wrapped(-1), Index(3));
        QCOMPARE(bearing.wrapped(-4), Index(0));
        QCOMPARE(bearing.wrapped(-401), Index(3));
    }

    void emptyAxes()
    {
        Axis axis = frequency;
        for (bool cyclic : {false, true}) {
            axis.count = 0;
            axis.cyclic = cyclic;
            QCOMPARE(axis.nearest(100.0), Index(0));
            QCOMPARE(axis.wrapped(0), Index(-1));
        }
        QCOMPARE(Grid{}.size(), Index(0));
        QCOMPARE((Grid{{axis, bearing}}).size(), Index(0));
    }

    void cellsOfAGrid()
    {
        const Grid grid{{frequency, bearing}}; // 5 × 4, bearing contiguous
        QCOMPARE(grid.size(), Index(20));
        QCOMPARE(grid.cell({0, 0}), Index(0));
        QCOMPARE(grid.cell({0, 3}), Index(3));
        QCOMPARE(grid.cell({1, 0}), Index(4));
        QCOMPARE(grid.cell({4, 3}), Index(19));
        QCOMPARE(grid.coordinates(7), (std::vector<Index>{1, 3}));
    }

    void coordinatesUndoCell()
    {
        const Grid grid{
            {{"a", "", 0, 1, 3, false}, {"b", "", 0, 1, 1, true}, {"c", "", 0, 1, 4, true}, {"d", "", 0, 1, 2, false}}};
        std::set<std::vector<Index>> seen;
        for (Index cell = 0; cell < grid.size(); ++cell) {
            const std::vector<Index> coordinates = grid.coordinates(cell);
            QCOMPARE(grid.cell(coordinates), cell);
            seen.insert(coordinates);
        }
        QCOMPARE(seen.size(), std::size_t(3 * 1 * 4 * 2));
    }

    void neighboursAreAStrideApart()
    {
        const Grid grid{{{"a", "", 0, 1, 3, false}, {"b", "", 0, 1, 5, false}, {"c", "", 0, 1, 4, false}}};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::vector<Index> there{1, 1, 1};
            there[axis] = 2;
            QCOMPARE(grid.cell(there) - grid.cell({1, 1, 1}), grid.stride(axis));
        }
        QCOMPARE(grid.stride(0), Index(20));
        QCOMPARE(grid.stride(2), Index(1));
    }

    void offTheGrid()
    {
        const Grid grid{{frequency, bearing}};
        QCOMPARE(grid.cell({5, 0}), Index(-1));
        QCOMPARE(grid.cell({-1, 0}), Index(-1));
        QCOMPARE(grid.cell({2, 4}), grid.cell({2, 0}));
        QCOMPARE(grid.cell({2, -1}), grid.cell({2, 3}));
    }
};

FAINTLINE_TEST(tst_Axis)
#include "tst_Axis.moc"
