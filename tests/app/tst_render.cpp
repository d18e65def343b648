// Runs the program as a person would: `faintline render …`.

#include "support/files.h"
#include "support/slowdown.h"
#include "support/test.h"

#include <QImage>
#include <QImageReader>

using faintline::test::readBytes;

namespace {

struct Outcome {
    int exitCode = -1;
    QByteArray out;
    QByteArray error;
};

Outcome run(const QStringList &arguments, const QString &home = {})
{
    QProcess process;
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.remove("QT_QPA_PLATFORM"); // it finds its own
    if (!home.isEmpty()) {
        environment.insert("HOME", home);
        for (const char *elsewhere : {"FAINTLINE_CACHE", "XDG_CACHE_HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME"})
            environment.remove(elsewhere);
    }
    process.setProcessEnvironment(environment);
    process.start(QStringLiteral(FAINTLINE_BINARY_DIR "/app/faintline"), arguments);
    if (!process.waitForFinished(120000 * faintline::test::slowdown))
        return {};
    return {process.exitCode(), process.readAllStandardOutput(), process.readAllStandardError()};
}

QImage pixelsOf(const QString &path)
{
    return QImage(path).convertToFormat(QImage::Format_RGB32);
}

/// Every file and folder below one, with its content.
QMap<QString, QByteArray> contentBelow(const QString &folder)
{
    QMap<QString, QByteArray> all;
    for (QDirIterator entry(folder, QDir::AllEntries | QDir::Hidden | QDir::System | QDir::NoDotAndDotDot,
                            QDirIterator::Subdirectories);
         entry.hasNext();) {
        const QString path = entry.next();
        all[path] = entry.fileInfo().isDir() ? "folder" : readBytes(path);
    }
    return all;
}

} // namespace

class tst_render : public QObject
{
    Q_OBJECT

    QTemporaryDir m_folder;

