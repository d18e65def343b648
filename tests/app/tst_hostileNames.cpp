// Names, notes and units from files, as they come onto the screen.

#include "app/base/MessageBar.h"
#include "app/base/filePath.h"
#include "app/features/evaluate/ExperimentsPanel.h"
#include "app/features/events/EventFiles.h"
#include "app/features/events/EventReviews.h"
#include "app/features/pictures/Workbench.h"
#include "app/lessons/LessonGuide.h"
#include "app/openWindow.h"
#include "base/files/AtomicFile.h"
#include "base/files/fileName.h"
#include "base/oneLine.h"
#include "evaluate/experiments/campaignCurve.h"
#include "exchange/Session.h"
#include "noise/openFrames.h"
#include "scene/SimulatedRecording.h"
#include "signal/formats/writeRecording.h"
#include "support/test.h"
#include "widgets/events/EventTable.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAction>
#include <QComboBox>
#include <QDir>
#include <QGroupBox>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>

#include <filesystem>
#include <fstream>
#include <random>

using namespace faintline;
using namespace faintline::test;

namespace {

/// Escape sequences, C1, marks of direction, tags, and a line's end.
const QString hostile = QStringLiteral("a\u001B[31m\u009B\u202Egnp\u2066\u200F<b>bold&Q");

/// Two seconds with a line.
std::string writeLine(const std::string &path)
{
    LineScene scene;
    scene.sampleRateHz = 1000.0;
    scene.durationSeconds = 4.0;
    scene.lines.push_back({});
    scene.lines.back().frequencyHz = 200.0;
    scene.lines.back().snrDb = 20.0;
    const SimulatedRecording made(scene);
    writeRecording(made, path);
    return path;
}

bool isHarmless(const QString &text)
{
    for (const QString &line : QString(text)
                                   .replace(QLatin1Char('\t'), QLatin1Char(' '))
                                   .split(QLatin1Char('\n'))) // which we set ourselves, before keys
        if (const QString kept = QString::fromStdString(oneLine(line.toStdString())); kept != line.trimmed())
            return false;
    return true;
}

/// Every text that the window's widgets show.
QStringList textsOf(const QWidget &window)
{
    QStringList texts{window.windowTitle()};
    const auto addOf = [&](const QWidget &widget) {
        texts << widget.windowTitle() << widget.toolTip() << widget.accessibleName() << widget.statusTip();
        if (const auto *label = qobject_cast<const QLabel *>(&widget))
            texts << label->text();
        if (const auto *button = qobject_cast<const QAbstractButton *>(&widget))
            texts << button->text();
        if (const auto *edit = qobject_cast<const QLineEdit *>(&widget))
            texts << edit->text();
        if (const auto *box = qobject_cast<const QGroupBox *>(&widget))
            texts << box->title();
        if (const auto *box = qobject_cast<const QComboBox *>(&widget))
            for (int i = 0; i < box->count(); ++i)
                texts << box->itemText(i);
        if (const auto *view = qobject_cast<const QAbstractItemView *>(&widget); view && view->model()) {
            const QAbstractItemModel &model = *view->model();
            for (int column = 0; column < model.columnCount(); ++column) {
                texts << model.headerData(column, Qt::Horizontal).toString();
                for (int row = 0; row < model.rowCount(); ++row)
                    for (const int role : {int(Qt::DisplayRole), int(Qt::ToolTipRole), int(Qt::AccessibleTextRole)})
                        texts << model.index(row, column).data(role).toString();
            }
        }
    };
    addOf(window);
    for (const QWidget *widget : window.findChildren<QWidget *>())
        addOf(*widget);
    for (const QAction *action : window.findChildren<QAction *>())
        texts << action->text() << action->toolTip();
    texts.removeAll(QString());
    return texts;
}

QString firstHarmful(const QWidget &window)
{
    for (const QString &text : textsOf(window))
        if (!isHarmless(text))
            return text;
    return {};
}

/// A tag in a label that takes HTML.
QString firstTagged(const QWidget &window)
{
    for (const QLabel *label : window.findChildren<QLabel *>())
        if (label->textFormat() != Qt::PlainText && label->text().contains(QLatin1String("<b>bold")))
            return label->text();
    for (const QWidget *widget : window.findChildren<QWidget *>())
        if (widget->toolTip().contains(QLatin1String("<b>bold")))
            return widget->toolTip();
    return {};
}

} // namespace

