#include "inspect/SignalNumbers.h"
#include "inspect/judgeByBoxes.h"
#include "support/test.h"

using namespace faintline;

namespace {

/// Tracks on bins of 1 Hz from 0 Hz, frames of a second: (first frame, cells one per frame).
Analysis analysisOf(const std::vector<std::pair<Index, std::vector<Index>>> &tracks,
                    Grid grid = {{{"frequency", "Hz", 0.0, 1.0, 400, false}}})
{
    Analysis analysis;
    const Axis time{"time", "s", 0.0, 1.0, 4, false};
    analysis.frames = std::make_shared<FrameArray>(time, grid, std::vector<float>(std::size_t(4 * grid.size()), 1.0f));
    for (const auto &[first, cells] : tracks) {
        Track track;
        track.id = int(analysis.tracks.size()) + 1;
        track.onsetFrame = track.detectFrame = first;
        for (Index cell : cells)
            track.points.push_back({first + std::ssize(track.points), cell, 0, 1.0});
        track.endFrame = first + std::ssize(cells) - 1;
        track.peakStatistic = 20.0;
        analysis.tracks.push_back(track);
    }
    return analysis;
}

std::vector<Index> line(Index from, Index step, Index count)
{
    std::vector<Index> cells;
    for (Index i = 0; i < count; ++i)
        cells.push_back(from + i * step);
    return cells;
}

std::vector<Verdict> verdicts(const Analysis &analysis, const std::vector<Review> &reviews)
{
    std::vector<Verdict> result;
    for (const EventReview &one : eventReviews(analysis, events(analysis), reviews))
        result.push_back(one.verdict);
    return result;
}

} // namespace

/// Reviews hold on to signals from run to run, and edits of them say what they mean.
class tst_Review : public QObject
{
    Q_OBJECT

private slots:
    void verdictStaysWithTheSignal()
    {
        const Analysis first = analysisOf({{10, line(100, 1, 40)}});
        const std::vector<Review> reviews = withVerdict({}, first, events(first), {1}, Verdict::Rejected);
        QCOMPARE(reviews.size(), std::size_t(1));
        // Found later, kept longer, two cells off, and under another number.
        const Analysis second = analysisOf({{5, line(300, 0, 20)}, {20, line(112, 1, 60)}});
        QCOMPARE(verdicts(second, reviews), (std::vector{Verdict::None, Verdict::Rejected}));
        // Found in two parts: what was said holds for both, which are one signal.
        const Analysis third = analysisOf({{10, line(100, 1, 15)}, {30, line(120, 1, 20)}});
        const std::vector<EventReview> both = eventReviews(third, events(third), reviews);
        QCOMPARE(both[0].verdict, Verdict::Rejected);
        QCOMPARE(both[1], (EventReview{2, Verdict::Rejected, "", 1}));
    }

    void anotherSignalIsNotMeant()
    {
        const Analysis first = analysisOf({{10, line(100, 0, 40)}});
        const std::vector<Review> reviews = withVerdict({}, first, events(first), {1}, Verdict::Accepted);
        QCOMPARE(verdicts(analysisOf({{10, line(103, 0, 40)}}), reviews).front(), Verdict::None); // three cells beside
        QCOMPARE(verdicts(analysisOf({{40, line(100, 0, 40)}}), reviews).front(),
                 Verdict::None); // too little in common
        QCOMPARE(verdicts(analysisOf({{50, line(100, 0, 40)}}), reviews).front(), Verdict::None); // afterwards
        QCOMPARE(verdicts(analysisOf({{30, line(100, 0, 40)}}), reviews).front(), Verdict::None);
        QCOMPARE(verdicts(analysisOf({{29, line(100, 0, 40)}}), reviews).front(),
                 Verdict::Accepted); // 20 of 39 seconds
    }

    void crossingLinesAreTwo()
    {
        const Analysis analysis = analysisOf({{0, line(100, 1, 41)}, {0, line(140, -1, 41)}});
        const std::vector<Review> reviews = withVerdict({}, analysis, events(analysis), {2}, Verdict::Rejected);
        QCOMPARE(verdicts(analysis, reviews), (std::vector{Verdict::None, Verdict::Rejected}));
    }

