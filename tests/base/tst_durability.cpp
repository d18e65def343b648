#include "base/Error.h"
#include "base/files/AtomicFile.h"
#include "support/test.h"

#include <cerrno>
#include <filesystem>
#include <vector>

#include <dlfcn.h>
#include <sys/stat.h>
#include <unistd.h>

namespace {

std::vector<std::string> calls; ///< what was done to the disk, in order
int failing = -1;               ///< the fsync that fails, counted from 0

std::string nameOf(int descriptor)
{
    std::error_code code;
    const std::filesystem::path path =
        std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(descriptor), code);
    return path.extension() == ".part" ? "temporary" : path.filename().string();
}

template <class Function>
Function *real(const char *name)
{
    return reinterpret_cast<Function *>(dlsym(RTLD_NEXT, name));
}

} // namespace

// A layer between the program and the C library that keeps books, and fails where it is told to.
extern "C" int fsync(int descriptor)
{
    calls.push_back("sync " + nameOf(descriptor));
    if (failing-- == 0) {
        errno = EIO;
        return -1;
    }
    return real<int(int)>("fsync")(descriptor);
}

extern "C" int rename(const char *from, const char *to) noexcept
{
    calls.push_back("rename to " + std::filesystem::path(to).filename().string());
    return real<int(const char *, const char *)>("rename")(from, to);
}

using namespace faintline;

/// What was written is on the disk before it has its name, and the name after that; several files appear together or
/// not at all.
class tst_durability : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_folder = std::make_unique<QTemporaryDir>();
        QVERIFY(QDir(m_folder->path()).mkdir("folder"));
        calls.clear();
        failing = -1;
    }

    void syncedBeforeAndAfterTheName()
    {
        writeTextFile(path("a"), "text");
        QCOMPARE(calls, (std::vector<std::string>{"sync temporary", "rename to a", "sync folder"}));
    }

    void whatMayBeLostIsNotSynced()
    {
        writeTextFile(path("a"), "text", Durability::Program);
        QCOMPARE(calls, std::vector<std::string>{"rename to a"});
    }

    void aDiskThatFails()
    {
        writeTextFile(path("a"), "before");
        failing = 0;
        QVERIFY_THROWS_EXCEPTION(Error, writeTextFile(path("a"), "after"));
        QCOMPARE(files(), QStringList{"a"});
        QCOMPARE(std::filesystem::file_size(path("a")), 6u);
    }

    void togetherOrNotAtAll()
    {
        {
            CommitTogether files;
            AtomicFile large(path("large"));
            writeTextFile(path("told"), "first");
            large.write("text");
            large.commit();
            QVERIFY(!std::filesystem::exists(path("told")) && !std::filesystem::exists(path("large")));
            QCOMPARE(large.path(), path("large"));
            files.commit();
        }
        QCOMPARE(calls, (std::vector<std::string>{"sync temporary", "sync temporary", "rename to told", "sync folder",
                                                  "rename to large", "sync folder"}));
        QCOMPARE(files(), (QStringList{"large", "told"}));

        calls.clear();
        {
            CommitTogether files;
            writeTextFile(path("told"), "second");
            failing = 0;
            QVERIFY_THROWS_EXCEPTION(Error, writeTextFile(path("large"), "text"));
        }
        QCOMPARE(std::filesystem::file_size(path("told")), 5u); // as before
        QCOMPARE(files(), (QStringList{"large", "told"}));
        writeTextFile(path("alone"), "again by itself");
        QVERIFY(std::filesystem::exists(path("alone")));
    }

    void abandonedFilesGo()
    {
        // As a killed program leaves them; none of the others is one of this file's.
        for (const char *name :
             {"a.4711-0.part", "a.4711-12.part", "a.part", "a.x-0.part", "ab.4711-0.part", "a.4711-0.part.old"})
            QVERIFY(QFile(m_folder->filePath("folder/") + name).open(QIODevice::WriteOnly));
        AtomicFile held(path("a")); // a file that is being written stays
        writeTextFile(path("a"), "text");
        QStringList expected{
            "a",
            QString::fromStdString(std::filesystem::path("a." + std::to_string(getpid()) + "-0.part").string()),
            "a.4711-0.part.old",
            "a.part",
            "a.x-0.part",
            "ab.4711-0.part"};
        QStringList found = files();
        expected.sort(); // a process may have any number
        found.sort();
        QCOMPARE(found, expected);
        held.write("later");
        held.commit();
        QCOMPARE(std::filesystem::file_size(path("a")), 5u);
    }

    void longNames()
    {
        const std::string name(250, 'n'); // a folder takes 255 letters
        writeTextFile(path(name), "text");
        QCOMPARE(files(), QStringList{QString::fromStdString(name)});
    }

private:
    std::string path(const std::string &name) const { return m_folder->path().toStdString() + "/folder/" + name; }
    QStringList files() const
    {
        return QDir(m_folder->filePath("folder")).entryList(QDir::Files | QDir::Hidden, QDir::Name);
    }

    std::unique_ptr<QTemporaryDir> m_folder;
};

FAINTLINE_TEST(tst_durability)
#include "tst_durability.moc"