class tst_hostileNames : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        QVERIFY(!isHarmless(hostile)); // otherwise nothing here can fail
        QVERIFY(isHarmless(QStringLiteral("½ plain\n[*] ·")));
    }

    void cleanupTestCase()
    {
        std::filesystem::remove_all(m_folder.path().toStdString());
    } // QDir does not see all of it

    void namesComeOntoLabelsHarmless()
    {
        const std::string path = writeLine(pathOfName(hostile.toStdString() + ".wav"));
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, pathText(path)));
        QVERIFY(window->document().analysis());
        QCOMPARE(firstHarmful(*window), QString());
        QCOMPARE(firstTagged(*window), QString());
        QVERIFY2(window->windowTitle().contains(QLatin1String("gnp")), qPrintable(window->windowTitle()));
    }

    void recentNamesAreHarmless()
    {
        const std::string path = writeLine(pathOfName(hostile.toStdString() + "-recent.wav"));
        const QString memory = m_folder.filePath(QStringLiteral("memory.ini"));
        {
            const auto window = newWindow({1400, 900}, std::make_unique<QSettings>(memory, QSettings::IniFormat));
            QVERIFY(openAndSettle(*window, pathText(path)));
        }
        const auto window = newWindow({1400, 900}, std::make_unique<QSettings>(memory, QSettings::IniFormat));
        for (QMenu *menu : window->findChildren<QMenu *>())
            emit menu->aboutToShow();
        QCOMPARE(textsOf(*window).filter(QStringLiteral("gnp")).isEmpty(), false);
        QCOMPARE(firstHarmful(*window), QString());
        QCOMPARE(firstTagged(*window), QString());
    }

    void errorsAreHarmless()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, m_folder.filePath(hostile + QStringLiteral("-missing.wav"))));
        QVERIFY(window->messages().text().contains(QLatin1String("gnp")));
        QCOMPARE(firstHarmful(*window), QString());
        QCOMPARE(firstTagged(*window), QString());
    }

    void notesOfARecordingAreHarmless()
    {
        Json meta = {{"global",
                      {{"core:datatype", "rf32_le"},
                       {"core:sample_rate", 1000},
                       {"core:version", hostile.toStdString()},
                       {"core:description", hostile.toStdString() + std::string(300, 'x')},
                       {"core:author", hostile.toStdString()}}},
                     {"captures", {{{"core:sample_start", 0}, {"core:datetime", hostile.toStdString()}}}},
                     {"annotations", Json::array()}};
        const std::string path = pathOfName("noted.sigmf-meta");
        writeTextFile(path, meta.dump());
        std::ofstream(pathOfName("noted.sigmf-data"), std::ios::binary) << std::string(4 * 4000, '\0');
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, pathText(path)));
        QCOMPARE(firstHarmful(*window), QString());
        QCOMPARE(firstTagged(*window), QString());
    }

    void reviewsOfASessionAreHarmless()
    {
        const std::string recording = writeLine(pathOfName("reviewed.wav"));
        Session session;
        session.source = sourceAt(pathText(recording));
        Json json = parseJson(sessionText(session, pathBytes(m_folder.path())), "session");
        json["recording"].erase("sha256");
        json["annotations"] = {{"boxes",
                                {{{"seconds", {0.5, 1.5}},
                                  {"hz", {100, 300}},
                                  {"label", hostile.toStdString()},
                                  {"note", hostile.toStdString()}}}},
                               {"reviews", Json::array()}};
        const std::string path = pathOfName("reviewed.faintline");
        writeTextFile(path, json.dump());
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, pathText(path)));
        QCOMPARE(window->document().annotations().boxes.size(), std::size_t(1));
        QMenu menu;
        emit window->workbench().input()->contextMenuRequested(&menu, 1.0, 200.0);
        QVERIFY(!menu.actions().isEmpty());
        for (const QAction *action : menu.actions())
            QVERIFY2(isHarmless(action->text()), qPrintable(action->text()));
        QCOMPARE(firstHarmful(*window), QString());
    }

    void gridsAreHarmless()
    {
        writeTextFile(pathOfName("pings.json"),
                      R"({"kind": "pings", "pings": 3, "rangeCells": 12, "beams": 4, "targets": [{"rangeMetres": 3030,
           "legs": [{"pings": 1}, {}]}]})");
        const auto window = newWindow();
        const QString unit = hostile + QStringLiteral("xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx");
        // Frames with axes of hostile names and units beside them.
        QByteArray npy("\x93NUMPY\x01\x00", 8);
        QByteArray header("{'descr': '<f4', 'fortran_order': False, 'shape': (6, 12, 4), }");
        header += QByteArray(int(64 - (10 + header.size() + 1) % 64), ' ') + '\n';
        npy += char(header.size()) + QByteArray(1, '\0') + header;
        std::mt19937 random(1);
        std::exponential_distribution<float> power(1.0f);
        for (int i = 0; i < 6 * 12 * 4; ++i) {
            const float value = power(random);
            npy.append(reinterpret_cast<const char *>(&value), 4);
        }
        const QString stack = writeFile(m_folder, QStringLiteral("stack.npy"), npy);
        const Json grid = {
            {"time", {{"first", 0}, {"step", 40}}},
            {"axes",
             {{{"name", unit.toStdString()}, {"unit", unit.toStdString()}, {"first", 1000}, {"step", 10}},
              {{"name", unit.toStdString()}, {"unit", unit.toStdString()}, {"first", 0}, {"step", 10}}}}};
        writeTextFile(gridPathOf(pathBytes(stack)), grid.dump());
        const int before = window->minimumSizeHint().width();
        QVERIFY(openAndSettle(*window, stack));
        QVERIFY2(window->document().frames(), qPrintable(window->messages().text()));
        QCOMPARE(firstHarmful(*window), QString());
        QCOMPARE(firstTagged(*window), QString());
        const auto plain = newWindow();
        QVERIFY(QFile::remove(pathText(gridPathOf(pathBytes(stack)))));
        QVERIFY(openAndSettle(*plain, stack));
        QVERIFY(before > 0);
        QVERIFY2(window->minimumSizeHint().width() <= plain->minimumSizeHint().width() + 100,
                 qPrintable(QStringLiteral("%1 > %2")
                                .arg(window->minimumSizeHint().width())
                                .arg(plain->minimumSizeHint().width())));
    }

    void curvesAreHarmless()
    {
        const QString name = hostile + QString(250, QLatin1Char('x'));
        const QString path = writeFile(m_folder, hostile + QStringLiteral(".csv"),
                                       "detector,snr_db,pd,pd_low,pd_high,trials,threshold\n\"" + name.toUtf8()
                                           + "\",1,0.5,0.4,0.6,10,\n\"" + name.toUtf8() + "\",2,0.7,0.6,0.8,10,\n");
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, pathText(writeLine(pathOfName("plain.wav")))));
        const int before = window->minimumSizeHint().width();
        emit window->panel<ExperimentsPanel>().showRequested(window->panel<ExperimentsPanel>().importFile(path));
        QCoreApplication::processEvents();
        QCOMPARE(firstHarmful(*window), QString());
        QCOMPARE(firstTagged(*window), QString());
        QVERIFY2(window->minimumSizeHint().width() <= before + 100,
                 qPrintable(QStringLiteral("%1 > %2").arg(window->minimumSizeHint().width()).arg(before)));
    }

    void lessonsAreHarmless()
    {
        const std::string text = hostile.toStdString();
        writeLine(pathOfName("lesson.wav"));
        const Json lesson = {
            {"title", text},
            {"sentence", text},
            {"steps",
             {{{"title", text},
               {"text", text + "\n\n" + text + std::string(250, 'x')},
               {"open", "lesson.wav"},
               {"ask", {{"question", text}, {"choices", {text, text}}, {"answer", 0}, {"why", text}}}}}}};
        const std::string path = pathOfName("lesson.json");
        writeTextFile(path, lesson.dump());
        const auto window = newWindow();
        QSignalSpy ready(&window->lessonGuide(), &LessonGuide::ready);
        window->open(pathText(path));
        QVERIFY2(ready.count() > 0 || ready.wait(patience), qPrintable(window->messages().text()));
        QCOMPARE(firstHarmful(*window), QString());
        QCOMPARE(firstTagged(*window), QString());
    }

    void longNamesDoNotWidenTheWindow_data()
    {
        QTest::addColumn<bool>("isThere");
        QTest::addRow("opened") << true;
        QTest::addRow("missing") << false;
    }

    void longNamesDoNotWidenTheWindow()
    {
        QFETCH(bool, isThere);
        const std::string name = std::string(246, 'x') + ".wav"; // 250 letters
        const std::string folder = pathOfName(isThere ? "there" : "missing");
        std::filesystem::create_directory(folder);
        const std::string plainPath = folder + "/x.wav";
        if (isThere) {
            writeLine(plainPath);
            writeLine(folder + "/" + name);
        }
        const auto widthWith = [&](const std::string &path) {
            const QString memory = m_folder.filePath(QStringLiteral("long.ini"));
            QFile::remove(memory);
            int width = 0;
            {
                const auto window = newWindow({1000, 700}, std::make_unique<QSettings>(memory, QSettings::IniFormat));
                if (!openAndSettle(*window, pathText(path)))
                    return -1;
                if (isThere && !window->document().analysis())
                    return -2;
                width = window->minimumSizeHint().width();
            }
            const auto next = newWindow(
                {1000, 700}, std::make_unique<QSettings>(memory, QSettings::IniFormat)); // with its recent names
            return std::max(width, next->minimumSizeHint().width());
        };
        const int plain = widthWith(plainPath);
        QVERIFY(plain > 0);
        QCOMPARE(widthWith(folder + "/" + name), plain);
    }

    void bytesThatAreNoTextAreOpened_data()
    {
        QTest::addColumn<QByteArray>("name");
        QTest::addColumn<QByteArray>("folder");
        QTest::addRow("Latin-1") << QByteArray("Gr\xf6\xdf"
                                               "e.wav")
                                 << QByteArray("plain");
        QTest::addRow("any bytes") << QByteArray("\xff\xfe\x80.wav") << QByteArray("plain");
        QTest::addRow("a folder") << QByteArray("x.wav") << QByteArray("\xe4ltere");
    }

    /// From the command line's bytes into the window, a session, a picture, and back.
    void bytesThatAreNoTextAreOpened()
    {
        QFETCH(QByteArray, name);
        QFETCH(QByteArray, folder);
        const std::string place = pathOfName(folder.toStdString());
        std::filesystem::create_directory(place);
        const std::string path = writeLine(place + "/" + name.toStdString());
        QVERIFY(std::filesystem::exists(path));
        const std::string session = place + "/s" + name.chopped(4).toStdString() + ".faintline";
        const QString memory = m_folder.filePath(QStringLiteral("bytes.ini"));
        QFile::remove(memory);
        {
            const auto window = newWindow({1400, 900}, std::make_unique<QSettings>(memory, QSettings::IniFormat));
            QVERIFY(openAndSettle(*window, pathText(path)));
            QVERIFY2(window->document().analysis(), qPrintable(window->messages().text()));
            QVERIFY(isHarmless(window->windowTitle()));
            QVERIFY(!window->windowTitle().contains(QChar(QChar::highSurrogate(0x10fe80))));
            writeSession(session, {window->document().source(), {}, window->document().settings()});
            QVERIFY(std::filesystem::exists(session));
        }
        const QStringList recent = WindowMemory(std::make_unique<QSettings>(memory, QSettings::IniFormat)).recent();
        QCOMPARE(recent.size(), 1);
        QVERIFY(pathBytes(recent.first()) == path);
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, pathText(session)));
        QVERIFY2(window->document().analysis(), qPrintable(window->messages().text()));
        QCOMPARE(window->messages().text(), QString()); // the recording's hash is the session's
        window->reviews().files().exportTo(pathText(place + "/" + name.toStdString() + ".csv"));
        QVERIFY(std::filesystem::exists(place + "/" + name.toStdString() + ".csv"));
        QTRY_VERIFY(std::filesystem::exists(place + "/" + name.toStdString() + ".csv.provenance.json"));
    }

    void droppedNamesKeepTheirBytes()
    {
        for (const std::string name : {"/tmp/plain.wav", "/tmp/½ ünicode %41?#.wav", "/tmp/\xff\xfe.wav"}) {
            const QUrl url(QStringLiteral("file://")
                           + QString::fromLatin1(QByteArray::fromStdString(name).toPercentEncoding("/")));
            QVERIFY(pathBytes(pathOf(url)) == name);
            QVERIFY(pathBytes(pathText(name)) == name);
        }
        QCOMPARE(pathOf(QUrl(QStringLiteral("https://example.org/a.wav"))), QString());
        QCOMPARE(pathOf(QUrl::fromLocalFile(QStringLiteral("/tmp/a b.wav"))), QStringLiteral("/tmp/a b.wav"));
    }

    void dialogsSuggestNamesOneCanType()
    {
        QCOMPARE(nameBeside(QStringLiteral("/tmp/a.b.wav"), QStringLiteral("-events.csv")),
                 QStringLiteral("/tmp/a.b-events.csv"));
        QCOMPARE(nameBeside(pathText("/tmp/a\xff.wav"), QStringLiteral(".html")), QStringLiteral("/tmp/a_.html"));
        QCOMPARE(nameBeside(QStringLiteral(":/scenarios/a.json"), QStringLiteral(".faintline")),
                 QDir::homePath() + QStringLiteral("/a.faintline")); // nothing can be written beside a resource
        QVERIFY(nameBeside(QStringLiteral("/tmp/") + QString(250, QLatin1Char('x')), QStringLiteral(".html")).size()
                < 255);
        // Characters of three and four bytes, whose limit lies within one.
        for (const QString &character : {QString(QChar(0x6f22)), QStringLiteral("\U0001F3B5")}) {
            const QString name = nameBeside(QLatin1Char('x') + character.repeated(60), QStringLiteral("-events.csv"));
            QVERIFY2(name.isValidUtf16(), qPrintable(name));
            QVERIFY(name.section(QLatin1Char('/'), -1).toUtf8().size() < 255);
        }
    }

private:
    std::string pathOfName(const std::string &name) const { return m_folder.path().toStdString() + "/" + name; }
    QTemporaryDir m_folder;
};

FAINTLINE_WINDOW_TEST(tst_hostileNames)
#include "tst_hostileNames.moc"
