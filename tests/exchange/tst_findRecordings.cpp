#include "exchange/survey/findRecordings.h"
#include "signal/fileFormats.h"
#include "support/test.h"

#include "support/recordings.h"

#include <unistd.h>

using namespace faintline;
using namespace faintline::test;

/// Which files of a tree are recordings, whatever is in them.
class tst_findRecordings : public QObject
{
    Q_OBJECT

private slots:
    void init() { m_folder = std::make_unique<QTemporaryDir>(); }

    void endingsCountAndNothingElse()
    {
        for (const char *name : {"a.wav", "b.WAV", "c.txt", "wav", "d.wav.part", "deep/er/e.flac", "deep/f.sigmf-meta",
                                 "deep/f.sigmf-data", "g.cf32"})
            make(name);
        QCOMPARE(found({"."}), QStringList({"a.wav", "b.WAV", "deep/er/e.flac", "deep/f.sigmf-meta"}));
        QVERIFY(m_unreadable.empty());
    }

    void rawSamplesInstead()
    {
        for (const char *name : {"a.wav", "b.cf32", "c/d.cs16", "e.txt"})
            make(name);
        QCOMPARE(found({"."}, true), QStringList({"b.cf32", "c/d.cs16"}));
    }

    void stacksNeedTheirGrid()
    {
        make("a.npy");
        make("b.npy");
        make("b.grid.json");
        QCOMPARE(found({"."}), QStringList({"b.npy"}));
    }

    void hiddenAndLinkedOnesAreLeftOut()
    {
        for (const char *name : {".hidden.wav", ".hidden/a.wav", "elsewhere/b.wav", "c.wav"})
            make(name);
        QVERIFY(QDir().mkpath(m_folder->filePath("tree")));
        QVERIFY(QFile::link(m_folder->filePath("elsewhere"), m_folder->filePath("tree/folder")));
        QVERIFY(QFile::link(m_folder->filePath("tree"), m_folder->filePath("tree/round"))); // no end of it
        QVERIFY(QFile::link(m_folder->filePath("c.wav"), m_folder->filePath("tree/file.wav")));
        QVERIFY(QFile::link(m_folder->filePath("nowhere.wav"), m_folder->filePath("tree/dangling.wav")));
        QCOMPARE(found({"tree"}), QStringList({"tree/file.wav"}));
        QCOMPARE(found({"."}), QStringList({"c.wav", "elsewhere/b.wav", "tree/file.wav"}));
    }

    void namedFilesAreTakenAsTheyAre()
    {
        make("notes.txt");
        make(".hidden.wav");
        QCOMPARE(found({"notes.txt", ".hidden.wav"}), QStringList({".hidden.wav", "notes.txt"}));
        QCOMPARE(found({"notes.txt"}, true), QStringList({"notes.txt"}));
    }

    void eachOnceInOrder()
    {
        for (const char *name : {"z.wav", "a/m.wav", "a/b.wav"})
            make(name);
        QCOMPARE(found({"z.wav", ".", "a", "a/../z.wav", "a/m.wav"}), QStringList({"a/b.wav", "a/m.wav", "z.wav"}));
        QVERIFY(found({}).isEmpty());
        QVERIFY(QDir().mkpath(m_folder->filePath("empty")));
        QVERIFY(found({"empty"}).isEmpty());
    }

    void samplesStandForTheirMetadata()
    {
        make("a.sigmf-data");
        make("a.sigmf-meta");
        QCOMPARE(found({"a.sigmf-data", "a.sigmf-meta"}), QStringList({"a.sigmf-meta"}));
        QCOMPARE(found({"a.sigmf-data"}, true), QStringList({"a.sigmf-data"}));
    }

    void refusals()
    {
        QCOMPARE(errorOf([&] { found({"nowhere.wav"}); }), path("nowhere.wav") + ": there is no such file or folder");
        std::vector<std::string> unreadable;
        QCOMPARE(errorOf([&] { findRecordings({"/dev/null"}, false, unreadable); }),
                 std::string("/dev/null: is neither a file nor a folder"));
    }

    void lockedFoldersAreTold()
    {
        if (::geteuid() == 0)
            QSKIP("skipped: root may read everything");
        make("locked/a.wav");
        make("b.wav");
        const QString locked = m_folder->filePath("locked");
        QVERIFY(QFile::setPermissions(locked, QFile::Permissions()));
        const QStringList names = found({"."});
        QVERIFY(QFile::setPermissions(locked, QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner));
        QCOMPARE(names, QStringList({"b.wav"}));
        QCOMPARE(m_unreadable, std::vector<std::string>{locked.toStdString()});
    }

    void everyEndingIsFound()
    {
        QStringList expected;
        for (const std::string &ending : recordingEndings()) {
            expected += QString::fromStdString("a." + ending);
            make(expected.back());
        }
        make("a.grid.json");
        expected.sort();
        QCOMPARE(found({"."}), expected);
    }

private:
    void make(const QString &name) const
    {
        QVERIFY(QDir().mkpath(QFileInfo(m_folder->filePath(name)).path()));
        writeBytes(path(name), "x");
    }
    std::string path(const QString &name) const { return m_folder->filePath(name).toStdString(); }

    /// Names below the folder, of what is found there.
    QStringList found(const QStringList &names, bool raw = false)
    {
        std::vector<std::string> paths;
        for (const QString &name : names)
            paths.push_back(path(name));
        m_unreadable.clear();
        QStringList below;
        for (const std::string &one : findRecordings(paths, raw, m_unreadable))
            below += QDir(m_folder->path()).relativeFilePath(QString::fromStdString(one));
        return below;
    }

    std::unique_ptr<QTemporaryDir> m_folder;
    std::vector<std::string> m_unreadable;
};

FAINTLINE_TEST(tst_findRecordings)
#include "tst_findRecordings.moc"
