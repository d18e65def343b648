#include "app/document/FrameKind.h"
#include "support/test.h"

#include "app/document/Document.h"
#include "app/document/FramePlace.h"

using namespace faintline;

/// What a document says of its frames, whatever their axes.
class tst_FrameKind : public QObject
{
    Q_OBJECT

private slots:
    void aGridHasAKind()
    {
        QCOMPARE(&frameKindOf(spectrum()), &lineFrames());
        QCOMPARE(&frameKindOf(ping()), &pingFrames());
        Grid scan = ping();
        for (int axes = 3; axes <= 4; ++axes) {
            scan.axes.push_back(scan.axes.front());
            QCOMPARE(&frameKindOf(scan), &scanFrames());
        }
        QVERIFY(scanFrames().isShownLike(pingFrames()) && !scanFrames().isShownLike(lineFrames()));
    }

    void everyKindHasItsWords()
    {
        for (const FrameKind *kind : {&lineFrames(), &pingFrames(), &scanFrames()}) {
            for (const QString &words :
                 {kind->frame, kind->frames, kind->cellsPerFrame, kind->cellPerFrame, kind->signal, kind->rate})
                QVERIFY(!words.isEmpty());
            QVERIFY(kind->cellsPerFrame.endsWith(kind->frame));
        }
        QTest::failOnWarning(QRegularExpression("Argument missing"));
        QCOMPARE(lineFrames().rateName(spectrum().axes[0]), QString("slope"));
        QCOMPARE(pingFrames().rateName(ping().axes[1]), QString("bearing rate"));
    }

    void nothingIsOpenLikeLines()
    {
        const Document document;
        QCOMPARE(&document.frameKind(), &lineFrames());
        QVERIFY(!document.lineAnalysis());
    }

    void boxesAreOfLines()
    {
        Document document;
        for (const bool isPing : {false, true}) {
            open(document, isPing ? ping() : spectrum());
            QVERIFY(!document.box());
            document.viewport().setSelection({{1.0, 2.0}, {3.0, 4.0}});
            QCOMPARE(document.box().has_value(), !isPing);
            auto analysis = std::make_shared<Analysis>();
            analysis->frames = document.frames();
            document.setAnalysis(analysis, {});
            QCOMPARE(document.lineAnalysis() != nullptr, !isPing);
            QVERIFY(document.analysis());
        }
    }

    void pingsAreLookedAtOneByOne()
    {
        Document document;
        for (const bool isPing : {false, true}) {
            open(document, isPing ? ping() : spectrum());
            document.viewport().zoomTo({2.0, 6.0}, {0.0, 8.0});
            QCOMPARE(document.lookedAt(), (Span{2.0, 6.0}));
            document.viewport().setCursor({3.0, 1.0});
            QCOMPARE(document.lookedAt(), isPing ? (Span{3.0, 3.0}) : (Span{2.0, 6.0}));
        }
    }

    void theCursorIsThatOfTheKind()
    {
        Document document;
        PingViewports pings(document.viewport());
        open(document, spectrum());
        QVERIFY(!cursorOf(document, pings));
        document.viewport().setCursor({3.0, 5.0});
        QCOMPARE(cursorOf(document, pings)->position, std::vector<double>{5.0});
        open(document, ping());
        pings.setPlace({4.0, {2.0, 180.0}});
        QCOMPARE(cursorOf(document, pings)->seconds, 4.0);
        QCOMPARE(cursorOf(document, pings)->position, (std::vector<double>{2.0, 180.0}));
    }

private:
    static Grid spectrum() { return {{{"frequency", "Hz", 0.0, 1.0, 8, false}}}; }
    static Grid ping() { return {{{"range", "m", 0.0, 1.0, 4, false}, {"bearing", "deg", 0.0, 90.0, 4, true}}}; }
    static void open(Document &document, const Grid &grid)
    {
        OpenedSource opened;
        opened.frames = std::make_shared<FrameArray>(Axis{"time", "s", 0.0, 1.0, 2, false}, grid,
                                                     std::vector<float>(std::size_t(2 * grid.size()), 1.0f));
        document.setOpened(opened, AnalysisSettings());
        document.viewport().setExtents({0.0, 10.0}, {0.0, 8.0});
    }
};

FAINTLINE_WINDOW_TEST(tst_FrameKind)
#include "tst_FrameKind.moc"
