#include "app/features/pictures/Closeup.h"
#include "app/features/pictures/Workbench.h"
#include "app/openWindow.h"
#include "support/test.h"

using namespace faintline;
using namespace faintline::test;

/// Zoomed into a recording whose pictures hold rows of many frames, one sees single frames.
class tst_Closeup : public WindowTest
{
    Q_OBJECT

    std::shared_ptr<const Analysis> m_whole; ///< its rows are frames

    static std::shared_ptr<const PeakPyramid> merged(const PeakPyramid &picture)
    {
        const auto bytes = std::size_t(picture.frameCount() * picture.cells() / 8);
        auto result = std::make_shared<PeakPyramid>(picture.time(), picture.cells(), picture.scale(), bytes);
        for (Index frame = 0; frame < picture.frameCount(); ++frame)
            result->appendBytes(picture.row(0, frame));
        result->finish();
        return result;
    }

    Workbench &workbench() { return m_window->workbench(); }

    QImage canvas(WaterfallView *view)
    {
        view->setRange(0.0, 20.0); // colours are not what this is about
        return view->canvas()->grab().toImage();
    }

    /// The analysis as one of a recording too long for its pictures.
    void shorten()
    {
        auto analysis = std::make_shared<Analysis>(*m_whole);
        analysis->input = merged(*m_whole->input);
        analysis->statistic = merged(*m_whole->statistic);
        QVERIFY(analysis->input->framesPerRow(0) >= 16);
        m_window->document().setAnalysis(analysis, events(*analysis));
    }

    bool settle() { return faintline::test::settle(workbench().closeup()); }

private slots:
    void init()
    {
        QVERIFY(open(R"({"kind": "lines", "sampleRateHz": 400, "durationSeconds": 200, "lines": [{"snrDb": 6,
               "frequencyHz": 90}]})",
                     [](AnalysisSettings &settings) { settings.spectrogram.windowSeconds = 0.5; }));
        m_whole = m_window->document().analysis();
        QCOMPARE(m_whole->input->framesPerRow(0), Index(1));
    }
    void cleanup() { m_window.reset(); }

    void showsWhatALargerPictureWould()
    {
        Viewport &viewport = m_window->document().viewport();
        const Span time{70.3, 101.9}, band{40.0, 140.0};
        viewport.zoomTo(time, band);
        QVERIFY(!isBusy(workbench().closeup())); // rows are frames
        const QImage input = canvas(workbench().input());
        const QImage output = canvas(workbench().output());
        const auto value = workbench().output()->valueAt(80.1, 90.0);

        shorten();
        QVERIFY(isBusy(workbench().closeup()));
        QVERIFY(canvas(workbench().input()) != input); // merged rows meanwhile
        QVERIFY(settle());
        QCOMPARE(workbench().input()->shownPicture()->framesPerRow(0), Index(1));
        QCOMPARE(canvas(workbench().input()), input);
        QCOMPARE(canvas(workbench().output()), output);
        QCOMPARE(workbench().output()->valueAt(80.1, 90.0), value);
        QCOMPARE(workbench().output()->picture(),
                 m_window->document().analysis()->statistic); // that is still the whole one
    }

    void aLittleFartherNeedsNothingNew()
    {
        shorten();
        Viewport &viewport = m_window->document().viewport();
        viewport.zoomTo({70.0, 100.0}, viewport.full().frequency);
        QVERIFY(settle());
        const auto first = workbench().input()->shownPicture();
        viewport.pan(9.0, 0.0);
        QVERIFY(!isBusy(workbench().closeup()));
        QCOMPARE(workbench().input()->shownPicture(), first);

        viewport.pan(60.0, 0.0);
        QVERIFY(isBusy(workbench().closeup()));
        QCOMPARE(workbench().input()->shownPicture(), m_window->document().analysis()->input);
        QVERIFY(settle());
        QCOMPARE(workbench().input()->shownPicture()->framesPerRow(0), Index(1));
        QVERIFY(workbench().input()->shownPicture() != first);
    }

    void whoMovesOnDoesNotWait()
    {
        shorten();
        Viewport &viewport = m_window->document().viewport();
        for (int i = 0; i < 12; ++i) {
            viewport.zoomTo({10.0 * i, 10.0 * i + 30.0}, viewport.full().frequency);
            QTest::qWait(10 * i);
        }
        QVERIFY(settle());
        const PeakPyramid &shown = *workbench().output()->shownPicture(); // of the last view, none that came late
        QCOMPARE(shown.framesPerRow(0), Index(1));
        QVERIFY(shown.time().first <= viewport.time().low + 1.0 && shown.time().last() >= viewport.time().high - 1.0);
    }

    void anotherAnalysisIsLookedAtAnew()
    {
        shorten();
        Viewport &viewport = m_window->document().viewport();
        viewport.zoomTo({70.0, 100.0}, viewport.full().frequency);
        QVERIFY(settle());
        m_window->document().setAnalysis(m_whole, events(*m_whole));
        QCOMPARE(workbench().output()->shownPicture(), m_whole->statistic);
        QCOMPARE(workbench().input()->shownPicture(), m_whole->input);
        QVERIFY(!isBusy(workbench().closeup()));
    }
};

FAINTLINE_WINDOW_TEST(tst_Closeup)
#include "tst_Closeup.moc"