    QString path(const QString &name) const { return m_folder.filePath(name); }

private slots:
    void initTestCase()
    {
        QFile file(path("scene.json"));
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.write(R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 40,
                       "lines": [{"snrDb": 8, "frequencyHz": 200, "driftHzPerSecond": 1}]})");
        file.close();
        QFile scans(path("scans.json"));
        QVERIFY(scans.open(QIODevice::WriteOnly));
        scans.write(
            R"({"kind": "scans", "azimuthCells": 1, "elevationCells": 1, "rangeCells": 20, "dopplerCells": 4,
               "stages": 12})");
        QFile experiment(path("experiment.json"));
        QVERIFY(experiment.open(QIODevice::WriteOnly));
        experiment.write(R"({"kind": "lines", "runs": 2, "frames": 60, "blockFrames": 30, "blockBins": 30,
                             "durationWindows": 10, "snrDb": [3, 6, 9],
                             "detectors": [{"name": "3 of 4", "settings": {"detector.kind": "pOfN"}}]})");
        experiment.close();
        QFile text(path("text.wav"));
        QVERIFY(text.open(QIODevice::WriteOnly));
        text.write("This is no sound.");
        QFile raw(path("raw.cf32"));
        QVERIFY(raw.open(QIODevice::WriteOnly));
        raw.write(QByteArray(80000, '\0'));
        QProcess simulation;
        simulation.start(QStringLiteral(FAINTLINE_BINARY_DIR "/app/faintline-cli"),
                         {"simulate", path("scene.json"), "--out", path("kept.wav")});
        QVERIFY(simulation.waitForFinished(120000 * faintline::test::slowdown) && simulation.exitCode() == 0);
        QCOMPARE(run({"render", path("kept.wav"), "--out", path("kept.png"), "--size", "400x300", "--view", "output",
                      "--set", "detector.kind=energy"})
                     .error,
                 QByteArray());
    }

    void twiceIsIdentical()
    {
        for (const QString &name : {QString("a.png"), QString("b.png")}) {
            const Outcome outcome = run({"render", path("scene.json"), "--out", path(name), "--size", "1200x800"});
            QCOMPARE(outcome.error, QByteArray());
            QCOMPARE(outcome.out, QByteArray());
            QCOMPARE(outcome.exitCode, 0);
        }
        QCOMPARE(QImage(path("a.png")).size(), QSize(1200, 800));
        QVERIFY(readBytes(path("a.png")) == readBytes(path("b.png")));
    }

    void aFinerScreenHasMorePixelsNotLargerOnes()
    {
        const auto picture = [&](const QString &name, const QStringList &more) {
            const Outcome outcome = run(QStringList{"render", path("scene.json"), "--view", "output,threshold",
                                                    "--size", "400x300", "--out", path(name)}
                                        + more);
            return outcome.error.isEmpty() && outcome.exitCode == 0;
        };
        QVERIFY(picture("plain.png", {}));
        QVERIFY(picture("one.png", {"--scale", "1"}));
        QVERIFY(picture("two.png", {"--scale", "2"}));
        QVERIFY(picture("quarter.png", {"--scale", "1.25"}));
        for (const QString &view : {QString("-output.png"), QString("-threshold.png")}) {
            QVERIFY(readBytes(path("plain" + view)) == readBytes(path("one" + view)));
            const QImage one(path("one" + view)), two(path("two" + view));
            QCOMPARE(two.size(), QSize(800, 600));
            QCOMPARE(QImage(path("quarter" + view)).size(), QSize(500, 375));
            // Blown up, every two by two pixels would be alike; here text, hairlines and cells are finer.
            int finer = 0;
            for (int y = 0; y < one.height(); ++y)
                for (int x = 0; x < one.width(); ++x)
                    finer += two.pixel(2 * x, 2 * y) != two.pixel(2 * x + 1, 2 * y)
                             || two.pixel(2 * x, 2 * y) != two.pixel(2 * x, 2 * y + 1);
            const int least =
                view == "-output.png" ? one.width() * one.height() / 10 : 400; // a raster; lines and words
            QVERIFY2(finer > least, qPrintable(QString::number(finer)));
        }
        QCOMPARE(run({"render", path("scene.json"), "--out", path("no.png"), "--scale", "0.5"}).exitCode, 2);
        for (const QString &option : {QString("--scale"), QString("--frequency")})
            QCOMPARE(run({"render", path("scene.json"), "--out", path("no.png"), option, "nan"}).exitCode, 2);
    }

    void aPictureIsMadeAgain()
    {
        const QString out = path("again.png");
        QCOMPARE(run({"render", path("scene.json"), "--out", out, "--size", "900x600", "--view", "output,threshold",
                      "--theme", "dark", "--layer", "age", "--time", "20", "--frequency", "220", "--set",
                      "decide.falseAlarmsPerHour=3"})
                     .error,
                 QByteArray());
        for (const QString &name : {QString("again-output.png"), QString("again-threshold.png")}) {
            const QString told = QImageReader(path(name)).text("provenance");
            QVERIFY2(told.contains("scenario") && told.contains("\"decide.falseAlarmsPerHour\":3.0")
                         && !told.contains(m_folder.path()),
                     qPrintable(told));
            const Outcome outcome = run({"replay", path(name)});
            QCOMPARE(outcome.error, QByteArray());
            QCOMPARE(outcome.out, name.toUtf8() + ": the same pixels\n");
        }
        const QStringList fine{"render", path("scene.json"), "--out",   path("fine.png"), "--view",
                               "output", "--size",           "400x300", "--scale",        "2"};
        QCOMPARE(run(fine).error, QByteArray());
        QCOMPARE(run({"replay", path("fine.png")}).out, QByteArray("fine.png: the same pixels\n"));
        // One pixel of another colour is seen, its text says what it should have been.
        QImage changed(path("again-output.png"));
        changed.setPixelColor(40, 40, Qt::red);
        QVERIFY(changed.save(path("changed.png")));
        Outcome outcome = run({"replay", path("changed.png")});
        QCOMPARE(outcome.exitCode, 1);
        QCOMPARE(outcome.out, QByteArray("changed.png: differs\n"));
        changed = QImage(path("again-output.png")).scaled(450, 300);
        changed.setText("provenance", QImageReader(path("again-output.png")).text("provenance"));
        QVERIFY(changed.save(path("small.png")));
        outcome = run({"replay", path("small.png")});
        QCOMPARE(outcome.exitCode, 2);
        QVERIFY2(outcome.error.contains("different size"), outcome.error.constData());
        changed.setText("provenance", "{\"recording\": 7}");
        QVERIFY(changed.save(path("broken.png")));
        for (const QString &name : {QString("broken.png"), QString("text.wav"), QString("none.png")}) {
            outcome = run({"replay", path(name)});
            QCOMPARE(outcome.exitCode, 2);
            QVERIFY2(outcome.error.startsWith("error: ") && outcome.error.count('\n') == 1, outcome.error.constData());
        }
    }

    void replayTouchesNothing_data()
    {
        QTest::addColumn<QByteArray>("from");
        QTest::addColumn<QByteArray>("to");
        QTest::addColumn<int>("exitCode");
        QTest::newRow("as it was made") << QByteArray() << QByteArray() << 0;
        QTest::newRow("another output") << QByteArray(R"("render":{)")
                                        << QByteArray(R"("render":{"out":"../mine.png","source":"../mine.wav",)") << 0;
        QTest::newRow("a view above") << QByteArray(R"("view":"output")") << QByteArray(R"("view":"../../mine")") << 2;
        QTest::newRow("no view") << QByteArray(R"("view":"output")") << QByteArray(R"("view":"/../../mine","views":[])")
                                 << 1;
        QTest::newRow("a theme that is a file")
            << QByteArray(R"("theme":"light")") << QByteArray(R"("theme":"../mine.json")") << 1;
        QTest::newRow("a recording elsewhere")
            << QByteArray(R"("path":"kept.wav")") << QByteArray(R"("path":"../mine.wav")") << 2;
        QTest::newRow("a recording far away")
            << QByteArray(R"("path":"kept.wav")") << QByteArray(R"("path":"@/mine.wav")") << 2;
    }

    /// Of a picture of somebody else's, in a folder of a home folder.
    void replayTouchesNothing()
    {
        QFETCH(QByteArray, from);
        QFETCH(QByteArray, to);
        QFETCH(int, exitCode);
        const QTemporaryDir home;
        const QString picture = home.filePath("gift/picture.png");
        QVERIFY(QDir(home.path()).mkpath("gift"));
        const bool isElsewhere = from.contains("kept.wav");
        QVERIFY(QFile::copy(path("kept.wav"), home.filePath(isElsewhere ? "mine.wav" : "gift/kept.wav")));
        for (const char *mine : {"mine.png", "mine.json"})
            QVERIFY(QFile::copy(path("text.wav"), home.filePath(mine)));
        QImage kept(path("kept.png"));
        QByteArray told = kept.text("provenance").toUtf8();
        QVERIFY2(from.isEmpty() || told.contains(from), told.constData());
        kept.setText("provenance",
                     QString::fromUtf8(told.replace(from.isEmpty() ? "{}" : from, to.isEmpty() ? "{}" : to)
                                           .replace("@", home.path().toUtf8())));
        QVERIFY(kept.save(picture));
        const auto before = contentBelow(home.path());
        const Outcome outcome = run({"replay", picture}, home.path());
        QVERIFY(contentBelow(home.path()) == before);
        QVERIFY2(outcome.exitCode == exitCode, (outcome.out + outcome.error).constData());
    }

    void everyViewBothThemes()
    {
        const QStringList views{"window", "input", "output", "threshold", "events", "noise"};
        for (const QString &theme : {QString("light"), QString("dark")}) {
            const Outcome outcome =
                run({"render", path("scene.json"), "--out", path(theme + ".png"), "--view", views.join(','), "--size",
                     "1200x700", "--theme", theme, "--time", "20", "--frequency", "220"});
            QCOMPARE(outcome.error, QByteArray());
            for (const QString &view : views)
                QCOMPARE(QImage(path(theme + "-" + view + ".png")).size(), QSize(1200, 700));
        }
        QVERIFY(pixelsOf(path("light-output.png")) != pixelsOf(path("dark-output.png")));
    }

    /// In a window of 640 pixels the pictures have the room of the panels, as if it had been opened at that size.
    void aSmallWindowHasNoPanels()
    {
        const Outcome outcome = run({"render", path("scene.json"), "--out", path("small.png"), "--size", "640x376"});
        QCOMPARE(outcome.error, QByteArray());
        const QImage picture(path("small.png"));
        QCOMPARE(picture.size(), QSize(640, 376));
        int dark = 0;
        for (int y = 100; y < 260; ++y)
            for (int x = 400; x < 540; ++x)
                dark += picture.pixelColor(x, y).lightness() < 128 ? 1 : 0;
        QVERIFY2(dark > 140 * 160 * 9 / 10, qPrintable(QString::number(dark))); // the statistic of noise
    }

    void radarScans()
    {
        const QStringList views{"sequential", "walk", "stopping", "posterior", "scan", "asn", "prior", "sectors"};
        const QStringList quick{"--size", "700x420", "--set", "runs.trials=20", "--set", "runs.walks=10"};
        for (const QString &name : {QString("s1.png"), QString("s2.png")}) {
            const Outcome outcome =
                run(QStringList{"render", path("scans.json"), "--out", path(name), "--view", views.join(',')} + quick);
            QCOMPARE(outcome.error, QByteArray());
        }
        for (const QString &view : views) {
            QCOMPARE(QImage(path("s1-" + view + ".png")).size(), QSize(700, 420));
            QVERIFY2(readBytes(path("s1-" + view + ".png")) == readBytes(path("s2-" + view + ".png")),
                     qPrintable(view));
        }
        const QStringList again{"render", path("scans.json"), "--out", path("s4.png"), "--view",
                                "walk",   "--time",           "1e300"};
        const Outcome other = run(again + quick + QStringList{"--set", "sprt.miss=0.1"});
        QCOMPARE(other.error, QByteArray());
        QVERIFY(pixelsOf(path("s4.png")) != pixelsOf(path("s1-walk.png")));
    }

    void aRecordingsSequentialTest()
    {
        const Outcome outcome = run(
            {"render", path("scene.json"), "--out", path("r.png"), "--view", "walk,posterior", "--size", "700x420"});
        QCOMPARE(outcome.error, QByteArray());
        QCOMPARE(QImage(path("r-posterior.png")).size(), QSize(700, 420));
    }

    void settingsCount()
    {
        const QStringList common{"render", path("scene.json"), "--view", "threshold", "--size", "600x400"};
        QCOMPARE(run(common + QStringList{"--out", path("t1.png")}).exitCode, 0);
        QCOMPARE(run(common + QStringList{"--out", path("t2.png"), "--set", "decide.thresholdNats=30"}).exitCode, 0);
        QCOMPARE(run(common + QStringList{"--out", path("t3.png"), "--preset", "steady"}).exitCode, 0);
        QVERIFY(pixelsOf(path("t1.png")) != pixelsOf(path("t2.png")));
        QVERIFY(pixelsOf(path("t1.png")) != pixelsOf(path("t3.png")));
    }

    void theSamePartAsOfTheCommandLine()
    {
        const QStringList scene{"render", path("scene.json"), "--view", "input", "--size", "700x500"};
        const QStringList named{"--set", "selection.fromSeconds=5", "--set", "selection.toSeconds=25",
                                "--set", "selection.lowHz=150",     "--set", "selection.highHz=1e12"};
        QCOMPARE(run(scene + named + QStringList{"--out", path("named.png")}).error, QByteArray());
        QCOMPARE(run(scene + QStringList{"--from", "5", "--to", "25", "--low", "150", "--out", path("part.png")}).error,
                 QByteArray());
        QCOMPARE(run(scene + QStringList{"--out", path("whole.png")}).error, QByteArray());
        QVERIFY(pixelsOf(path("part.png")) == pixelsOf(path("named.png")));
        QVERIFY(pixelsOf(path("part.png")) != pixelsOf(path("whole.png")));
    }

    void viewsOfPings()
    {
        QFile file(path("pings.json"));
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.write(
            R"({"kind": "pings", "pings": 16, "rangeCells": 80, "beams": 6, "targets": [{"snrDb": 12,
               "rangeMetres": 3200,
                       "bearingDegrees": 120, "appearPing": 3}]})");
        file.close();
        const QStringList views{"window", "input", "output", "map", "polar", "histories", "slice"};
        const QStringList nineRates{"--set", "model.motion=slopes", "--set", "model.lowestSlope=-1",
                                    "--set", "model.highestSlope=1"};
        for (const QString &name : {QString("p"), QString("q")}) {
            const Outcome outcome =
                run(QStringList{"render", path("pings.json"), "--out", path(name + ".png"), "--view", views.join(','),
                                "--size", "1280x800", "--time", "400", "--range", "3200", "--bearing", "120"}
                    + nineRates);
            QCOMPARE(outcome.error, QByteArray());
        }
        for (const QString &view : views) {
            QCOMPARE(QImage(path("p-" + view + ".png")).size(), QSize(1280, 800));
            QVERIFY2(readBytes(path("p-" + view + ".png")) == readBytes(path("q-" + view + ".png")), qPrintable(view));
        }
        QVERIFY(pixelsOf(path("p-map.png")) != pixelsOf(path("p-polar.png")));
    }

    void aStepOfALesson()
    {
        const QString lesson = QStringLiteral(FAINTLINE_SOURCE_DIR "/resources/lessons/cell.json");
        for (const QString &name : {QString("s"), QString("t")})
            QCOMPARE(run({"render", lesson, "--step", "3", "--size", "1280x800", "--out", path(name + ".png")}).error,
                     QByteArray());
        QCOMPARE(run({"render", lesson, "--step", "2", "--size", "1280x800", "--out", path("u.png")}).error,
                 QByteArray());
        QVERIFY(readBytes(path("s.png")) == readBytes(path("t.png")));
        QVERIFY(pixelsOf(path("s.png")) != pixelsOf(path("u.png")));
    }

    void curvesOfAnExperiment()
    {
        const QStringList asPd{"--view", "pd", "--size", "1000x500", "--out"};
        for (const QString &name : {QString("p1.png"), QString("p2.png")})
            QCOMPARE(run(QStringList{"render", path("experiment.json")} + asPd + QStringList{path(name)}).error,
                     QByteArray());
        QVERIFY(readBytes(path("p1.png")) == readBytes(path("p2.png")));
        QFile curve(path("curve.csv"));
        QVERIFY(curve.open(QIODevice::WriteOnly));
        curve.write(
            "detector,snr_db,pd,pd_low,pd_high,trials,threshold\n\"x\",3,0.5,0.4,0.6,99,\n\"x\",6,0.9,0.8,0.95,99,\n");
        curve.close();
        QCOMPARE(run(QStringList{"render", path("curve.csv")} + asPd + QStringList{path("c.png")}).error, QByteArray());
        QVERIFY(pixelsOf(path("c.png")) != pixelsOf(path("p1.png")));
    }

    void mistakesAreOneLineAndTwo_data()
    {
        QTest::addColumn<QStringList>("arguments");
        QTest::addColumn<QString>("about");
        const QString scene = path("scene.json");
        const QString out = path("never.png");
        QTest::newRow("no such file") << QStringList{"render", path("none.wav"), "--out", out} << "none.wav";
        QTest::newRow("no recording") << QStringList{"render", path("text.wav"), "--out", out} << "text.wav";
        QTest::newRow("raw without its rate") << QStringList{"render", path("raw.cf32"), "--out", out} << "--raw-rate";
        QTest::newRow("no out") << QStringList{"render", scene} << "--out";
        QTest::newRow("view") << QStringList{"render", scene, "--out", out, "--view", "moon"} << "moon";
        QTest::newRow("view of pings") << QStringList{"render", scene, "--out", out, "--view", "polar"} << "polar";
        QTest::newRow("another kind of picture")
            << QStringList{"render", scene, "--out", path("never.jpg")} << "must end in .png";
        QTest::newRow("another kind of page")
            << QStringList{"report", scene, "--out", path("never.pdf")} << "must end in .html";
        QTest::newRow("size") << QStringList{"render", scene, "--out", out, "--size", "big"} << "--size";
        QTest::newRow("small") << QStringList{"render", scene, "--out", out, "--size", "400x300"} << "--size";
        QTest::newRow("theme") << QStringList{"render", scene, "--out", out, "--theme", "pink"} << "theme";
        QTest::newRow("setting") << QStringList{"render", scene, "--out", out, "--set", "model.snr=-3"} << "model.snr";
        QTest::newRow("no setting") << QStringList{"render", scene, "--out", out, "--set", "moon=1"} << "moon";
        QTest::newRow("preset") << QStringList{"render", scene, "--out", out, "--preset", "moon"} << "moon";
        QTest::newRow("scans of a recording")
            << QStringList{"render", scene, "--out", out, "--view", "sectors"} << "sectors";
        const QString scans = path("scans.json");
        QTest::newRow("waterfall of scans") << QStringList{"render", scans, "--out", out, "--view", "input"} << "input";
        QTest::newRow("setting of scans") << QStringList{"render", scans, "--out", out, "--set", "moon=1"} << "moon";
        QTest::newRow("range of scans") << QStringList{"render", scans, "--out", out, "--set", "sprt.miss=7"}
                                        << "sprt.miss";
        const QString lesson = QStringLiteral(FAINTLINE_SOURCE_DIR "/resources/lessons/cell.json");
        QTest::newRow("step") << QStringList{"render", lesson, "--out", out, "--step", "99"} << "--step";
        QTest::newRow("step of a scene") << QStringList{"render", scene, "--out", out, "--step", "1"} << "--step";
        QTest::newRow("setting of a lesson")
            << QStringList{"render", lesson, "--out", out, "--set", "model.snr=1"} << "--set";
        const QString experiment = path("experiment.json");
        QTest::newRow("setting of an experiment")
            << QStringList{"render", experiment, "--out", out, "--set", "model.snr=1"} << "--set";
        QTest::newRow("waterfall of an experiment")
            << QStringList{"render", experiment, "--out", out, "--view", "input"} << "input";
        QTest::newRow("option") << QStringList{"render", scene, "--out", out, "--moon"} << "--moon";
        QTest::newRow("folder") << QStringList{"render", scene,     "--out", path("no/such/folder.png"),
                                               "--size", "1200x700"}
                                << "folder";
    }

    void mistakesAreOneLineAndTwo()
    {
        QFETCH(QStringList, arguments);
        QFETCH(QString, about);
        const Outcome outcome = run(arguments);
        QVERIFY2(outcome.error.startsWith("error: "), outcome.error.constData());
        QCOMPARE(outcome.error.count('\n'), 1);
        QVERIFY2(outcome.error.contains(about.toUtf8()), outcome.error.constData());
        QCOMPARE(outcome.out, QByteArray());
        QCOMPARE(outcome.exitCode, 2);
        QVERIFY(!QFile::exists(path("never.png")));
    }

    void helpAndVersion()
    {
        const Outcome help = run({"--help"});
        QCOMPARE(help.exitCode, 0);
        QVERIFY(help.out.contains("render"));
        QVERIFY(run({"render", "--help"}).out.contains("--out"));
        const Outcome version = run({"--version"});
        QCOMPARE(version.exitCode, 0);
        QVERIFY(version.out.startsWith("faintline "));
    }
};

FAINTLINE_TEST(tst_render)
#include "tst_render.moc"