    void acrossTheSeamOfBearings()
    {
        const Grid grid{{{"range", "m", 0.0, 10.0, 20, false}, {"bearing", "deg", 0.0, 10.0, 36, true}}};
        // Range 5, bearings 34, 35, 0, 1.
        const Analysis analysis = analysisOf({{0, {5 * 36 + 34, 5 * 36 + 35, 5 * 36, 5 * 36 + 1}}}, grid);
        const SignalPath path = pathOf(analysis, events(analysis).front());
        QCOMPARE(path.position.back()[1], 370.0);
        const Analysis later = analysisOf({{1, {5 * 36 + 35, 5 * 36, 5 * 36 + 1}}}, grid);
        QCOMPARE(verdicts(later, withVerdict({}, analysis, events(analysis), {1}, Verdict::Accepted)).front(),
                 Verdict::Accepted);
    }

    void nothingSaidIsNoReview()
    {
        const Analysis analysis = analysisOf({{0, line(100, 0, 20)}});
        const std::vector<Event> all = events(analysis);
        std::vector<Review> reviews = withVerdict({}, analysis, all, {1}, Verdict::Accepted);
        reviews = withNote(reviews, analysis, all, 1, "mains");
        QCOMPARE(reviews.size(), std::size_t(1));
        reviews = withVerdict(reviews, analysis, all, {1}, Verdict::None);
        QCOMPARE(reviews.size(), std::size_t(1));
        QVERIFY(withNote(reviews, analysis, all, 1, "").empty());
        QVERIFY_EXCEPTION_THROWN(withNote({}, analysis, all, 7, "x"), Error);
    }

    void classesGoWithTheSignal()
    {
        const Analysis analysis = analysisOf({{0, line(100, 0, 20)}, {40, line(120, 0, 20)}, {80, line(200, 0, 20)}});
        const std::vector<Event> all = events(analysis);
        std::vector<Review> reviews = withLabel({}, analysis, all, {1, 3}, "whale");
        reviews = withLabel(reviews, analysis, all, {2}, "ship");
        QCOMPARE(eventReviews(analysis, all, reviews)[2], (EventReview{3, Verdict::None, "", 3, "whale"}));
        // Of several that become one, the first one's.
        const std::vector<Review> one = merged(reviews, analysis, all, {1, 2});
        QCOMPARE(eventReviews(analysis, all, one)[1].label, std::string("whale"));
        QCOMPARE(eventReviews(analysis, all, separated(one, analysis, all, {2}))[1].label, std::string("whale"));
        QVERIFY(withLabel(reviews, analysis, all, {1, 2, 3}, "").empty());
        QVERIFY_EXCEPTION_THROWN(withLabel({}, analysis, all, {7}, "x"), Error);
    }

    void mergeAndSeparate()
    {
        const Analysis analysis = analysisOf({{0, line(100, 0, 20)}, {40, line(120, 0, 20)}, {80, line(200, 0, 20)}});
        const std::vector<Event> all = events(analysis);
        std::vector<Review> reviews = withVerdict({}, analysis, all, {2}, Verdict::Accepted);
        reviews = withNote(reviews, analysis, all, 1, "fan");
        reviews = withNote(reviews, analysis, all, 2, "again");
        reviews = merged(reviews, analysis, all, {1, 2});
        QCOMPARE(reviews.size(), std::size_t(1));
        std::vector<EventReview> said = eventReviews(analysis, all, reviews);
        QCOMPARE(said[0], (EventReview{1, Verdict::Accepted, "fan; again", 1}));
        QCOMPARE(said[1], (EventReview{2, Verdict::Accepted, "fan; again", 1}));
        QCOMPARE(said[2], (EventReview{3, Verdict::None, "", 3}));
        QCOMPARE(merged(reviews, analysis, all, {1, 2}).front().paths.size(), std::size_t(2)); // once more is no more
        QCOMPARE(merged(reviews, analysis, all, {1, 2, 3}).front().paths.size(), std::size_t(3));

        said = eventReviews(analysis, all, separated(reviews, analysis, all, {1}));
        QCOMPARE(said[1], (EventReview{2, Verdict::Accepted, "fan; again", 2}));
        // Two that nothing was said about: what joins them is all there is.
        reviews = merged({}, analysis, all, {1, 3});
        QCOMPARE(eventReviews(analysis, all, reviews)[2].signal, 1);
        QVERIFY(separated(reviews, analysis, all, {3}).empty());
    }

