#include "refine/trimEnds.h"
#include "support/test.h"

using namespace faintline;

namespace {

/// A track from frame 100 on, with these probabilities that its signal is present.
Track track(const QList<float> &presence, Index detectFrame)
{
    Track made;
    for (const float present : presence) {
        made.points.push_back({100 + Index(made.points.size()), 7, 0, double(made.points.size())});
        made.smoothed.push_back({7.0, 6.5f, 7.5f, present, 4.0f});
    }
    made.onsetFrame = 100;
    made.detectFrame = detectFrame;
    made.endFrame = made.points.back().frame;
    made.isOpen = true;
    return made;
}

Track trimmed(const QList<float> &presence, Index detectFrame = 102)
{
    return withEndsTrimmed({track(presence, detectFrame)}).front();
}

} // namespace

/// Tracks end with their signals.
class tst_trimEnds : public QObject
{
    Q_OBJECT

private slots:
    void ends_data()
    {
        QTest::addColumn<QList<float>>("presence");
        QTest::addColumn<int>("first");
        QTest::addColumn<int>("last");
        QTest::addColumn<bool>("isOpen");
        QTest::newRow("present throughout") << QList<float>{0.9f, 1.0f, 0.8f} << 100 << 102 << true;
        QTest::newRow("later, and ended")
            << QList<float>{0.01f, 0.1f, 0.6f, 1.0f, 0.7f, 0.4f, 0.01f} << 101 << 105 << false;
        QTest::newRow("keyed") << QList<float>{0.1f, 0.4f, 0.9f, 0.1f, 0.0f, 0.9f} << 101 << 105 << true;
        QTest::newRow("in one frame") << QList<float>{0.0f, 0.2f, 0.6f, 0.3f, 0.0f} << 101 << 103 << false;
        QTest::newRow("beside what was not observed")
            << QList<float>{0.0f, 0.0f, 0.9f, 1.0f, 0.0f} << 102 << 103 << false;
        QTest::newRow("nowhere certain") << QList<float>{0.2f, 0.5f, 0.3f} << 100 << 102 << true;
    }

    void ends()
    {
        QFETCH(QList<float>, presence);
        QFETCH(int, first);
        QFETCH(int, last);
        QFETCH(bool, isOpen);
        const Track track = trimmed(presence);
        QCOMPARE(track.onsetFrame, Index(first));
        QCOMPARE(track.endFrame, Index(last));
        QCOMPARE(track.isOpen, isOpen);
        QCOMPARE(std::ssize(track.points), Index(last - first + 1));
        QCOMPARE(track.points.size(), track.smoothed.size());
        for (std::size_t i = 0; i < track.points.size(); ++i) {
            QCOMPARE(track.points[i].frame, track.onsetFrame + Index(i));
            QCOMPARE(track.smoothed[i].presence, presence[first - 100 + Index(i)]);
        }
    }

    void pausesHaveNoReportedPoints()
    {
        using Points = std::vector<std::size_t>;
        QCOMPARE(track({0.9f, 0.2f, 0.5f, 0.6f, 0.9f}, 102).presentPoints(), (Points{0, 3, 4}));
        QCOMPARE(track({0.4f, 0.9f, 0.2f, 0.8f, 0.3f}, 102).presentPoints(), (Points{0, 1, 3, 4})); // both ends remain
        QCOMPARE(track({0.4f, 0.5f, 0.2f}, 102).presentPoints(), (Points{0, 1, 2}));                // present nowhere
        Track once = track({0.9f, 0.1f, 0.9f}, 102);
        once.smoothed.clear();
        QCOMPARE(once.presentPoints(), (Points{0, 1, 2})); // without the second pass
    }

    void detectionIsInside()
    {
        const QList<float> presence{0.0f, 0.2f, 0.9f, 0.9f, 0.2f, 0.1f};
        QCOMPARE(trimmed(presence, 103).detectFrame, Index(103)); // as it was
        QCOMPARE(trimmed(presence, 100).detectFrame, Index(102));
        QCOMPARE(trimmed(presence, 105).detectFrame, Index(103));
        Track confirmed = track(presence, 103);
        confirmed.confirmFrame = 105;
        QCOMPARE(withEndsTrimmed({confirmed}).front().confirmFrame, Index(103));
    }

    void numberedByDetection()
    {
        const auto tracks = withEndsTrimmed({track({0.0f, 0.0f, 0.0f, 0.9f}, 100), track({0.9f, 0.9f, 0.9f}, 101)});
        QCOMPARE(tracks[0].detectFrame, Index(101));
        QCOMPARE(tracks[0].id, 1);
        QCOMPARE(tracks[1].detectFrame, Index(103));
        QCOMPARE(tracks[1].id, 2);
    }

    void withoutTheSecondPassNothingChanges()
    {
        Track later = track({0.0f, 0.9f, 0.0f}, 102);
        Track earlier = track({0.0f, 0.9f, 0.0f}, 101);
        later.id = 3;
        earlier.id = 4;
        for (Track *plain : {&later, &earlier})
            plain->smoothed.clear();
        const auto tracks = withEndsTrimmed({later, earlier});
        QCOMPARE(tracks[0].id, 3);
        QCOMPARE(tracks[1].id, 4);
        QCOMPARE(tracks[0].points.size(), std::size_t(3));
    }
};

FAINTLINE_TEST(tst_trimEnds)
#include "tst_trimEnds.moc"
