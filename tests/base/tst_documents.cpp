#include "support/test.h"

namespace {

QString root()
{
    return QStringLiteral(FAINTLINE_SOURCE_DIR "/");
}

QString contentOf(const QString &path)
{
    QFile file(root() + path);
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

QStringList found(const QString &text, const char *pattern)
{
    QStringList all;
    const QRegularExpression expression(QString::fromLatin1(pattern));
    for (auto i = expression.globalMatch(text); i.hasNext();)
        all << i.next().captured(1);
    return all;
}

} // namespace

/// What the documents say of the source tree is so: links lead somewhere, files that are named exist, code that is
/// shown is code that runs.
class tst_documents : public QObject
{
    Q_OBJECT

private slots:
    void linksLeadSomewhere_data() { documents(); }

    void linksLeadSomewhere()
    {
        QFETCH(QString, path);
        const QString text = contentOf(path);
        QVERIFY(!text.isEmpty());
        const QDir folder = QFileInfo(root() + path).dir();
        for (const QString &link : found(text, R"(\]\(([^)#]+)\))"))
            QVERIFY2(link.contains("://") || QFile::exists(folder.filePath(link)), qPrintable(link));
    }

    void namedFilesExist_data() { documents(); }

    void namedFilesExist()
    {
        QFETCH(QString, path);
        // A folder of the source tree and what is in it, with or without the extension, as `core/detect` or
        // `tests/detect/tst_Sprt`.
        for (const QString &name :
             found(contentOf(path), R"(`((?:core|widgets|app|tests|docs|examples|resources)/[\w./-]+))")) {
            const QFileInfo file(root() + name);
            const bool isUnit = !file.dir().entryList({file.fileName() + ".*"}).isEmpty();
            QVERIFY2(file.exists() || isUnit, qPrintable(name));
        }
    }

    void readmeShowsAnExampleThatRuns()
    {
        const QStringList shown = found(contentOf("README.md"), R"((?s)```cpp\n(.*?)```)");
        QCOMPARE(shown.size(), 1);
        QCOMPARE(shown.front(), contentOf("examples/01-samples.cpp"));
    }

    void examplesAreShort()
    {
        constexpr int longest = 40;
        const QStringList names = QDir(root() + "examples").entryList({"0[1-5]-*.cpp"}, QDir::Files);
        QCOMPARE(names.size(), 5);
        for (const QString &name : names)
            QVERIFY2(contentOf("examples/" + name).count('\n') <= longest, qPrintable(name));
    }

private:
    static void documents()
    {
        QTest::addColumn<QString>("path");
        for (const char *path :
             {"README.md", "CONTRIBUTING.md", "CHANGELOG.md", "core/README.md", "docs/design.md", "docs/theory.md",
              "docs/performance.md", "docs/reference/scenes.md", "docs/reference/grids.md",
              "docs/reference/experiments.md", "docs/reference/lessons.md", "docs/reference/survey.md"})
            QTest::newRow(path) << QString::fromLatin1(path);
    }
};

FAINTLINE_TEST(tst_documents)
#include "tst_documents.moc"
