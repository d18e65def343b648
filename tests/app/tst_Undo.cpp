// Two hundred random edits of all kinds, undone and redone; sessions that are the same bytes however often they are
// saved.

#include "app/base/filePath.h"
#include "app/document/Document.h"
#include "app/document/ViewState.h"
#include "exchange/Session.h"
#include "support/files.h"
#include "support/test.h"

#include <random>

using namespace faintline;
using namespace faintline::test;

namespace {

/// What a session keeps of a document.
struct Kept {
    RecordingPointer recording;
    std::size_t injections;
    AnalysisSettings settings;
    Annotations annotations;

    bool operator==(const Kept &) const = default;
};

Kept keptOf(const Document &document)
{
    return {document.recording(), document.source().injections.size(), document.settings(), document.annotations()};
}

class Edits
{
public:
    explicit Edits(unsigned seed) : m_random(seed) {}

    void editOnce(Document &document)
    {
        switch (upTo(10)) {
        case 0:
            return inject(document);
        case 1:
        case 2:
            return annotate(document);
        case 3:
        case 4:
            return review(document);
        default:
            return set(document);
        }
    }

private:
    int upTo(int count) { return std::uniform_int_distribution<int>(0, count - 1)(m_random); }
    double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(m_random); }

    void set(Document &document)
    {
        // Steps of one field that follow each other at once become one; of none they stay apart.
        const QString field = upTo(2) == 0 ? QString() : QStringLiteral("model.snr");
        AnalysisSettings after = document.settings();
        if (!field.isEmpty() || upTo(3) == 0)
            after.model.snr = number(0.1, 3.0);
        else if (upTo(2) == 0)
            after.decide.falseAlarmsPerHour = number(0.1, 100.0);
        else
            after.spectrogram.windowSeconds = number(0.1, 2.0);
        document.edit(after, "set", field);
    }

    void inject(Document &document)
    {
        Source::Injection injection;
        injection.line.line.frequencyHz = number(10.0, 400.0);
        injection.line.line.durationSeconds = 5.0;
        injection.line.amplitude = number(0.01, 0.2);
        injection.seed = std::uint64_t(upTo(1000));
        document.replaceOpened(withInjection(document.openedSource(), injection), "inject");
    }

    void annotate(Document &document)
    {
        Annotations after = document.annotations();
        if (!after.boxes.empty() && upTo(3) == 0) {
            after.boxes.erase(after.boxes.begin() + upTo(int(after.boxes.size())));
        } else {
            const double start = number(0.0, 20.0);
            Annotation box{start, start + number(0.0, 5.0), {}, {}, "box " + std::to_string(upTo(99)),
                           "",    Verdict(upTo(3))};
            if (upTo(2) == 0) {
                box.lowHz = number(0.0, 100.0);
                box.highHz = *box.lowHz + number(0.0, 100.0);
            }
            after.boxes.push_back(box);
        }
        document.annotate(after, "annotate");
    }

    void review(Document &document)
    {
        Annotations after = document.annotations();
        if (!after.reviews.empty() && upTo(2) == 0)
            after.reviews[std::size_t(upTo(int(after.reviews.size())))].note =
                "note " + std::to_string(upTo(99)) + " ½";
        else
            after.reviews.push_back(
                {{{{number(0.0, 1.0), number(2.0, 3.0)}, {{number(0.0, 9.0)}, {number(0.0, 9.0)}}, {0.5}}},
                 Verdict(1 + upTo(2)),
                 ""});
        document.annotate(after, "review");
    }

    std::mt19937 m_random;
};

} // namespace

class tst_Undo : public QObject
{
    Q_OBJECT

    QTemporaryDir m_folder;

    OpenedSource opened() const
    {
        const QString path = m_folder.filePath("scene.json");
        QFile scene(path);
        if (scene.open(QIODevice::WriteOnly))
            scene.write(R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 20, "lines": []})");
        scene.close();
        return openSource(sourceAt(path));
    }

private slots:
    void twoHundredEditsThereAndBack_data()
    {
        QTest::addColumn<unsigned>("seed");
        for (unsigned seed = 1; seed <= 4; ++seed)
            QTest::addRow("seed %u", seed) << seed;
    }

    void twoHundredEditsThereAndBack()
    {
        QFETCH(unsigned, seed);
        Document document;
        const OpenedSource source = opened();
        document.setOpened(source, firstSettings(source));
        const Kept before = keptOf(document);
        Edits edits(seed);
        std::vector<Kept> states{before}; // by the undo stack's index
        for (int i = 0; i < 200; ++i) {
            edits.editOnce(document);
            states.resize(std::size_t(document.undoStack().index()));
            states.push_back(keptOf(document));
        }
        QVERIFY(document.undoStack().count() > 100);
        QCOMPARE(std::size_t(document.undoStack().count()) + 1, states.size());

        const auto isThere = [&] { return keptOf(document) == states[std::size_t(document.undoStack().index())]; };
        while (document.undoStack().canUndo()) {
            document.undoStack().undo();
            QVERIFY(isThere());
        }
        QVERIFY(keptOf(document) == before);
        QVERIFY(!document.isModified());
        while (document.undoStack().canRedo()) {
            document.undoStack().redo();
            QVERIFY(isThere());
        }
    }

    void savedLoadedAndSavedAgainIsTheSame()
    {
        Document document;
        const OpenedSource source = opened();
        document.setOpened(source, firstSettings(source));
        Edits edits(7);
        ViewState view;
        view.visible = {{1.0 / 3.0, 12.1}, {-0.1, 400.0}};
        view.cursor = {0.1 + 0.2, 1e-9};
        for (int i = 0; i < 60; ++i) {
            edits.editOnce(document);
            const QString first = m_folder.filePath("first.faintline");
            const QString second = m_folder.filePath("second.faintline");
            writeSession(pathBytes(first),
                         {document.source(), {}, document.settings(), toJson(view), document.annotations()});
            const Session back = readSession(pathBytes(first));
            QVERIFY(back.settings == document.settings() && back.annotations == document.annotations());
            writeSession(pathBytes(second), back);
            QVERIFY(!readBytes(first).isEmpty());
            QCOMPARE(readBytes(second), readBytes(first));
        }
    }
};

FAINTLINE_WINDOW_TEST(tst_Undo)

#include "tst_Undo.moc"
