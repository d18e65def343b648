#include "refine/TrackPiece.h"
#include "support/test.h"

#include "refine/explainPath.h"

#include <cmath>

using namespace faintline;

/// Tracks cut into pieces, against the positions that a long path has by its own formula.
class tst_TrackPiece : public QObject
{
    Q_OBJECT

private slots:
    void aShortTrackIsOnePieceThatGoesOn();
    void nothingGoesOnBeyondTheRecording();
    void aLongTrackIsCutEvenly_data();
    void aLongTrackIsCutEvenly();
    void neighboursOverlapAtACut();
    void theSlopeIsThatOfTheEnds();
    void strongTracksHaveWideStrips();
};

namespace {

/// One point a frame, at `cell(i)`.
template <class Cell>
Track trackOf(Index first, Index count, Cell cell)
{
    Track track;
    for (Index i = 0; i < count; ++i)
        track.points.push_back({first + i, Index(cell(i)), 0, 0.0});
    track.peakStatistic = 0.5 * double(count);
    return track;
}

std::vector<TrackPiece> piecesOf(const Track &track, Index frames = 1000000, double binsPerCell = 1.0)
{
    std::vector<TrackPiece> pieces;
    addPieces(pieces, track, frames, binsPerCell);
    return pieces;
}

} // namespace

void tst_TrackPiece::aShortTrackIsOnePieceThatGoesOn()
{
    const Track track = trackOf(100, 40, [](Index i) { return 500 + 2 * i; });
    const std::vector<TrackPiece> pieces = piecesOf(track);
    QCOMPARE(pieces.size(), std::size_t(1));
    QVERIFY(pieces[0].isFirst() && pieces[0].isLast());
    QCOMPARE(pieces[0].track, &track);
    const PathStrip &strip = pieces[0].strip;
    QCOMPARE(strip.firstFrame, Index(84));             // sixteen frames before …
    QCOMPARE(strip.frameCount(), Index(16 + 40 + 16)); // … and after
    for (Index i = 0; i < strip.frameCount(); ++i)
        QCOMPARE(strip.centres[std::size_t(i)], 500 + 2 * (i - 16));
    QVERIFY(strip.y.empty());
}

void tst_TrackPiece::nothingGoesOnBeyondTheRecording()
{
    const Track track = trackOf(5, 30, [](Index) { return 70; });
    const PathStrip strip = piecesOf(track, 38)[0].strip; // 35 … 37 remain
    QCOMPARE(strip.firstFrame, Index(0));
    QCOMPARE(strip.frameCount(), Index(38));
}

void tst_TrackPiece::aLongTrackIsCutEvenly_data()
{
    QTest::addColumn<int>("length");
    QTest::addColumn<int>("pieces");
    QTest::newRow("limit") << 4096 << 1;
    QTest::newRow("one more") << 4097 << 2;
    QTest::newRow("three") << 10000 << 3;
    QTest::newRow("day") << 172800 << 43;
}

void tst_TrackPiece::aLongTrackIsCutEvenly()
{
    QFETCH(int, length);
    QFETCH(int, pieces);
    const Track track = trackOf(50, length, [](Index i) { return 300 + i / 7; });
    const std::vector<TrackPiece> found = piecesOf(track);
    QCOMPARE(found.size(), std::size_t(pieces));
    std::size_t next = 0;
    for (const TrackPiece &piece : found) {
        QCOMPARE(piece.from, next); // each point is in one piece
        QVERIFY(piece.to - piece.from <= 4096);
        QVERIFY(piece.to - piece.from >= std::size_t(length / pieces));
        QCOMPARE(piece.isFirst(), piece.from == 0);
        next = piece.to;
    }
    QCOMPARE(next, std::size_t(length));
    QVERIFY(found.back().isLast());
}

void tst_TrackPiece::neighboursOverlapAtACut()
{
    const auto cell = [](Index i) { return 400 + Index(std::lround(30.0 * std::sin(double(i) / 50.0))); };
    const Track track = trackOf(50, 5000, cell);
    const std::vector<TrackPiece> pieces = piecesOf(track);
    QCOMPARE(pieces.size(), std::size_t(2));
    const PathStrip &first = pieces[0].strip, &second = pieces[1].strip;
    QCOMPARE(first.firstFrame + first.frameCount(), Index(50 + 2500 + 64)); // sees 64 frames of the other
    QCOMPARE(second.firstFrame, Index(50 + 2500 - 64));
    for (const PathStrip *strip : {&first, &second})
        for (Index i = 0; i < strip->frameCount(); ++i)
            if (const Index point = strip->firstFrame + i - 50; point >= 0 && point < 5000)
                QCOMPARE(strip->centres[std::size_t(i)], cell(point));
}

void tst_TrackPiece::theSlopeIsThatOfTheEnds()
{
    // Level, then rising by a cell a frame: either end goes on as it is there, over its 24 frames.
    const Track track = trackOf(100, 200, [](Index i) { return i < 100 ? 50 : 50 + i - 100; });
    const PathStrip strip = piecesOf(track)[0].strip;
    QCOMPARE(strip.centres.front(), Index(50));
    QCOMPARE(strip.centres.back(), Index(50 + 99 + 16));
    const Track single = trackOf(100, 1, [](Index) { return 8; }); // has no slope
    const std::vector<TrackPiece> pieces = piecesOf(single);
    for (const Index centre : pieces[0].strip.centres)
        QCOMPARE(centre, Index(8));
}

void tst_TrackPiece::strongTracksHaveWideStrips()
{
    Track track = trackOf(100, 50, [](Index) { return 700; });
    const Index narrow = piecesOf(track)[0].strip.halfWidth;
    QVERIFY(narrow < skirtBins);
    QVERIFY(piecesOf(track, 1000000, 4.0)[0].strip.halfWidth > narrow); // resolution cells of several bins
    track.peakStatistic = 2.0 * 50.0;                                   // two nats a frame: not above
    QCOMPARE(piecesOf(track)[0].strip.halfWidth, narrow);
    track.peakStatistic = 2.1 * 50.0;
    QCOMPARE(piecesOf(track)[0].strip.halfWidth, skirtBins);
}

FAINTLINE_TEST(tst_TrackPiece)
#include "tst_TrackPiece.moc"
