#include "support/test.h"

namespace {

const QStringList order{"base", "signal", "frames",    "noise",   "scene",   "model",    "recursion", "detect", "track",
                        "plan", "refine", "calibrate", "analyse", "inspect", "evaluate", "exchange",  "live"};
constexpr int mostArrows = 77;
const QStringList widgetOrder{"base", "table", "plot", "waterfall", "pings", "events", "forms"};
const QStringList appOrder{"cli", "base", "commands", "document", "features", "views", "lessons", "window", "headless"};

QString root()
{
    return QStringLiteral(FAINTLINE_SOURCE_DIR "/");
}

QString contentOf(const QString &path)
{
    QFile file(root() + path);
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

struct Include {
    QString name;
    bool isQuoted = false;
};

QList<Include> includesOf(const QString &text)
{
    static const QRegularExpression pattern(R"(^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"])",
                                            QRegularExpression::MultilineOption);
    QList<Include> found;
    for (auto i = pattern.globalMatch(text); i.hasNext();) {
        const auto match = i.next();
        found.append({match.captured(2), match.captured(1) == "\""});
    }
    return found;
}

bool isQt(const QString &name)
{
    static const QRegularExpression pattern("^(Qt|Qwt|Q[A-Z]|qwt_|q[a-z]+\\.h$)");
    return pattern.match(name).hasMatch();
}

/// What a file of the core, "folder/Name.h", includes that it must not; empty if nothing.
QString wrongInCore(const QString &path, const QString &text)
{
    const auto rank = path.contains('/') ? order.indexOf(path.section('/', 0, 0)) : order.size(); // or faintline.h
    for (const Include &include : includesOf(text)) {
        if (isQt(include.name))
            return include.name + " is Qt";
        if (include.name == "fftw3.h" && path != "signal/Fft.cpp")
            return "fftw3.h belongs to signal/Fft.cpp alone";
        if (include.name == "hdf5.h" && path != "signal/formats/Hdf5File.cpp"
            && path != "signal/formats/Hdf5Driver.cpp")
            return "hdf5.h belongs to signal/formats/Hdf5File.cpp and Hdf5Driver.cpp alone";
        if (!include.isQuoted)
            continue;
        const auto other = order.indexOf(include.name.section('/', 0, 0));
        if (!include.name.contains('/') || other < 0)
            return include.name + " is not of the core";
        if (other > rank)
            return include.name + " lies to the right";
        if (!QFile::exists(root() + "core/" + include.name))
            return include.name + " does not exist";
    }
    return {};
}

/// What "widgets/folder/Name.h" or "app/folder/Name.h" includes that it must not; empty if nothing.
QString wrongAbove(const QString &path, const QString &text)
{
    const QString part = path.section('/', 0, 0), folder = path.section('/', 1, 1);
    const QStringList &folders = part == "app" ? appOrder : widgetOrder;
    const auto rank = folder.contains('.') ? folders.size() : folders.indexOf(folder); // app/main.cpp puts all together
    for (const Include &include : includesOf(text)) {
        const QString otherPart = include.name.section('/', 0, 0);
        if (!include.isQuoted || include.name.startsWith("tst_"))
            continue;
        if (!QFile::exists(root() + include.name) && !QFile::exists(root() + "core/" + include.name))
            return include.name + " does not exist";
        if (part == "widgets" && otherPart == "app")
            return include.name + " is of the app";
        const QString other = include.name.section('/', 1, 1);
        if (otherPart == part && folders.indexOf(other) > rank)
            return include.name + " lies to the right";
        if (folder == "features" && other == folder && include.name.section('/', 2, 2) != path.section('/', 2, 2))
            return include.name + " is of another feature";
    }
    return {};
}

/// Which units each unit includes; "core/base/Axis" is Axis.h and Axis.cpp.
using Units = QMap<QString, QSet<QString>>;

QString unitOf(const QString &file)
{
    return file.left(file.lastIndexOf('.'));
}

/// The units on the way from one back to itself; empty if no such way exists.
QStringList circleFrom(const Units &units, const QString &unit, QStringList &way, QSet<QString> &done)
{
    if (way.contains(unit))
        return way.mid(way.indexOf(unit)) << unit;
    if (done.contains(unit))
        return {};
    way.append(unit);
    for (const QString &next : units.value(unit))
        if (const QStringList circle = circleFrom(units, next, way, done); !circle.isEmpty())
            return circle;
    way.removeLast();
    done.insert(unit);
    return {};
}

