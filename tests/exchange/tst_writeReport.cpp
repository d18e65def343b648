#include "exchange/writeReport.h"
#include "support/test.h"

using namespace faintline;

namespace {

Analysis tracksOf(int count, const Grid &grid = {{{"frequency", "Hz", 1000.0, 2.5, 100, false}}})
{
    Analysis analysis;
    analysis.frames = std::make_shared<FrameArray>(Axis{"time", "s", 0.25, 0.5, 10, false}, grid,
                                                   std::vector<float>(std::size_t(10 * grid.size()), 1.0f));
    Calibration calibration;
    calibration.levelStep = 10.0;
    calibration.above = {0.5, 1e-4};
    calibration.eventRate = 1e-5;
    analysis.calibration = std::make_shared<Calibration>(calibration);
    analysis.threshold = 12.5;
    analysis.cellFramesPerHour = 1e6;
    for (int id = 1; id <= count; ++id) {
        Track track{id, 1, 2, 6, 10.0 + id, true, false, {}};
        for (Index frame = 1; frame <= 6; ++frame)
            track.points.push_back({frame, 5 * id, 0, 1.0});
        analysis.tracks.push_back(track);
    }
    return analysis;
}

/// Tags balanced, references known: read as XML once what HTML may leave open is closed.
QString fault(const std::string &html)
{
    QString text = QString::fromStdString(html);
    text.remove("<!DOCTYPE html>");
    static const QRegularExpression open("<(meta|img)([^>]*)>");
    text.replace(open, "<\\1\\2/>");
    QXmlStreamReader reader(text);
    while (!reader.atEnd())
        reader.readNext();
    return reader.hasError() ? reader.errorString() : QString();
}

} // namespace

/// The page is well formed whatever recordings, notes and labels are called, and tells what it was given.
class tst_writeReport : public QObject
{
    Q_OBJECT

private slots:
    void wellFormedAndTheSameAgain()
    {
        const Analysis analysis = tracksOf(2);
        ReportMaterial material;
        material.title = "a<b>&\"c\".wav";
        material.version = "1";
        material.events = events(analysis);
        material.annotations.reviews = withVerdict({}, analysis, material.events, {1}, Verdict::Rejected);
        material.annotations.reviews =
            withNote(material.annotations.reviews, analysis, material.events, 2, "<script>alert(1)</script>");
        material.annotations.boxes = {{1.0, 2.0, {}, {}, "</td>", "", Verdict::None}};
        material.pictures = {{"title", std::string("\x89PNG\0x", 6), 3, 2}, {"t", "ab", 1, 1}, {"t", "abc", 1, 1}};
        material.provenance = "{\"settings\": {\"a\": \"<\"}}";
        const std::string page = reportHtml(analysis, material);
        QCOMPARE(fault(page), QString());
        QVERIFY(page.find("<script") == std::string::npos);
        QVERIFY(page.find("&lt;script&gt;") != std::string::npos);
        QVERIFY(page.find("base64," + QByteArray("\x89PNG\0x", 6).toBase64().toStdString() + "\"")
                != std::string::npos);
        QVERIFY(page.find("base64,YWI=\"") != std::string::npos);
        QVERIFY(page.find("base64,YWJj\"") != std::string::npos);
        QVERIFY(page.find("<tr class=\"rejected\"><td class=\"n\">1</td>") != std::string::npos);
        QVERIFY(page.find("href") == std::string::npos); // needs nothing else
        QVERIFY(page.find("http") == std::string::npos);
        QCOMPARE(reportHtml(analysis, material), page);
        QCOMPARE(fault(reportHtml(tracksOf(0), {})), QString());
    }

    void whoseLaddersAreShown()
    {
        const Analysis analysis = tracksOf(14);
        const std::vector<Event> all = events(analysis);
        const auto idsOf = [&](const Annotations &annotations) {
            std::vector<int> ids;
            for (const Event &event : eventsToExplain(analysis, all, annotations))
                ids.push_back(event.id);
            return ids;
        };
        QCOMPARE(idsOf({}), (std::vector<int>{14, 13, 12, 11, 10, 9, 8, 7, 6, 5})); // the strongest ten
        Annotations annotations;
        annotations.reviews = withVerdict({}, analysis, all, {14}, Verdict::Rejected);
        QCOMPARE(idsOf(annotations), (std::vector<int>{13, 12, 11, 10, 9, 8, 7, 6, 5, 4}));
        annotations.reviews = withVerdict(annotations.reviews, analysis, all, {2, 3}, Verdict::Accepted);
        QCOMPARE(idsOf(annotations), (std::vector<int>{2, 3}));
    }

    void areasAreListed()
    {
        Analysis analysis = tracksOf(1);
        QVERIFY(reportHtml(analysis, {}).find("Areas") == std::string::npos);
        // Frames every 0.5 s from 0.25 s on, bins of 2.5 Hz from 1000 Hz on; the second one is hardly raised.
        analysis.areas = {{2, 6, 40, 60, 4.0}, {2, 6, 80, 90, 1.1}};
        const std::string page = reportHtml(analysis, {});
        QCOMPARE(fault(page), QString());
        QVERIFY(page.find("<h2>Areas of raised level without a line</h2>") != std::string::npos);
        QVERIFY(page.find("<td class=\"n\">1.25</td><td class=\"n\">3.25</td><td class=\"n\">1100.00</td>"
                          "<td class=\"n\">1150.00</td><td class=\"n\">6.0</td>")
                != std::string::npos);
        QVERIFY(page.find("1200.00") == std::string::npos);
    }

    void axesWithoutAUnitHaveNoParentheses()
    {
        const Analysis analysis = tracksOf(1, {{Axis::unnamed(1, 20), Axis::unnamed(2, 5)}});
        ReportMaterial material;
        material.events = events(analysis);
        const std::string page = reportHtml(analysis, material);
        QVERIFY(page.find("Axis 1</th>") != std::string::npos);
        QVERIFY(page.find("Axis 2 rate (1/s)</th>") != std::string::npos);
        QVERIFY(page.find("()") == std::string::npos);
    }
};

FAINTLINE_TEST(tst_writeReport)

#include "tst_writeReport.moc"
