#include "base/Random.h"
#include "recursion/finishMax.h"
#include "support/test.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace faintline;

namespace {

constexpr Index rowCells = 200;
constexpr Index margin = 8;

/// Rows of scores with a margin on either side, and what becomes of them.
struct Planes {
    explicit Planes(Index rows) : from(std::size_t(rows * rowCells)), to(from.size(), -1.0f)
    {
        Random(3, 0).exponentials(from);
        for (float &value : from)
            value -= 1.0f;
    }

    const float *row(Index number, Index shift) const { return from.data() + number * rowCells + margin - shift; }

    std::vector<float> from;
    std::vector<float> to;
};

struct List {
    std::vector<std::vector<ShiftedPlane<float>>> sources;
    std::vector<TargetPlane> targets(Planes &planes) const
    {
        std::vector<TargetPlane> all;
        for (std::size_t k = 0; k < sources.size(); ++k)
            all.push_back({sources[k], planes.to.data() + Index(k) * rowCells});
        return all;
    }
};

/// Slopes that change by at most one, of weights outer, inner, outer; a line goes down by the mean slope, rounded down.
List slopes(const Planes &planes, Index count, float outer, float inner)
{
    List list;
    for (Index to = 0; to < count; ++to) {
        list.sources.emplace_back();
        for (Index from = std::max<Index>(0, to - 1); from <= std::min(count - 1, to + 1); ++from)
            list.sources.back().push_back({planes.row(from, (from + to) / 2 % margin), from == to ? inner : outer});
    }
    return list;
}

/// As `slopes`, with a step from row to row that is the same everywhere.
List chained(const Planes &planes, Index count, float outer, float inner)
{
    List list;
    const auto at = [&](Index row, Index slope) {
        return planes.from.data() + row * (rowCells - 1) + margin - slope + 40;
    };
    for (Index to = 0; to < count; ++to) {
        list.sources.emplace_back();
        if (to > 0)
            list.sources.back().push_back({at(to - 1, 0), outer});
        list.sources.back().push_back({at(to, 0), inner});
        if (to + 1 < count)
            list.sources.back().push_back({at(to + 1, 1), outer});
    }
    return list;
}

List anything(const Planes &planes, Index count)
{
    List list;
    for (Index to = 0; to < count; ++to) {
        list.sources.emplace_back();
        for (Index k = 0; k < to % 6; ++k)
            list.sources.back().push_back({planes.row((to + k) % count, k), -0.25f * float(k % 4)});
    }
    return list;
}

List singles(const Planes &planes, Index count)
{
    List list;
    for (Index to = 0; to < count; ++to)
        list.sources.push_back({{planes.row(to, to % margin), 0.0f}});
    return list;
}

} // namespace

/// Every way of going through a frame, against the definition, cell by cell and to the last bit.
class tst_finishMax : public QObject
{
    Q_OBJECT

private slots:
    void isTheDefinition_data()
    {
        QTest::addColumn<QString>("law");
        QTest::addColumn<Index>("count");
        for (const char *law :
             {"uniform", "outer less", "inner less", "chained uniform", "chained outer less", "anything", "singles"})
            for (const Index count : {1, 2, 3, 21, 64, 65, 100})
                QTest::newRow(qPrintable(QString("%1, %2 targets").arg(law).arg(count))) << QString(law) << count;
    }

    void isTheDefinition()
    {
        QFETCH(const QString, law);
        QFETCH(const Index, count);
        Planes planes(count + 1);
        const List list = law == "uniform"              ? slopes(planes, count, -1.0f, -1.0f)
                          : law == "outer less"         ? slopes(planes, count, -1.5f, -0.5f)
                          : law == "inner less"         ? slopes(planes, count, -0.5f, -1.5f)
                          : law == "chained uniform"    ? chained(planes, count, -1.0f, -1.0f)
                          : law == "chained outer less" ? chained(planes, count, -1.5f, -0.5f)
                          : law == "anything"           ? anything(planes, count)
                                                        : singles(planes, count);
        std::vector<float> lambda(rowCells);
        Random(4, 0).exponentials(lambda);
        FrameJoin join;
        join.lnK = 0.3f;
        join.counting = Counting::StatesAndSum;
        for (const bool isFresh : {true, false})
            for (const Index n : {1, 15, 16, 33, 100}) {
                join.isFresh = isFresh;
                std::vector<float> statistic(rowCells, 2.0f);
                const Continued found = finishMax(list.targets(planes), {n}, lambda.data(), join, statistic.data());
                Index went = 0;
                double sum = 0.0;
                for (Index i = 0; i < n; ++i) {
                    float best = isFresh ? -std::numeric_limits<float>::infinity() : 2.0f;
                    for (Index k = 0; k < count; ++k) {
                        float m = -std::numeric_limits<float>::infinity();
                        for (const ShiftedPlane<float> &source : list.sources[std::size_t(k)])
                            m = std::max(m, source.from[i] + (source.weight + join.lnK));
                        const float kept = std::max(m, 0.0f);
                        const float score = kept + lambda[std::size_t(i)];
                        QVERIFY(planes.to[std::size_t(k * rowCells + i)] == score);
                        went += score > lambda[std::size_t(i)] ? 1 : 0;
                        sum += double(kept);
                        best = std::max(best, score);
                    }
                    QVERIFY(statistic[std::size_t(i)] == best);
                }
                QVERIFY(statistic[std::size_t(n)] == 2.0f); // values beyond the tile stay as they were
                QCOMPARE(found.count, went);
                QVERIFY(std::abs(found.sum - sum) <= 1e-5 * (1.0 + sum));
            }
    }
};

FAINTLINE_TEST(tst_finishMax)
#include "tst_finishMax.moc"
