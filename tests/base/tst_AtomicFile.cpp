#include "base/files/AtomicFile.h"
#include "support/test.h"

#include "base/Error.h"
#include "base/files/InputFiles.h"

#include <sys/stat.h>
#include <unistd.h>

using namespace faintline;

/// Files that appear whole or not at all.
class tst_AtomicFile : public QObject
{
    Q_OBJECT

private slots:
    void appearsAtTheCommit()
    {
        AtomicFile file(path("a"));
        file.write("one, ");
        file.write("two");
        QCOMPARE(content("a"), QByteArray("none"));
        file.commit();
        QCOMPARE(content("a"), QByteArray("one, two"));
        writeTextFile(path("a"), "three");
        QCOMPARE(content("a"), QByteArray("three"));
        QCOMPARE(QDir(m_folder.path()).entryList(QDir::Files), QStringList{"a"});
    }

    void withoutCommitNothingHappens()
    {
        writeTextFile(path("b"), "before");
        {
            AtomicFile file(path("b"));
            file.write("after");
            AtomicFile other(path("c"));
        }
        QCOMPARE(content("b"), QByteArray("before"));
        QCOMPARE(content("c"), QByteArray("none"));
        QVERIFY(QDir(m_folder.path()).entryList({"*.part"}, QDir::Files).isEmpty());
    }

    void permissionsAreTheUsual()
    {
        const mode_t mask = ::umask(022);
        writeTextFile(path("d"), "x");
        ::umask(mask);
        struct stat status = {};
        QCOMPARE(::stat(path("d").c_str(), &status), 0);
        QCOMPARE(status.st_mode & 0777u, 0644u);
    }

    void twoAtATime()
    {
        AtomicFile one(path("e"));
        AtomicFile two(path("e"));
        one.write("one");
        two.write("two");
        two.commit();
        one.commit();
        QCOMPARE(content("e"), QByteArray("one"));
    }

    void refusals()
    {
        QVERIFY_THROWS_EXCEPTION(Error, AtomicFile(path("no/folder")));
        QVERIFY_THROWS_EXCEPTION(Error, AtomicFile(m_folder.path().toStdString()));
        QVERIFY_THROWS_EXCEPTION(Error, AtomicFile("/dev/null"));
    }

    void inputsAreNotReplaced_data()
    {
        QTest::addColumn<QByteArray>("name");
        for (const char *name : {"input", "./input", "folder/../input", "folder/symbolic", "hard", "linked/input"})
            QTest::newRow(name) << QByteArray(name);
    }

    void inputsAreNotReplaced()
    {
        QFETCH(QByteArray, name);
        const QTemporaryDir folder;
        const auto in = [&](const QByteArray &file) { return folder.filePath(file).toStdString(); };
        QVERIFY(QDir(folder.path()).mkpath("folder"));
        writeTextFile(in("input"), "kept");
        QCOMPARE(::link(in("input").c_str(), in("hard").c_str()), 0);
        QCOMPARE(::symlink("../input", in("folder/symbolic").c_str()), 0);
        QCOMPARE(::symlink(".", in("linked").c_str()), 0);
        const auto contentNow = [&] {
            QFile file(folder.filePath("input"));
            return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
        };
        {
            const InputFiles inputs({in("input"), in("no such file"), in("folder")});
            QVERIFY_THROWS_EXCEPTION(Error, writeTextFile(in(name), "lost"));
            QVERIFY_THROWS_EXCEPTION(Error, InputFiles::refuse(in(name)));
            writeTextFile(in("another"), "result"); // others are written
            writeTextFile(in("no such file"), "result");
        }
        QCOMPARE(contentNow(), QByteArray("kept"));
        writeTextFile(in("input"), "read no more");
        QCOMPARE(contentNow(), QByteArray("read no more"));
    }

    /// Of a file that does not exist yet, too.
    void oneFileHasManyNames()
    {
        const QTemporaryDir folder;
        const auto in = [&](const char *file) { return folder.filePath(file).toStdString(); };
        writeTextFile(in("file"), "text");
        QCOMPARE(::link(in("file").c_str(), in("hard").c_str()), 0);
        QCOMPARE(::symlink("file", in("symbolic").c_str()), 0);
        QCOMPARE(::symlink("new", in("dangling").c_str()), 0);
        QCOMPARE(::symlink(".", in("folder").c_str()), 0);
        for (const char *name : {"file", "./file", "hard", "symbolic", "folder/file"})
            QVERIFY2(isSameFile(in("file"), in(name)) && !isSameFile(in("new"), in(name)), name);
        for (const char *name : {"new", "./new", "dangling", "folder/new", "folder/dangling"})
            QVERIFY2(isSameFile(in("new"), in(name)) && !isSameFile(in("file"), in(name)), name);
        QVERIFY(!isSameFile(in("new"), in("newer")));
        QVERIFY(isSameFile("a name", "./a name"));
    }

    /// A document keeps its place as an input when it is written anew, as another file of that name.
    void documentsAreWrittenAgain()
    {
        writeTextFile(path("document"), "before");
        const InputFiles inputs({path("document")});
        writeTextFile(path("document"), "after", Durability::Program, Written::Document);
        QCOMPARE(content("document"), QByteArray("after"));
        QVERIFY_THROWS_EXCEPTION(Error, writeTextFile(path("document"), "a result"));
        QCOMPARE(content("document"), QByteArray("after"));
    }

private:
    QByteArray content(const char *name) const
    {
        QFile file(m_folder.filePath(name));
        return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray("none");
    }
    std::string path(const char *name) const { return m_folder.filePath(name).toStdString(); }

    QTemporaryDir m_folder;
};

FAINTLINE_TEST(tst_AtomicFile)
#include "tst_AtomicFile.moc"
