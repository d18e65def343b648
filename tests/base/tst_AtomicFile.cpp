#include "base/AtomicFile.h"
#include "support/test.h"

#include "base/Error.h"

#include <QDir>

#include <sys/stat.h>

using namespace faintline;

/// Files that appear whole or not at all.
class tst_AtomicFile : public QObject
{
    Q_OBJECT

private slots:
    void appearsAtTheCommit();
    void withoutCommitNothingHappens();
    void permissionsAreTheUsual();
    void twoAtATime();
    void refusals();

private:
    QByteArray content(const char *name) const
    {
        QFile file(m_folder.filePath(name));
        return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray("none");
    }
    std::string path(const char *name) const { return m_folder.filePath(name).toStdString(); }

    QTemporaryDir m_folder;
};

void tst_AtomicFile::appearsAtTheCommit()
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

void tst_AtomicFile::withoutCommitNothingHappens()
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

void tst_AtomicFile::permissionsAreTheUsual()
{
    const mode_t mask = ::umask(022);
    writeTextFile(path("d"), "x");
    ::umask(mask);
    struct stat status = {};
    QCOMPARE(::stat(path("d").c_str(), &status), 0);
    QCOMPARE(status.st_mode & 0777u, 0644u);
}

void tst_AtomicFile::twoAtATime()
{
    AtomicFile one(path("e"));
    AtomicFile two(path("e"));
    one.write("one");
    two.write("two");
    two.commit();
    one.commit();
    QCOMPARE(content("e"), QByteArray("one"));
}

void tst_AtomicFile::refusals()
{
    QVERIFY_THROWS_EXCEPTION(Error, AtomicFile(path("no/folder")));
    QVERIFY_THROWS_EXCEPTION(Error, AtomicFile(m_folder.path().toStdString()));
    QVERIFY_THROWS_EXCEPTION(Error, AtomicFile("/dev/null"));
}

FAINTLINE_TEST(tst_AtomicFile)
#include "tst_AtomicFile.moc"
