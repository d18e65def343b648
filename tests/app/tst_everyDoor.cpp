#include "app/cli/CommandLineTest.h"
#include "app/openWindow.h"
#include "support/test.h"

#include "analyse/events.h"
#include "exchange/writeEvents.h"

using namespace faintline;
using namespace faintline::test;

/// One recording through every door: command line, window, survey, Python and a Vamp host give the same events, byte
/// for byte, formats apart.
class tst_everyDoor : public CommandLineTest
{
    Q_OBJECT

private slots:
    void initTestCase();
    void window();
    void survey();
    void python();
    void vamp();

private:
    /// What another program prints.
    QByteArray said(const QString &name, const QStringList &arguments, const QStringList &variables = {}) const
    {
        QProcess process;
        process.setWorkingDirectory(folder());
        process.setEnvironment(QProcess::systemEnvironment() + variables);
        process.start(name, arguments);
        process.waitForFinished(patience);
        return process.readAllStandardOutput();
    }

    QByteArray m_events; ///< the table of the command line
    QByteArrayList m_rows;
};

namespace {

/// Without a table's head.
QByteArrayList rowsOf(const QByteArray &table)
{
    return table.trimmed().split('\n').mid(1);
}

} // namespace

void tst_everyDoor::initTestCase()
{
    writeBytes(pathOf("scene.json"), R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 60.7, "seed": 5,
        "noise": {"deviation": 0.1}, "lines": [
        {"snrDb": 4, "referenceSeconds": 0.5, "startSeconds": 5, "durationSeconds": 40, "frequencyHz": 210,
         "driftHzPerSecond": 0.2},
        {"snrDb": 5, "referenceSeconds": 0.5, "startSeconds": 20, "durationSeconds": 30, "frequencyHz": 330}]})");
    QDir(folder()).mkdir("night");
    QCOMPARE(run({"simulate", "scene.json", "--type", "int16", "--out", "night/line.wav"}).code, 0);
    QCOMPARE(run({"detect", "night/line.wav", "--events", "events.csv"}).code, 0);
    m_events = content("events.csv");
    m_rows = rowsOf(m_events);
    QVERIFY(m_rows.size() >= 2);
}

void tst_everyDoor::window()
{
    const auto window = newWindow();
    window->controller().setShowsFirstEstimates(false);
    QVERIFY(openAndSettle(*window, path("night/line.wav")));
    const Analysis &analysis = *window->document().analysis();
    QCOMPARE(QByteArray::fromStdString(eventsCsv(analysis, events(analysis))), m_events);
}

void tst_everyDoor::survey()
{
    QCOMPARE(run({"survey", "night", "--out", "s.sqlite"}).code, 0);
    QCOMPARE(run({"survey", "export", "s.sqlite", "--events", "s.csv"}).code, 0);
    constexpr int kinds = 3; // keyed, spread and call, behind the columns that a survey has
    const auto columns = m_rows[0].count(',') + 1 - kinds;
    QByteArrayList found;
    QByteArrayList expected;
    for (const QByteArray &row : rowsOf(content("s.csv"))) // recording and time before, box and review behind
        found << row.split(',').mid(2, columns).join(',');
    for (const QByteArray &row : m_rows)
        expected << row.split(',').mid(0, columns).join(',');
    QCOMPARE(found, expected);
}

void tst_everyDoor::python()
{
    const QString module = QStringLiteral(FAINTLINE_BINARY_DIR "/python");
    if (QDir(module + "/faintline").entryList({"_faintline*.so"}).isEmpty())
        QSKIP("the Python module is not built");
    said("/usr/bin/python3", {"-c", "import faintline; faintline.detect('night/line.wav').save(events='p.csv')"},
         {"PYTHONPATH=" + module});
    QCOMPARE(content("p.csv"), m_events);
}

void tst_everyDoor::vamp()
{
    const QString plugin = QStringLiteral(FAINTLINE_BINARY_DIR "/vamp");
    const QString host = QStandardPaths::findExecutable("vamp-simple-host");
    if (host.isEmpty() || !QFile::exists(plugin + "/faintline.so"))
        QSKIP("no Vamp plug-in, or no host of Debian's vamp-examples");
    const QByteArray told = said(host, {"faintline:detector:events", "night/line.wav"}, {"VAMP_PATH=" + plugin});
    QByteArrayList found; // TIME, DURATION: HZ ROW
    for (const QByteArray &line : told.trimmed().split('\n'))
        found << line.mid(line.lastIndexOf(' ') + 1);
    QCOMPARE(found, m_rows);
}

FAINTLINE_WINDOW_TEST(tst_everyDoor)
#include "tst_everyDoor.moc"