    void drawnLinesStayWithTheSignal()
    {
        const Analysis analysis = analysisOf({{0, line(100, 1, 21)}, {40, line(140, 0, 21)}});
        const std::vector<Event> all = events(analysis);
        // 100 … 120 Hz in 0 … 20 s, cut at 6.5 s, where no instant of its path is.
        const std::vector<SignalPath> halves = cutAt(piecesOf({}, analysis, all[0]), 6.5);
        QCOMPARE(halves.size(), std::size_t(2));
        QCOMPARE(halves[0].seconds.back(), 6.5);
        QCOMPARE(halves[1].seconds.front(), 6.5);
        QCOMPARE(halves[0].position.back(), std::vector{106.5});
        QCOMPARE(halves[1].position.front(), std::vector{106.5});
        QCOMPARE(halves[0].seconds.size() + halves[1].seconds.size(), std::size_t(19)); // 17, and the cut twice
        QCOMPARE(cutAt(halves, 30.0), halves);
        QCOMPARE(cutAt(halves, 6.5), halves);

        const std::vector<Review> drawn = withDrawn({}, analysis, all, 1, halves);
        QCOMPARE(piecesOf(drawn, analysis, all[0]), halves);
        QCOMPARE(eventReviews(analysis, all, drawn)[0].drawn, halves);
        QVERIFY(eventReviews(analysis, all, drawn)[1].drawn.empty());
        const Json json = toJson(Annotations{drawn, {}});
        QVERIFY(annotationsFromJson(parseJson(json.dump(2), "x"), "x").reviews == drawn);
        QVERIFY(withDrawn(drawn, analysis, all, 1, {}).empty());
        // A line of any number of instants is read again; of a detected path, 17 are enough.
        SignalPath longLine{{}, {}, {2.0}};
        for (int i = 0; i < 5000; ++i) {
            longLine.seconds.push_back(i);
            longLine.position.push_back({100.0});
        }
        const Annotations patient{withDrawn({}, analysis, all, 1, {longLine}), {}};
        QVERIFY(annotationsFromJson(parseJson(toJson(patient).dump(), "x"), "x") == patient);
        QVERIFY_EXCEPTION_THROWN(signalPathFromJson(toJson(longLine), "path"), Error);

        // Joined: in one line where one follows the other, also with what was drawn of them.
        const std::vector<Review> joined = merged({}, analysis, all, {2, 1});
        const std::vector<SignalPath> whole = piecesOf(joined, analysis, all[1]);
        QCOMPARE(whole.size(), std::size_t(1));
        QCOMPARE(whole[0].seconds.front(), 0.0);
        QCOMPARE(whole[0].seconds.back(), 60.0);
        const std::vector<Review> both = merged(withDrawn({}, analysis, all, 1, {halves[0]}), analysis, all, {1, 2});
        QCOMPARE(both.front().drawn.size(), std::size_t(1));
        QCOMPARE(both.front().drawn[0].seconds[halves[0].seconds.size()], 40.0);
        QVERIFY(separated(both, analysis, all, {1}).empty());
    }

    void asJsonAndBack()
    {
        const Analysis analysis = analysisOf({{0, line(100, 1, 40)}, {50, line(120, 0, 1)}});
        Annotations annotations;
        annotations.reviews = merged({}, analysis, events(analysis), {1, 2});
        annotations.reviews = withNote(annotations.reviews, analysis, events(analysis), 1, "a \"note\", späť\t");
        annotations.reviews = withLabel(annotations.reviews, analysis, events(analysis), {1}, "späť");
        annotations.boxes = {{1.0, 2.0, 3.0, 4.5, "box", "", Verdict::Rejected},
                             {0.1, 0.2, {}, {}, "", "n", Verdict::None}};
        const Json json = toJson(annotations);
        QVERIFY(annotationsFromJson(parseJson(json.dump(2), "x"), "x") == annotations);
    }

    void hostileJson()
    {
        for (
            const char *text :
            {R"([])", R"({"boxes": [{"seconds": [2, 1], "label": ""}]})", R"({"boxes": [{"seconds": [1]}]})",
             R"({"boxes": [3]})", R"({"reviews": [{"paths": [{"seconds": [], "position": [], "tolerance": []}]}]})",
             R"({"reviews": [{"paths": [{"seconds": [1, 1], "position": [[1], [2]], "tolerance": [1]}]}]})",
             R"({"reviews": [{"paths": [{"seconds": [1], "position": [[1, 2]], "tolerance": [1]}]}]})",
             R"({"reviews": [{"paths": [], "drawn": [{"seconds": [2, 1], "position": [[1], [2]], "tolerance": [1]}]}]})",
             R"({"reviews": [{"verdict": "perhaps", "paths": []}]})", R"({"other": 1})"})
            QVERIFY_EXCEPTION_THROWN(annotationsFromJson(Json::parse(text), "annotations"), std::exception);
    }

