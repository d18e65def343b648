#include <QDirIterator>
#include <QRegularExpression>
#include <QtTest>

/// Who may know whom: a folder of the core includes itself and those to its left, and nothing else of the project.
class tst_layers : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase();
    void foldersAreKnown();
    void core_data();
    void core();
    void widgetsKnowNoApp();
    void commandLineKnowsTheCoreOnly();
    void pythonKnowsTheCoreOnly();
    void wrongIncludesAreFound_data();
    void wrongIncludesAreFound();

private:
    QStringList filesIn(const QString &folder) const;
};

namespace {

    const QStringList order{"base", "recording", "spectrum", "model", "detect", "track", "analysis", "evaluate", "exchange"};

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
        static const QRegularExpression pattern(R"(^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"])", QRegularExpression::MultilineOption);
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
        const auto rank = order.indexOf(path.section('/', 0, 0));
        for (const Include &include : includesOf(text)) {
            if (isQt(include.name))
                return include.name + " is Qt";
            if (include.name == "fftw3.h" && path != "spectrum/Fft.cpp")
                return "fftw3.h belongs to spectrum/Fft.cpp alone";
            if (include.name == "hdf5.h" && path != "recording/Hdf5File.cpp")
                return "hdf5.h belongs to recording/Hdf5File.cpp alone";
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

} // namespace

QStringList tst_layers::filesIn(const QString &folder) const
{
    QStringList files;
    for (QDirIterator i(root() + folder, {"*.h", "*.cpp"}, QDir::Files, QDirIterator::Subdirectories); i.hasNext();)
        files.append(QDir(root() + folder).relativeFilePath(i.next()));
    files.sort();
    return files;
}

void tst_layers::initTestCase()
{
    QVERIFY2(QFile::exists(root() + "core/base/Axis.h"), "the source tree is not where it was built");
}

void tst_layers::foldersAreKnown()
{
    for (const QString &folder : QDir(root() + "core").entryList(QDir::Dirs | QDir::NoDotAndDotDot))
        QVERIFY2(order.contains(folder), qPrintable(folder));
    QVERIFY(filesIn("core").size() > 40);
}

void tst_layers::core_data()
{
    QTest::addColumn<QString>("path");
    for (const QString &path : filesIn("core"))
        QTest::newRow(qPrintable(path)) << path;
}

void tst_layers::core()
{
    QFETCH(QString, path);
    const QString wrong = wrongInCore(path, contentOf("core/" + path));
    QVERIFY2(wrong.isEmpty(), qPrintable(wrong));
}

void tst_layers::widgetsKnowNoApp()
{
    for (const QString &path : filesIn("widgets"))
        for (const Include &include : includesOf(contentOf("widgets/" + path))) {
            const QString message = path + " includes " + include.name;
            QVERIFY2(!include.name.startsWith("app/"), qPrintable(message));
            QVERIFY2(!include.isQuoted || include.name.contains('/') || !QFile::exists(root() + "app/" + include.name), qPrintable(message));
        }
}

void tst_layers::commandLineKnowsTheCoreOnly()
{
    int seen = 0;
    for (const QString &path : filesIn("app")) {
        if (path != "cli.cpp" && !path.startsWith("cli/"))
            continue;
        ++seen;
        for (const Include &include : includesOf(contentOf("app/" + path))) {
            const bool isKnown = !include.isQuoted || include.name.startsWith("app/cli/")
                || order.contains(include.name.section('/', 0, 0));
            QVERIFY2(isKnown && !isQt(include.name), qPrintable(path + " includes " + include.name));
        }
    }
    QVERIFY(seen > 1);
}

void tst_layers::pythonKnowsTheCoreOnly()
{
    int seen = 0;
    for (const QString &path : filesIn("python")) {
        ++seen;
        for (const Include &include : includesOf(contentOf("python/" + path))) {
            const bool isKnown = !include.isQuoted || include.name.startsWith("bindings/") || order.contains(include.name.section('/', 0, 0));
            QVERIFY2(isKnown && !isQt(include.name), qPrintable(path + " includes " + include.name));
        }
    }
    QVERIFY(seen > 1);
}

void tst_layers::wrongIncludesAreFound_data()
{
    QTest::addColumn<QString>("path");
    QTest::addColumn<QString>("text");
    QTest::addColumn<bool>("isWrong");
    QTest::newRow("itself") << "model/X.h" << "#include \"model/StateSpace.h\"" << false;
    QTest::newRow("leftward") << "model/X.h" << "#include \"base/Axis.h\"\n#include <vector>" << false;
    QTest::newRow("rightward") << "model/X.h" << "#include <vector>\n#include \"detect/Smd.h\"" << true;
    QTest::newRow("indented") << "model/X.h" << "  #  include \"detect/Smd.h\"" << true;
    QTest::newRow("neighbour without its folder") << "model/X.h" << "#include \"StateSpace.h\"" << true;
    QTest::newRow("gone") << "model/X.h" << "#include \"model/Gone.h\"" << true;
    QTest::newRow("another part") << "model/X.h" << "#include \"widgets/Viewport.h\"" << true;
    QTest::newRow("Qt class") << "model/X.h" << "#include <QString>" << true;
    QTest::newRow("Qt module") << "model/X.h" << "#include <QtCore/QString>" << true;
    QTest::newRow("FFTW") << "spectrum/Spectrogram.cpp" << "#include <fftw3.h>" << true;
    QTest::newRow("FFTW in its place") << "spectrum/Fft.cpp" << "#include <fftw3.h>" << false;
}

void tst_layers::wrongIncludesAreFound()
{
    QFETCH(QString, path);
    QFETCH(QString, text);
    QFETCH(bool, isWrong);
    QCOMPARE(!wrongInCore(path, text).isEmpty(), isWrong);
}

QTEST_APPLESS_MAIN(tst_layers)
#include "tst_layers.moc"