QStringList circleIn(const Units &units)
{
    QSet<QString> done;
    for (auto unit = units.keyBegin(); unit != units.keyEnd(); ++unit) {
        QStringList way;
        if (const QStringList circle = circleFrom(units, *unit, way, done); !circle.isEmpty())
            return circle;
    }
    return {};
}

/// Which rooms each room includes, from the texts of their files by path.
Units arrowsOf(const QMap<QString, QString> &texts)
{
    Units arrows;
    for (auto text = texts.begin(); text != texts.end(); ++text)
        for (const Include &include : includesOf(*text)) {
            const QString from = text.key().section('/', 0, 0), to = include.name.section('/', 0, 0);
            if (include.isQuoted && from != to)
                arrows[from].insert(to);
        }
    return arrows;
}

} // namespace

/// Who may include whom: a folder includes itself and the folders to its left, a feature of the app no other feature.
/// The core includes nothing else of the project, the widgets the core as well, the app both. No two units (a header with its source) include each other, at
/// no distance. The core has few arrows, that is pairs of rooms of which one includes the other.
class tst_layers : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        QVERIFY2(QFile::exists(root() + "core/base/Axis.h"), "the source tree is not where it was built");
    }

    void foldersAreKnown()
    {
        for (const auto &[part, folders] : {std::pair("widgets", widgetOrder), std::pair("app", appOrder)})
            for (const QString &folder : QDir(root() + part).entryList(QDir::Dirs | QDir::NoDotAndDotDot))
                QVERIFY2(folders.contains(folder), qPrintable(folder));
        for (const QString &folder : QDir(root() + "core").entryList(QDir::Dirs | QDir::NoDotAndDotDot))
            QVERIFY2(order.contains(folder), qPrintable(folder));
        QVERIFY(filesIn("core").size() > 40);
    }

    void core_data()
    {
        QTest::addColumn<QString>("path");
        for (const QString &path : filesIn("core"))
            QTest::newRow(qPrintable(path)) << path;
    }

    void core()
    {
        QFETCH(QString, path);
        const QString wrong = wrongInCore(path, contentOf("core/" + path));
        QVERIFY2(wrong.isEmpty(), qPrintable(wrong));
    }

    void widgetsAndApp_data()
    {
        QTest::addColumn<QString>("path");
        for (const QString part : {"widgets", "app"})
            for (const QString &path : filesIn(part))
                QTest::newRow(qPrintable(part + "/" + path)) << part + "/" + path;
    }

    void widgetsAndApp()
    {
        QFETCH(QString, path);
        const QString wrong = wrongAbove(path, contentOf(path));
        QVERIFY2(wrong.isEmpty(), qPrintable(wrong));
    }

    void featuresIncludeNoOtherFeature()
    {
        const QString wrong = "#include \"app/features/survey/SurveyPanel.h\"";
        QVERIFY(!wrongAbove("app/features/live/LiveBar.cpp", wrong).isEmpty());
        QVERIFY(wrongAbove("app/features/survey/SurveyModel.cpp", wrong).isEmpty());
        QVERIFY(wrongAbove("app/views/panelList.cpp", wrong).isEmpty());
    }

    void commandLineIncludesTheCoreOnly()
    {
        int seen = 0;
        for (const QString &path : filesIn("app")) {
            if (!path.startsWith("cli/"))
                continue;
            ++seen;
            for (const Include &include : includesOf(contentOf("app/" + path))) {
                const bool isKnown = !include.isQuoted || include.name.startsWith("app/cli/")
                                     || include.name.startsWith("reproduce/")
                                     || order.contains(include.name.section('/', 0, 0));
                QVERIFY2(isKnown && !isQt(include.name), qPrintable(path + " includes " + include.name));
            }
        }
        QVERIFY(seen > 1);
    }

    void noUnitsInACircle()
    {
        Units units;
        for (const QString part : {"core", "reproduce", "widgets", "app"})
            for (const QString &path : filesIn(part)) {
                const QString unit = unitOf(part + "/" + path);
                for (const Include &include : includesOf(contentOf(part + "/" + path))) {
                    const QString other =
                        QFile::exists(root() + "core/" + include.name) ? "core/" + include.name : include.name;
                    if (include.isQuoted && unitOf(other) != unit)
                        units[unit].insert(unitOf(other));
                }
            }
        QVERIFY(units.size() > 300);
        QCOMPARE(circleIn(units).join(" -> "), QString());
    }

    void circlesAreFound()
    {
        QCOMPARE(circleIn({{"a", {"b", "c"}}, {"b", {"c"}}, {"c", {"d"}}}), QStringList());
        QCOMPARE(circleIn({{"a", {"b"}}, {"b", {"c"}}, {"c", {"d", "b"}}}).join(" "), QString("b c b"));
    }

    void arrowsStayWithinTheLimit()
    {
        QMap<QString, QString> texts;
        for (const QString &path : filesIn("core"))
            texts[path] = contentOf("core/" + path);
        const Units arrows = arrowsOf(texts);
        qsizetype count = 0;
        for (const QString &room : order) {
            QStringList others = arrows[room].values();
            std::sort(others.begin(), others.end(),
                      [](const QString &a, const QString &b) { return order.indexOf(a) < order.indexOf(b); });
            qInfo().noquote() << room << "->" << others.join(' ');
            count += others.size();
        }
        QVERIFY2(count <= mostArrows, qPrintable(QString("%1 arrows").arg(count)));
    }

    void arrowsAreFound()
    {
        const Units arrows =
            arrowsOf({{"track/A.h", "#include \"detect/Smd.h\"\n#include \"track/B.h\"\n#include <vector>"},
                      {"track/B.h", "#include \"detect/Detector.h\"\n#include \"base/Axis.h\""}});
        QCOMPARE(arrows, (Units{{"track", {"detect", "base"}}}));
    }

    void besideTheCore_data()
    {
        QTest::addColumn<QString>("folder");
        QTest::addColumn<QString>("own");
        QTest::newRow("python") << "python"
                                << "bindings/";
        QTest::newRow("reproduce") << "reproduce"
                                   << "reproduce/";
    }

    void besideTheCore()
    {
        QFETCH(QString, folder);
        QFETCH(QString, own);
        int seen = 0;
        for (const QString &path : filesIn(folder)) {
            ++seen;
            for (const Include &include : includesOf(contentOf(folder + "/" + path))) {
                const bool isKnown = !include.isQuoted || include.name.startsWith(own)
                                     || order.contains(include.name.section('/', 0, 0));
                QVERIFY2(isKnown && !isQt(include.name), qPrintable(path + " includes " + include.name));
            }
        }
        QVERIFY(seen > 1);
    }

    void wrongIncludesAreFound_data()
    {
        QTest::addColumn<QString>("path");
        QTest::addColumn<QString>("text");
        QTest::addColumn<bool>("isWrong");
        QTest::newRow("itself") << "model/X.h"
                                << "#include \"model/StateSpace.h\"" << false;
        QTest::newRow("leftward") << "model/X.h"
                                  << "#include \"base/Axis.h\"\n#include <vector>" << false;
        QTest::newRow("rightward") << "model/X.h"
                                   << "#include <vector>\n#include \"detect/Smd.h\"" << true;
        QTest::newRow("indented") << "model/X.h"
                                  << "  #  include \"detect/Smd.h\"" << true;
        QTest::newRow("neighbour without its folder") << "model/X.h"
                                                      << "#include \"StateSpace.h\"" << true;
        QTest::newRow("gone") << "model/X.h"
                              << "#include \"model/Gone.h\"" << true;
        QTest::newRow("another part") << "model/X.h"
                                      << "#include \"widgets/base/Viewport.h\"" << true;
        QTest::newRow("Qt class") << "model/X.h"
                                  << "#include <QString>" << true;
        QTest::newRow("Qt module") << "model/X.h"
                                   << "#include <QtCore/QString>" << true;
        QTest::newRow("FFTW") << "frames/Spectrogram.cpp"
                              << "#include <fftw3.h>" << true;
        QTest::newRow("FFTW in its place") << "signal/Fft.cpp"
                                           << "#include <fftw3.h>" << false;
    }

    void wrongIncludesAreFound()
    {
        QFETCH(QString, path);
        QFETCH(QString, text);
        QFETCH(bool, isWrong);
        QCOMPARE(!wrongInCore(path, text).isEmpty(), isWrong);
    }

private:
    QStringList filesIn(const QString &folder) const
    {
        QStringList files;
        for (QDirIterator i(root() + folder, {"*.h", "*.cpp"}, QDir::Files, QDirIterator::Subdirectories); i.hasNext();)
            files.append(QDir(root() + folder).relativeFilePath(i.next()));
        files.sort();
        return files;
    }
};

FAINTLINE_TEST(tst_layers)
#include "tst_layers.moc"