    void boxesJudgeTheEventsInThem()
    {
        // One climbs from 100 to 139 Hz in 10 … 49 s, one stays at 300 Hz for 5 … 24 s.
        const Analysis analysis = analysisOf({{5, line(300, 0, 20)}, {10, line(100, 1, 40)}});
        const std::vector<Event> all = events(analysis);
        QCOMPARE(all.size(), std::size_t(2));
        const auto judge = [&](const Annotation &box) { return judgeByBoxes({}, analysis, all, {box}); };
        const auto box = [](double from, double to, double low, double high, Verdict verdict, const char *note = "") {
            return Annotation{from, to, low, high, "", note, verdict};
        };
        const JudgedByBoxes one = judge(box(10, 49, 100, 139, Verdict::Rejected, "mains"));
        QCOMPARE(one.judged, 1);
        QVERIFY(one.others.empty());
        QCOMPARE(verdicts(analysis, one.reviews), (std::vector{Verdict::None, Verdict::Rejected}));
        QCOMPARE(one.reviews.front().note, std::string("mains"));
        // Half of the shorter one's time is enough, less is not; the same of its points and the band.
        QCOMPARE(judge(box(30, 49, 100, 139, Verdict::Accepted)).judged, 1);
        QCOMPARE(judge(box(45, 80, 100, 139, Verdict::Accepted)).judged, 0);
        QCOMPARE(judge(box(10, 49, 122, 160, Verdict::Accepted)).judged, 1);
        QCOMPARE(judge(box(10, 49, 126, 160, Verdict::Accepted)).judged, 0);
        // Over all frequencies: all that is there in its time.
        QCOMPARE(judge(Annotation{0, 60, {}, {}, "", "", Verdict::Accepted}).judged, 2);
        // A note alone says something, a label alone does not; of several boxes the first counts.
        QCOMPARE(judge(box(5, 24, 299, 301, Verdict::None, "a fan")).reviews.size(), std::size_t(1));
        QCOMPARE(judge(Annotation{5, 24, 299.0, 301.0, "a fan", "", Verdict::None}).others.size(), std::size_t(1));
        const JudgedByBoxes two =
            judgeByBoxes(one.reviews, analysis, all,
                         {box(5, 24, 290, 310, Verdict::Accepted), box(0, 30, 290, 310, Verdict::Rejected)});
        QCOMPARE(verdicts(analysis, two.reviews), (std::vector{Verdict::Accepted, Verdict::Rejected}));
        QCOMPARE(two.judged, 1);
        QVERIFY(two.others.empty());
    }

    void numbersStayWithTheSignals()
    {
        using Signal = std::pair<Index, std::vector<Index>>;
        const Signal early{5, line(300, 0, 20)};
        const Signal climbing{10, line(100, 1, 40)};
        const Signal late{30, line(200, 0, 20)};
        SignalNumbers numbers;
        const auto numbered = [&numbers](const std::vector<Signal> &found) {
            std::vector<int> ids;
            const auto analysis = numbers.number(std::make_shared<const Analysis>(analysisOf(found)));
            for (const Track &track : analysis->tracks)
                ids.push_back(track.id);
            return ids;
        };
        QCOMPARE(numbered({early, climbing, late}), (std::vector{1, 2, 3}));
        QVERIFY(numbers.areUsual());
        QCOMPARE(numbered({{14, line(105, 1, 30)}, late}), (std::vector{2, 3})); // a higher threshold
        QVERIFY(!numbers.areUsual());
        QCOMPARE(numbered({{1, line(50, 0, 10)}, early, climbing, late}), (std::vector{4, 1, 2, 3})); // a lower one
        QCOMPARE(numbered({early, early}), (std::vector{1, 5})); // a number is given once

        numbers = SignalNumbers::fromJson(parseJson(toJson(numbers).dump(), "numbers"), "numbers");
        QCOMPARE(numbered({climbing, early}), (std::vector{2, 1}));
        for (const char *hostile :
             {R"([{"number": 2147483647, "path": {"seconds": [1], "position": [[1]], "tolerance": [1]}}])",
              R"([{"number": 0, "path": {"seconds": [1], "position": [[1]], "tolerance": [1]}}])",
              R"([{"number": 1, "path": {"seconds": [], "position": [], "tolerance": [1]}}])",
              R"([{"number": 1, "path": {}, "name": "x"}])"})
            QVERIFY_EXCEPTION_THROWN(SignalNumbers::fromJson(parseJson(hostile, "numbers"), "numbers"), Error);
    }
};

FAINTLINE_TEST(tst_Review)

#include "tst_Review.moc"
