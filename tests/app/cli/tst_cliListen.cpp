#include "app/cli/CommandLineTest.h"
#include "support/files.h"
#include "support/test.h"

#include <csignal>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

using namespace faintline;
using namespace faintline::test;

/// `listen` from outside: what comes through a pipe is detected in and recorded, and its recording gives the same.
class tst_cliListen : public CommandLineTest
{
    Q_OBJECT

private slots:
    void initTestCase();
    void pipeGivesWhatItsRecordingGives_data();
    void pipeGivesWhatItsRecordingGives();
    void linesAreJson();
    void commandsGetTheLineAsItIs();
    void fifo();
    void stopsWithinASecond_data();
    void stopsWithinASecond();
    void aKillLosesNoMoreThanASecond();
    void mistakes_data();
    void mistakes();
    void overBeforeAWindow();
    void silenceIsTold();
    void memoryStaysFlat();

private:
    Outcome listen(const QStringList &arguments, const QByteArray &input) const;
    static QByteArray wav(const QByteArray &samples, int bits = 16, quint32 length = 0xffffffffu, quint16 channels = 1);
};

namespace {

const QStringList settings{"--set", "spectrogram.windowSeconds=0.25", "--set", "decide.falseAlarmsPerHour=10"};
const QStringList causal{"--set", "noise.causal=true"};

} // namespace

/// A header as programs write it that do not know how much will follow.
QByteArray tst_cliListen::wav(const QByteArray &samples, int bits, quint32 length, quint16 channels)
{
    const auto sampleBytes = quint32(channels * bits / 8);
    return "RIFF" + littleEndian(length, 4) + "WAVEfmt " + littleEndian(16, 4) + littleEndian(1, 2)
           + littleEndian(channels, 2) + littleEndian(1000, 4) + littleEndian(1000 * sampleBytes, 4)
           + littleEndian(sampleBytes, 2) + littleEndian(quint32(bits), 2) + "LIST" + littleEndian(5, 4) + "INFO0"
           + QByteArray(1, '\0') + "data" + littleEndian(length, 4) + samples;
}

tst_cliListen::Outcome tst_cliListen::listen(const QStringList &arguments, const QByteArray &input) const
{
    QProcess process;
    process.setWorkingDirectory(folder());
    process.start(program, QStringList{"listen"} + arguments + settings);
    process.write(input);
    process.closeWriteChannel();
    if (!process.waitForFinished(patience) || process.exitStatus() != QProcess::NormalExit)
        return {};
    return {process.exitCode(), process.readAllStandardOutput(), process.readAllStandardError()};
}

void tst_cliListen::initTestCase()
{
    QVERIFY2(QFile::exists(program), "faintline-cli is not built");
    writeBytes(pathOf("scene.json"), R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 120, "seed": 3,
        "lines": [{"snrDb": 9, "referenceSeconds": 0.25, "startSeconds": 8, "durationSeconds": 25, "frequencyHz": 210},
                  {"snrDb": 12, "referenceSeconds": 0.25, "startSeconds": 60, "frequencyHz": 333}]})");
    QCOMPARE(run({"simulate", "scene.json", "--out", "made.sigmf-meta", "--type", "int16"}).code, 0);
}

void tst_cliListen::pipeGivesWhatItsRecordingGives_data()
{
    QTest::addColumn<QString>("input");
    QTest::addColumn<QStringList>("options");
    QTest::newRow("wav of unknown length") << "wav" << QStringList();
    QTest::newRow("wav of length 0") << "wav0" << QStringList();
    QTest::newRow("wav of 24 bits") << "wav24" << QStringList();
    QTest::newRow("raw") << "raw" << QStringList{"--raw-type", "ri16_le", "--raw-rate", "1000"};
    QTest::newRow("raw, cut in a sample") << "cut" << QStringList{"--raw-type", "ri16_le", "--raw-rate", "1000"};
    QTest::newRow("two channels as one") << "wav2" << QStringList{"--iq"};
}

