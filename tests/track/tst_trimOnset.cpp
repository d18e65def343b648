#include "support/test.h"
#include "track/DetectionChain.h"

using namespace faintline;

/// Where a path's score begins to grow, on scores that can be checked by eye.
class tst_trimOnset : public QObject
{
    Q_OBJECT

private slots:
    void onset_data()
    {
        QTest::addColumn<QList<double>>("scores");
        QTest::addColumn<int>("first");
        // Less half the mean growth, ½ nat a frame: 0, ½, -½, -1.3, 0, 1½.
        QTest::newRow("after noise") << QList<double>{1.0, 0.5, 0.2, 2.0, 4.0, 6.0} << 3;
        QTest::newRow("grows from the first frame") << QList<double>{1.0, 2.0, 3.0, 4.0} << 0;
        QTest::newRow("in the last frame only") << QList<double>{0.0, 0.0, 0.0, 8.0} << 3;
        QTest::newRow("one point") << QList<double>{5.0} << 0;
    }

    void onset()
    {
        QFETCH(QList<double>, scores);
        QFETCH(int, first);
        std::vector<TrackPoint> points;
        for (const double score : scores)
            points.push_back({Index(points.size()), 7, 0, score});
        trimOnset(points);
        QCOMPARE(points.size(), std::size_t(scores.size() - first));
        QCOMPARE(points.front().frame, Index(first));
        QCOMPARE(points.back().statistic, scores.back());
    }
};

FAINTLINE_TEST(tst_trimOnset)
#include "tst_trimOnset.moc"
