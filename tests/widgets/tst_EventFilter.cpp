#include "support/test.h"
#include "widgets/events/EventFilter.h"

#include "pictures.h"
#include "widgets/events/EventModel.h"
#include "widgets/events/EventProxy.h"

using namespace faintline;

/// What a line of text lets through.
class tst_EventFilter : public QObject
{
    Q_OBJECT

private slots:
    void comparisons_data()
    {
        QTest::addColumn<QString>("text");
        QTest::addColumn<bool>("isAccepted");
        for (const auto &[text, isAccepted] : {std::pair("f>949.9", true),
                                               {"f>950", false},
                                               {"f>=950", true},
                                               {"f≥950", true},
                                               {"f<950", false},
                                               {"f<=950", true},
                                               {"f≤950", true},
                                               {"f=950", true},
                                               {"f=950.1", false},
                                               {"id=3", true},
                                               {"id=4", false},
                                               {"t>11", true},
                                               {"onset<12", false},
                                               {"detect=16", true},
                                               {"end>=20", true},
                                               {"dur>7.9", true},
                                               {"dur<8", false},
                                               {"stat>=31", true},
                                               {"d<31", false},
                                               {"D>30", true},
                                               {"F>9e2", true},
                                               {"drift<0", true},
                                               {"drift>-0.3", true},
                                               {"drift>−0.2", false},
                                               {"snr>-4", true},
                                               {"snr<-4", false},
                                               {"window=0.5", true}})
            QTest::newRow(text) << QString::fromUtf8(text) << isAccepted;
    }

    void comparisons()
    {
        QFETCH(QString, text);
        QFETCH(bool, isAccepted);
        Event tried = event();
        tried.driftPerSecond = -0.25;
        tried.snrDb = -3.0;
        tried.windowSeconds = 0.5;
        const EventFilter filter(text);
        QCOMPARE(filter.misunderstood(), QString());
        QCOMPARE(filter.accepts(tried), isAccepted);
    }

    void states_data()
    {
        QTest::addColumn<bool>("isConfirmed");
        QTest::addColumn<bool>("isOpen");
        for (const bool isConfirmed : {false, true})
            for (const bool isOpen : {false, true})
                QTest::addRow("confirmed %d open %d", isConfirmed, isOpen) << isConfirmed << isOpen;
    }

    void states()
    {
        QFETCH(bool, isConfirmed);
        QFETCH(bool, isOpen);
        Event tried = event();
        tried.isConfirmed = isConfirmed;
        tried.isOpen = isOpen;
        const auto accepts = [&](const char *text) { return EventFilter(text).accepts(tried); };
        QCOMPARE(accepts("open"), isOpen);
        QCOMPARE(accepts("o"), isOpen); // as far as it is typed
        QCOMPARE(accepts("!open"), !isOpen);
        QCOMPARE(accepts("!!open"), isOpen);
        QCOMPARE(accepts("confirmed"), isConfirmed);
        QCOMPARE(accepts("tentative"), !isConfirmed);
        QCOMPARE(accepts("!tent"), isConfirmed);
        QCOMPARE(accepts("confirmed open"), isConfirmed && isOpen);
    }

    void kinds()
    {
        Event tried = event();
        tried.kind = SignalKind::Spread;
        QVERIFY(EventFilter("spread !keyed !line").accepts(tried));
        QVERIFY(!EventFilter("line").accepts(tried));
        tried.kind = SignalKind::Keyed;
        QVERIFY(EventFilter("keyed !spread").accepts(tried));
    }

    void reviews_data()
    {
        QTest::addColumn<QString>("text");
        QTest::addColumn<std::vector<int>>("accepted");
        // 1 accepted; 2 rejected, with a note; 3 not reviewed; 4 the same signal as 1.
        QTest::newRow("accepted") << QString("accepted") << std::vector{1, 4};
        QTest::newRow("rejected") << QString("rej") << std::vector{2};
        QTest::newRow("not rejected") << QString("!rejected") << std::vector{1, 3, 4};
        QTest::newRow("unreviewed") << QString("unreviewed") << std::vector{3};
        QTest::newRow("merged") << QString("merged") << std::vector{4};
        QTest::newRow("noted") << QString("noted") << std::vector{2};
        QTest::newRow("both") << QString("accepted !merged") << std::vector{1};
        QTest::newRow("neither") << QString("accepted rejected") << std::vector<int>{};
    }