void tst_cliListen::pipeGivesWhatItsRecordingGives()
{
    QFETCH(QString, input);
    QFETCH(QStringList, options);
    const QByteArray samples = content("made.sigmf-data");
    QCOMPARE(samples.size(), qsizetype(240'000));
    QByteArray bytes = samples;
    if (input == "wav")
        bytes = wav(samples);
    else if (input == "wav0")
        bytes = wav(samples, 16, 0);
    else if (input == "wav2")
        bytes = wav(samples, 16, 0xffffffffu, 2);
    else if (input == "cut")
        bytes.chop(1);
    else if (input == "wav24") {
        bytes.clear();
        for (qsizetype i = 0; i < samples.size(); i += 2)
            bytes += QByteArray(1, '\x5a') + samples.mid(i, 2);
        bytes = wav(bytes, 24);
    }
    const QString record = input + ".sigmf-meta";
    const Outcome told = listen(QStringList{"-", "--record", record, "--events", input + ".csv"} + options, bytes);
    QCOMPARE(told.err, QByteArray());
    QCOMPARE(told.code, 0);
    const Outcome file = run(QStringList{"detect", record, "--events", "file.csv"} + settings + causal);
    QCOMPARE(file.code, 0);
    QVERIFY(numbersOf(content("file.csv")).size() >= 2);
    QCOMPARE(content(input + ".csv"), content("file.csv"));
    if (input == "raw" || input == "wav")
        QCOMPARE(content(input + ".sigmf-data"), samples);
    if (input == "wav") { // its own recording, made some other way, gives the same as well
        QCOMPARE(run(QStringList{"detect", "made.sigmf-meta", "--events", "made.csv"} + settings + causal).code, 0);
        QCOMPARE(content("made.csv"), content("wav.csv"));
    }
}

void tst_cliListen::linesAreJson()
{
    const Outcome told = listen({"-", "--update", "5"}, wav(content("made.sigmf-data")));
    QCOMPARE(told.code, 0);
    QStringList states;
    QStringList notices;
    for (const QByteArray &line : told.out.trimmed().split('\n')) {
        QJsonParseError error;
        const QJsonObject object = QJsonDocument::fromJson(line, &error).object();
        QCOMPARE(error.error, QJsonParseError::NoError);
        if (object.contains("notice")) {
            notices.append(object["notice"].toString());
            continue;
        }
        QVERIFY(object["event"].toInt() > 0);
        if (object["event"].toInt() == 1) {
            states.append(object["state"].toString());
            if (states.back() != "updated") // while it fades a track goes where it likes
                QVERIFY(std::abs(object["f"].toDouble() - 210.0) < 4.0);
            QVERIFY(object.contains("utc") && object.contains("t_onset") && object.contains("statistic"));
        }
    }
    QCOMPARE(notices, (QStringList{"started", "stopped"}));
    QCOMPARE(states.mid(0, 3), (QStringList{"provisional", "confirmed", "updated"}));
    QCOMPARE(states.back(), QString("final"));
    QCOMPARE(states.count("final"), 1);
    const Outcome appended = listen({"-", "--out", "lines.jsonl", "--update", "5"}, wav(content("made.sigmf-data")));
    QCOMPARE(appended.out, QByteArray());
    QCOMPARE(content("lines.jsonl").count('\n'), told.out.count('\n'));
}

void tst_cliListen::commandsGetTheLineAsItIs()
{
    writeBytes(pathOf("hook"), "#!/bin/sh\nprintf '%s|%s\\n' \"$1\" \"$2\" >> hooked\n");
    ::chmod(pathOf("hook").c_str(), 0700);
    const QString word = "; touch injected; $(touch injected) `touch injected`";
    const Outcome told = listen({"-", "--on-event", "./hook", word}, wav(content("made.sigmf-data")));
    QCOMPARE(told.code, 0);
    QTRY_VERIFY(content("hooked").contains("final"));
    QVERIFY(!QFile::exists(path("injected")));
    for (const QByteArray &line : content("hooked").trimmed().split('\n')) {
        QVERIFY(line.startsWith((word + '|').toUtf8()));
        QVERIFY(told.out.contains(line.mid(word.size() + 1) + '\n'));
    }
    const Outcome none = listen({"-", "--on-event", "./no-such-program"}, wav(content("made.sigmf-data")));
    QCOMPARE(none.code, 2);
    QVERIFY(none.err.contains("no-such-program"));
}

void tst_cliListen::fifo()
{
    QCOMPARE(::mkfifo(pathOf("pipe").c_str(), 0600), 0);
    QProcess process;
    process.setWorkingDirectory(folder());
    process.start(program, QStringList{"listen", "pipe", "--events", "fifo.csv"} + settings);
    QVERIFY(process.waitForStarted());
    QTest::qWait(300); // no writer yet: not the end
    QFile writer(path("pipe"));
    QVERIFY(writer.open(QIODevice::WriteOnly));
    writer.write(wav(content("made.sigmf-data")));
    writer.close();
    QVERIFY(process.waitForFinished(patience));
    QCOMPARE(process.exitCode(), 0);
    QCOMPARE(run(QStringList{"detect", "made.sigmf-meta", "--events", "made.csv"} + settings + causal).code, 0);
    QCOMPARE(content("fifo.csv"), content("made.csv"));
}

void tst_cliListen::stopsWithinASecond_data()
{
    QTest::addColumn<QByteArray>("input");
    QTest::addColumn<int>("signal");
    const QByteArray samples(100'000, '\x11');
    QTest::newRow("before anything came") << QByteArray() << SIGINT;
    QTest::newRow("in a header") << wav(samples).left(30) << SIGTERM;
    QTest::newRow("before a block is whole") << wav(samples.left(3000)) << SIGINT;
    QTest::newRow("in the stream") << wav(samples) << SIGTERM;
}

void tst_cliListen::stopsWithinASecond()
{
    QFETCH(QByteArray, input);
    QFETCH(int, signal);
    QFile::remove(path("stopped.sigmf-meta"));
    QFile::remove(path("stopped.sigmf-data"));
    QProcess process;
    process.setWorkingDirectory(folder());
    process.start(program, QStringList{"listen", "-", "--record", "stopped.sigmf-meta"} + settings);
    QVERIFY(process.waitForStarted());
    process.write(input);
    QVERIFY(process.waitForBytesWritten() || input.isEmpty());
    QTest::qWait(700);
    QElapsedTimer timer;
    timer.start();
    ::kill(static_cast<pid_t>(process.processId()), signal);
    QVERIFY(process.waitForFinished(10'000));
    QVERIFY2(timer.elapsed() < 1000 * slowdown, qPrintable(QString::number(timer.elapsed())));
    QCOMPARE(process.exitStatus(), QProcess::NormalExit);
    QCOMPARE(process.readAllStandardError(), QByteArray());
    QCOMPARE(process.exitCode(), 0);
    if (input.size() > 1000)
        QCOMPARE(content("stopped.sigmf-data").size(), input.size() - wav({}).size());
}

// In real time, killed at random moments: what was written a second ago is in the recording, and it can be read.
void tst_cliListen::aKillLosesNoMoreThanASecond()
{
    const QByteArray samples = content("made.sigmf-data");
    Random random(4, 4);
    for (int kill = 0; kill < 5; ++kill) {
        const QString record = QString("killed%1.sigmf-meta").arg(kill);
        QProcess process;
        process.setWorkingDirectory(folder());
        process.start(program, QStringList{"listen", "-", "--record", record} + settings);
        QVERIFY(process.waitForStarted());
        process.write(wav({}));
        const qint64 end = 400 + qint64(random.uniform() * 2000.0);
        QElapsedTimer timer;
        timer.start();
        qsizetype written = 0;
        qsizetype secondAgo = 0;
        while (timer.elapsed() < end) {
            const qsizetype due = 20 * timer.elapsed(); // ten times as fast as it was
            process.write(samples.mid(written, due / 2 * 2 - written));
            process.waitForBytesWritten();
            written = due / 2 * 2;
            if (timer.elapsed() < end - 1000 * slowdown / 2)
                secondAgo = written;
            QTest::qWait(5);
        }
        process.kill();
        QVERIFY(process.waitForFinished(10'000));
        if (secondAgo == 0)
            continue;
        QVERIFY2(content(record.chopped(4) + "data").size() >= secondAgo, qPrintable(QString::number(secondAgo)));
        QCOMPARE(run({"info", record}).code, 0);
    }
}

void tst_cliListen::mistakes_data()
{
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QByteArray>("input");
    QTest::addColumn<QByteArray>("words");
    QTest::newRow("no WAV") << QStringList{"-"} << QByteArray("something else altogether") << QByteArray("WAV");
    QTest::newRow("nothing") << QStringList{"-"} << QByteArray() << QByteArray("header");
    QTest::newRow("a format that is none") << QStringList{"-"} << wav("", 12) << QByteArray("12 bits");
    QTest::newRow("no channel") << QStringList{"-"} << wav("", 16, 0, 0) << QByteArray("0 channels");
    QTest::newRow("raw without rate") << QStringList{"-", "--raw-type", "ri16"} << QByteArray("xx")
                                      << QByteArray("rate");
    QTest::newRow("unknown type") << QStringList{"-", "--raw-type", "x", "--raw-rate", "1"} << QByteArray()
                                  << QByteArray("--raw-type");
    QTest::newRow("one channel as a pair") << QStringList{"-", "--iq"} << wav("") << QByteArray("I/Q");
    QTest::newRow("no such FIFO") << QStringList{"nothing-here"} << QByteArray() << QByteArray("nothing-here");
    QTest::newRow("not SigMF") << QStringList{"-", "--record", "r.wav"} << wav(QByteArray(9000, 1))
                               << QByteArray("r.wav");
    QTest::newRow("table of another kind") << QStringList{"-", "--events", "e.txt"} << wav("") << QByteArray("e.txt");
}

void tst_cliListen::mistakes()
{
    QFETCH(QStringList, arguments);
    QFETCH(QByteArray, input);
    QFETCH(QByteArray, words);
    const Outcome told = listen(arguments, input);
    QCOMPARE(told.code, 2);
    QVERIFY(told.err.startsWith("error: ") && told.err.count('\n') == 1);
    QVERIFY2(told.err.contains(words), told.err.constData());
}

// A stream that is over before there is a frame is no mistake, whenever it ends.
void tst_cliListen::overBeforeAWindow()
{
    for (const int samples : {0, 1, 200}) {
        const Outcome told = listen({"-", "--raw-type", "ri16_le", "--raw-rate", "1000"}, QByteArray(2 * samples, 1));
        QCOMPARE(told.code, 0);
        QVERIFY2(told.out.contains("ended before one window was complete"), told.out.constData());
    }
}

// In the words of `detect`, when the stream ends.
void tst_cliListen::silenceIsTold()
{
    for (const bool isSilent : {true, false}) {
        QByteArray samples(20'100, '\0');
        if (!isSilent)
            samples[15'000] = '\1';
        const Outcome heard = listen({"-"}, wav(samples));
        QCOMPARE(heard.code, 0);
        writeBytes(pathOf("heard.wav"), wav(samples));
        const Outcome found = run(QStringList{"detect", "heard.wav", "--summary"} + settings + causal);
        const qsizetype at = found.out.indexOf("the recording is silent: all of the 10000 samples");
        QCOMPARE(at >= 0, isSilent);
        QCOMPARE(heard.out.contains("0 event(s); " + found.out.mid(at).split('\n').first()), isSilent);
    }
}

// Two hours of noise at 8 kHz as fast as it goes: the most that the process took in the first fifth is the most that it
// takes at all, but for the events.
void tst_cliListen::memoryStaysFlat()
{
    QProcess process;
    process.setWorkingDirectory(folder());
    process.start(program, QStringList{"listen", "-", "--raw-type", "ri16_le", "--raw-rate", "8000"} + settings);
    QVERIFY(process.waitForStarted());
    Random random(6, 6);
    std::vector<float> noise(1 << 20);
    random.normals(noise, 3000.0f);
    QByteArray block;
    for (const float value : noise)
        block += littleEndian(quint32(static_cast<qint32>(value)), 2);
    const auto most = [&] {
        QFile status(QString("/proc/%1/status").arg(process.processId()));
        (void)status.open(QIODevice::ReadOnly);
        for (const QByteArray &line : status.readAll().split('\n'))
            if (line.startsWith("VmHWM:"))
                return line.mid(6).trimmed().split(' ').front().toDouble();
        return 0.0;
    };
    constexpr int blocks = 55; // of 131 s
    double early = 0.0;
    for (int i = 0; i < blocks; ++i) {
        process.write(block.mid(2 * i) + block.left(2 * i)); // never twice the same windows
        while (process.bytesToWrite() > 0)
            QVERIFY(process.waitForBytesWritten(patience));
        if (i == blocks / 5)
            early = most();
    }
    const double late = most();
    process.closeWriteChannel();
    QVERIFY(process.waitForFinished(patience));
    QCOMPARE(process.exitCode(), 0);
    QVERIFY2(early > 0.0 && late < 1.03 * early, qPrintable(QString("%1 kB, then %2 kB").arg(early).arg(late)));
}

FAINTLINE_TEST(tst_cliListen)
#include "tst_cliListen.moc"
