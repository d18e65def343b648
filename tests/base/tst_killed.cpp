#include "base/files/AtomicFile.h"
#include "support/files.h"
#include "support/test.h"

#include <csignal>

#include <sys/wait.h>
#include <unistd.h>

using namespace faintline;
using namespace faintline::test;

namespace {

constexpr int letters = 200000;

std::string textOf(int version)
{
    return std::string(letters, static_cast<char>('a' + version % 26)) + std::to_string(version);
}

/// Writes one version after the other, and tells on a pipe which is on the disk.
[[noreturn]] void writeForEver(const std::string &session, const std::string &result, int pipe)
{
    for (int version = 1;; ++version) {
        writeTextFile(session, textOf(version));
        CommitTogether files;
        writeTextFile(result + ".provenance.json", std::to_string(version));
        writeTextFile(result, textOf(version));
        files.commit();
        (void)!::write(pipe, &version, sizeof version);
    }
}

} // namespace

/// What a program leaves that is killed while it writes, at any moment: sessions, recovery, results with what tells of
/// them.
class tst_killed : public QObject
{
    Q_OBJECT

private slots:
    void filesAreWholeAndNewest()
    {
        const int kills =
            qEnvironmentVariableIsSet("FAINTLINE_KILLS") ? qEnvironmentVariableIntValue("FAINTLINE_KILLS") : 5;
        const QTemporaryDir folder;
        const std::string session = folder.filePath("session").toStdString();
        const std::string result = folder.filePath("result").toStdString();
        QRandomGenerator random(1);
        for (int kill = 0; kill < kills; ++kill) {
            int ends[2];
            QVERIFY(::pipe(ends) == 0);
            const pid_t child = ::fork();
            if (child == 0)
                writeForEver(session, result, ends[1]);
            ::close(ends[1]);
            int version = 0;
            int told = 0;
            for (int i = random.bounded(5); i >= 0 && ::read(ends[0], &told, sizeof told) == sizeof told; --i)
                version = told;
            ::usleep(static_cast<useconds_t>(random.bounded(3000)));
            ::kill(child, SIGKILL);
            ::waitpid(child, nullptr, 0);
            while (::read(ends[0], &told, sizeof told) == sizeof told)
                version = told;
            ::close(ends[0]);

            const int kept = readBytes(session).mid(letters).toInt();
            QVERIFY(kept >= version && kept <= version + 1);
            QVERIFY(readBytes(session).toStdString() == textOf(kept));
            const int made = readBytes(result).mid(letters).toInt();
            const int provenance = readBytes(result + ".provenance.json").toInt();
            QVERIFY(readBytes(result).toStdString() == textOf(made));
            QVERIFY(made >= version && provenance >= made
                    && provenance <= made + 1); // never later than what tells of it
        }
        writeTextFile(session, "");
        writeTextFile(result, "");
        writeTextFile(result + ".provenance.json", "");
        QCOMPARE(QDir(folder.path()).entryList(QDir::Files).size(), 3); // and nothing of the killed
    }
};

FAINTLINE_TEST(tst_killed)
#include "tst_killed.moc"
