#include "signal/fileHash.h"
#include "support/test.h"

#include "signal/FileBytes.h"
#include "support/errors.h"

#include <sys/stat.h>

using namespace faintline;
using namespace faintline::test;

namespace {

constexpr qsizetype mebibyte = 1 << 20;

QByteArray littleEndian(std::uint64_t value)
{
    QByteArray text;
    for (int i = 0; i < 8; ++i)
        text.append(char(value >> (8 * i) & 0xff));
    return text;
}

std::string sha256(const QByteArray &bytes)
{
    return QCryptographicHash::hash(bytes, QCryptographicHash::Sha256).toHex().toStdString();
}

/// Bytes that differ everywhere.
QByteArray pattern(qsizetype count, unsigned seed)
{
    QByteArray bytes(count, '\0');
    for (char &byte : bytes)
        byte = char((seed = seed * 1664525 + 1013904223) >> 24);
    return bytes;
}

} // namespace

/// Bytes of files at any place, and their hashes against Qt's implementation of SHA-256.
class tst_fileHash : public QObject
{
    Q_OBJECT

private slots:
    void knownHashes()
    {
        QCOMPARE(fileHash(write("abc", "abc")), // FIPS 180-4, appendix B.1
                 std::string("ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"));
        QCOMPARE(fileHash(write("empty", {})),
                 std::string("e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"));
        const QByteArray bytes = pattern(3 * mebibyte + 17, 1);
        QCOMPARE(fileHash(write("some", bytes)), sha256(bytes));
    }

    void aLongFileIsHashedByItsEnds()
    {
        const qsizetype limit = 64 * mebibyte;
        QFile file(m_folder.filePath("long")); // with a hole, so that it takes no room
        const auto put = [&](qsizetype at, const QByteArray &bytes) {
            return file.open(QIODevice::ReadWrite) && file.seek(at) && file.write(bytes) == bytes.size()
                   && (file.close(), true);
        };
        const QByteArray first = pattern(mebibyte, 2), last = pattern(mebibyte, 6);
        QVERIFY(put(0, first) && put(limit - mebibyte, last));
        const std::string path = file.fileName().toStdString();
        QCOMPARE(fileHash(path), sha256(first + QByteArray(limit - 2 * mebibyte, '\0') + last)); // all of it

        QVERIFY(put(limit, "x"));
        const std::string expected =
            "part:" + sha256(first + last.sliced(1) + 'x' + littleEndian(std::uint64_t(limit) + 1));
        QCOMPARE(fileHash(path), expected);
        QVERIFY(put(limit / 2, "y")); // in the middle: not seen
        QCOMPARE(fileHash(path), expected);
        QVERIFY(put(5, first.at(5) == 'z' ? "w" : "z"));
        QVERIFY(fileHash(path) != expected);
    }

    void manyFilesAreHashedInTheirOrder()
    {
        const QByteArray a = pattern(200000, 3), b = pattern(10, 4);
        const std::string first = write("a", a), second = write("b", b);
        const QByteArray ofA = a.first(1 << 16) + a.last(1 << 16) + littleEndian(200000);
        const QByteArray ofB = b + b + littleEndian(10); // shorter than its ends
        QCOMPARE(filesHash({first, second}), "files:" + sha256(ofA + ofB));
        QCOMPARE(filesHash({second, first}), "files:" + sha256(ofB + ofA));
    }

    void bytesAreReadAtAnyPlace()
    {
        const QByteArray bytes = pattern(1000, 5);
        const FileBytes file(write("bytes", bytes));
        QCOMPARE(file.size(), Index(1000));
        for (const auto &[offset, wanted, expected] :
             {std::tuple(0, 1000, 1000), {990, 5, 5}, {990, 50, 10}, {1000, 5, 0}, {5000, 5, 0}, {3, 0, 0}}) {
            std::vector<std::byte> out(std::size_t(wanted), std::byte(0xee));
            QCOMPARE(file.readAt(offset, out), std::size_t(expected));
            QCOMPARE(QByteArray(reinterpret_cast<const char *>(out.data()), expected), bytes.mid(offset, expected));
            QVERIFY(std::all_of(out.begin() + expected, out.end(), [](std::byte b) { return b == std::byte(0xee); }));
        }
    }

    void aFileMayBeRenamedAndShrink()
    {
        const std::string path = write("moving", "0123456789");
        const FileBytes file(path);
        QVERIFY(QFile::rename(QString::fromStdString(path), m_folder.filePath("moved")));
        std::vector<std::byte> out(4);
        QCOMPARE(file.readAt(4, out), std::size_t(4));
        QVERIFY(QFile::resize(m_folder.filePath("moved"), 6));
        QCOMPARE(file.readAt(4, out), std::size_t(2));
        QCOMPARE(file.size(), Index(10)); // as it was opened
    }

    void whatIsNoFileIsRefused()
    {
        const std::string folder = m_folder.path().toStdString();
        QVERIFY(contains(errorOf([&] { FileBytes(folder + "/nothing"); }), "no such file"));
        QVERIFY(contains(errorOf([&] { FileBytes(write("file", "x") + "/inside"); }), "no such file"));
        std::string why;
        try {
            FileBytes file(write("file", "x") + std::string(1, '\0') + "y"); // the system would open the part before
        } catch (const Error &error) {
            why = error.why();
        }
        QVERIFY(contains(why, "zero byte"));
        QVERIFY(contains(errorOf([&] { FileBytes{folder}; }), "is a folder"));
        QVERIFY(contains(errorOf([] { FileBytes("/dev/null"); }), "is a device or a pipe"));
        const std::string pipe = folder + "/pipe";
        QCOMPARE(mkfifo(pipe.c_str(), 0600), 0);
        QVERIFY(contains(errorOf([&] { FileBytes{pipe}; }), "is a device or a pipe")); // and does not wait for a writer
    }

private:
    std::string write(const QString &name, const QByteArray &content)
    {
        QFile file(m_folder.filePath(name));
        if (!file.open(QIODevice::WriteOnly) || file.write(content) != content.size())
            qFatal("cannot write");
        return file.fileName().toStdString();
    }

    QTemporaryDir m_folder;
};

FAINTLINE_TEST(tst_fileHash)
#include "tst_fileHash.moc"