    void reviews()
    {
        QFETCH(QString, text);
        QFETCH(std::vector<int>, accepted);
        const EventReview reviews[] = {{1, Verdict::Accepted, {}, 1},
                                       {2, Verdict::Rejected, "hum", 2},
                                       {3, Verdict::None, {}, 3},
                                       {4, Verdict::Accepted, {}, 1}};
        const EventFilter filter(text);
        std::vector<int> found;
        for (const EventReview &review : reviews)
            if (filter.accepts(event(), review))
                found.push_back(review.event);
        QCOMPARE(found, accepted);
    }

    void allTermsMustHold()
    {
        QVERIFY(EventFilter("").accepts(event()));
        QVERIFY(EventFilter("   ").accepts(event()));
        QVERIFY(EventFilter("f>900  f<1000   stat>30").accepts(event()));
        QVERIFY(!EventFilter("f>900 f<1000 stat>32").accepts(event()));
    }

    void whatIsNotUnderstoodIsToldAndLetsThrough_data()
    {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("misunderstood");
        QTest::newRow("a word") << QString("f>900 what") << QString("what");
        QTest::newRow("the first of two") << QString("colour>3 what") << QString("colour>3");
        QTest::newRow("not yet typed") << QString("stat>") << QString("stat>");
        QTest::newRow("no number") << QString("f>loud") << QString("f>loud");
        QTest::newRow("two points") << QString("f>1.2.3") << QString("f>1.2.3");
        QTest::newRow("not of nothing") << QString("!") << QString("!");
        QTest::newRow("not of a word") << QString("!what") << QString("!what");
        QTest::newRow("not of a comparison") << QString("!f>100") << QString("!f>100");
        QTest::newRow("letters after the word") << QString("opens") << QString("opens");
    }

    void whatIsNotUnderstoodIsToldAndLetsThrough()
    {
        QFETCH(QString, text);
        QFETCH(QString, misunderstood);
        const EventFilter filter(text);
        QCOMPARE(filter.misunderstood(), misunderstood);
        QVERIFY(filter.accepts(event()));
        QVERIFY(!EventFilter(text + " id=99").accepts(event())); // the other terms go on
    }

    void whatIsNotKnownIsNeitherMoreNorLess()
    {
        Event tried = event();
        tried.confirmSeconds = tried.snrDb = std::numeric_limits<double>::quiet_NaN();
        for (const char *text : {"confirm>0", "confirm<=1e9", "confirm=0", "snr<100", "snr>=-100"})
            QVERIFY2(!EventFilter(text).accepts(tried), text);
    }

    void anEventWithoutAPlace()
    {
        Event tried = event();
        tried.position.clear();
        QVERIFY(!EventFilter("f>1").accepts(tried));
        QVERIFY(!EventFilter("range>1 bearing>1").accepts(tried));
    }

    void ofPingsRangeAndBearing()
    {
        Event tried = event();
        tried.position = {1250.0, 45.0};
        QVERIFY(EventFilter("range>1200 bearing<90").accepts(tried));
        QVERIFY(!EventFilter("range>1300").accepts(tried));
        QVERIFY(!EventFilter("bearing>=90").accepts(tried));
    }

    void theProxyShowsWhatTheFilterAccepts()
    {
        EventModel model;
        model.setEvents(
            {test::event(1, 5.0, 20.0, 950.0), test::event(2, 1.0, 2.0, 300.0), test::event(10, 3.0, 4.0, 2e4)});
        EventProxy proxy;
        proxy.setSourceModel(&model);
        QCOMPARE(proxy.rowCount(), 3);
        proxy.setFilter(EventFilter("f>500"));
        QCOMPARE(proxy.rowCount(), 2);
        proxy.setFilter(EventFilter("f>1e9"));
        QCOMPARE(proxy.rowCount(), 0);
        model.setEvents({test::event(4, 1.0, 2.0, 2e9)}); // new events, the same filter
        QCOMPARE(proxy.rowCount(), 1);
        proxy.setFilter({});
        QCOMPARE(proxy.rowCount(), 1);
    }

    void theProxyFollowsReviews()
    {
        EventModel model;
        model.setEvents({test::event(1, 5.0, 20.0, 950.0), test::event(2, 1.0, 2.0, 300.0)});
        EventProxy proxy;
        proxy.setSourceModel(&model);
        proxy.setFilter(EventFilter("!rejected"));
        QCOMPARE(proxy.rowCount(), 2);
        model.setReviews({{2, Verdict::Rejected, {}, 2}});
        QCOMPARE(proxy.rowCount(), 1);
        model.setReviews({});
        QCOMPARE(proxy.rowCount(), 2);
    }

private:
    /// 12 … 20 s, 950 Hz, D 31.
    static Event event() { return test::event(3, 12.0, 20.0, 950.0, 31.0); }
};

FAINTLINE_WINDOW_TEST(tst_EventFilter)
#include "tst_EventFilter.moc"
