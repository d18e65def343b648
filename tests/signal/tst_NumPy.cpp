#include "signal/formats/NumPy.h"
#include "support/test.h"

#include "support/recordings.h"

#include <limits>

using namespace faintline;
using namespace faintline::test;

namespace {

/// A file of NumPy's format put together by hand.
QByteArray file(const QByteArray &dictionary, const QByteArray &data, char version = 1)
{
    QByteArray header = dictionary;
    const int before = version == 1 ? 10 : 12;
    while ((before + header.size() + 1) % 64 != 0)
        header += ' ';
    header += '\n';
    QByteArray bytes("\x93NUMPY", 6);
    bytes += version;
    bytes += '\0';
    bytes += static_cast<char>(header.size() & 0xff);
    bytes += static_cast<char>(header.size() >> 8);
    if (version > 1)
        bytes += QByteArray(2, '\0');
    return bytes + header + data;
}

QByteArray dictionary(const char *type, const char *shape, const char *order = "False")
{
    return QByteArray("{'descr': '") + type + "', 'fortran_order': " + order + ", 'shape': " + shape + ", }";
}

template <class T>
QByteArray bytesOf(const std::vector<T> &values)
{
    return {reinterpret_cast<const char *>(values.data()), qsizetype(values.size() * sizeof(T))};
}

void write(const std::string &path, const std::vector<Index> &shape, const std::vector<float> &values)
{
    NumPyWriter writer(path, shape);
    writer.write(values);
    writer.finish();
}

} // namespace

/// Arrays in NumPy's format: written as NumPy writes them, read back bit for bit, and hostile files refused.
class tst_NumPy : public QObject
{
    Q_OBJECT

private slots:
    void bytesByEye()
    {
        write(path("eye.npy"), {2, 3}, {0, 1, 2, 3, 4, 5});
        const QByteArray bytes = readBytes(path("eye.npy"));
        QCOMPARE(bytes.size(), qsizetype(128 + 24)); // values begin at a multiple of 64
        QCOMPARE(bytes.left(10), QByteArray("\x93NUMPY\x01\x00\x76\x00", 10));
        QVERIFY(bytes.mid(10, 118).startsWith("{'descr': '<f4', 'fortran_order': False, 'shape': (2,3,), }"));
        QCOMPARE(bytes[127], '\n');
        QCOMPARE(bytes.mid(128 + 4, 4), QByteArray("\x00\x00\x80\x3f", 4)); // 1.0f, little-endian
    }

    void readsBackBitForBit_data()
    {
        QTest::addColumn<std::vector<Index>>("shape");
        QTest::newRow("vector") << std::vector<Index>{7};
        QTest::newRow("matrix") << std::vector<Index>{3, 5};
        QTest::newRow("four axes") << std::vector<Index>{2, 1, 3, 4};
        QTest::newRow("one value") << std::vector<Index>{1, 1};
        QTest::newRow("no axis") << std::vector<Index>{};
        QTest::newRow("no value") << std::vector<Index>{0, 5};
        QTest::newRow("more than one buffer") << std::vector<Index>{300, 501};
    }

    void readsBackBitForBit()
    {
        QFETCH(std::vector<Index>, shape);
        Index count = 1;
        for (Index n : shape)
            count *= n;
        std::vector<float> values = someNoise(count);
        const std::vector<float> special{-0.0f, INFINITY, -INFINITY, 1e-45f, std::numeric_limits<float>::max()};
        std::copy_n(special.begin(), std::min(special.size(), values.size()), values.begin());
        write(path("round.npy"), shape, values);
        const NumPyArray array = readNumPy(path("round.npy"));
        QCOMPARE(array.shape, shape);
        QCOMPARE(bytesOf(array.values), bytesOf(values));
    }

    void doublesAreRounded()
    {
        writeBytes(path("f8.npy"),
                   file(dictionary("<f8", "(4,)"), bytesOf(std::vector<double>{0.1, -2.5, 1e300, 1e-300})));
        const NumPyArray array = readNumPy(path("f8.npy"));
        QCOMPARE(array.values[0], 0.1f);
        QCOMPARE(array.values[1], -2.5f);
        QCOMPARE(array.values[2], INFINITY); // what single precision makes of it; readFrames refuses it
        QCOMPARE(array.values[3], 0.0f);
    }

    void headersOfOthers_data()
    {
        QTest::addColumn<QByteArray>("bytes");
        const QByteArray data = bytesOf(std::vector<float>{1, 2, 3, 4, 5, 6});
        QTest::newRow("NumPy's own") << file("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }", data);
        QTest::newRow("another order of keys")
            << file("{'shape': (2, 3), 'fortran_order': False, 'descr': '<f4'}", data);
        QTest::newRow("no spaces") << file("{'descr':'<f4','fortran_order':False,'shape':(2,3)}", data);
        QTest::newRow("version 2") << file("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }", data, 2);
        QTest::newRow("version 3") << file("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }", data, 3);
        QTest::newRow("more than the shape says")
            << file("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }", data + data);
        QTest::newRow("double") << file("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }",
                                        bytesOf(std::vector<double>{1, 2, 3, 4, 5, 6}));
    }

    void headersOfOthers()
    {
        QFETCH(QByteArray, bytes);
        writeBytes(path("other.npy"), bytes);
        const NumPyArray array = readNumPy(path("other.npy"));
        QCOMPARE(array.shape, (std::vector<Index>{2, 3}));
        QCOMPARE(array.values, (std::vector<float>{1, 2, 3, 4, 5, 6}));
    }

    void refusals_data()
    {
        QTest::addColumn<QByteArray>("bytes");
        QTest::addColumn<QString>("message");
        const QByteArray data(64, '\0');
        const auto row = [](const char *name, const QByteArray &bytes, const char *message) {
            QTest::newRow(name) << bytes << QString::fromUtf8(message);
        };
        row("empty", "", "is not a NumPy file (.npy)");
        row("text", "frame,cell,value\n0,0,1\n", "is not a NumPy file (.npy)");
        row("Fortran order", file(dictionary("<f4", "(2, 3)", "True"), data),
            "is in Fortran order; save it in C order");
        row("big-endian", file(dictionary(">f4", "(2, 3)"), data),
            "holds '>f4'; expected float32 or float64, little-endian");
        row("integers", file(dictionary("<i4", "(2, 3)"), data), "holds '<i4'; expected float32");
        row("complex", file(dictionary("<c8", "(2, 3)"), data), "holds '<c8'; expected float32");
        row("objects", file(dictionary("|O", "(2, 3)"), data), "holds '|O'; expected float32");
        row("structure", file("{'descr': [('a', '<f4')], 'fortran_order': False, 'shape': (2, 3)}", data),
            "holds records; expected numbers");
        row("no type", file("{'fortran_order': False, 'shape': (2, 3)}", data), "has no 'descr'");
        row("no order", file("{'descr': '<f4', 'shape': (2, 3)}", data), "has no 'fortran_order'");
        row("no shape", file("{'descr': '<f4', 'fortran_order': False}", data), "has no 'shape'");
        row("shape is a number", file(dictionary("<f4", "6"), data), "its NumPy header has no shape");
        row("negative", file(dictionary("<f4", "(2, -3)"), data), "its NumPy shape holds '-3'");
        row("fraction", file(dictionary("<f4", "(2, 1.5)"), data), "its NumPy shape holds '1.5'");
        row("word", file(dictionary("<f4", "(2, x)"), data), "its NumPy shape holds 'x'");
        row("not closed", file("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3", data), "");
        row("not a number", file(dictionary("<f4", "(nan, 3)"), data), "its NumPy shape holds 'nan'");
        row("infinite", file(dictionary("<f4", "(inf, 3)"), data), "its NumPy shape holds 'inf'");
        row("too many values", file(dictionary("<f4", "(65536, 65536)"), data), "holds more than 2³¹ values");
        row("overflowing product", file(dictionary("<f4", "(4294967296, 4294967296, 4)"), data),
            "holds more than 2³¹ values");
        row("overflowing before a 0", file(dictionary("<f4", "(1099511627776, 1099511627776, 0)"), data),
            "holds more than 2³¹ values");
        row("endless header", QByteArray("\x93NUMPY\x02\x00\xff\xff\xff\xff", 12) + data,
            "its NumPy header is too long");
    }

    void refusals()
    {
        QFETCH(QByteArray, bytes);
        QFETCH(QString, message);
        const std::string said = refusal(bytes);
        QVERIFY2(said.starts_with(path("refused.npy") + ": "), said.c_str());
        QVERIFY2(contains(said, message.toStdString()), said.c_str());
    }

    void cutShortAnywhere()
    {
        const QByteArray whole = file(dictionary("<f4", "(2, 3)"), bytesOf(std::vector<float>{1, 2, 3, 4, 5, 6}));
        QVERIFY(refusal(whole).empty());
        for (qsizetype length = 0; length < whole.size(); ++length) {
            const std::string said = refusal(whole.left(length));
            QVERIFY2(said.starts_with(path("refused.npy") + ": is "),
                     qPrintable(QString("%1 bytes: %2").arg(length).arg(said.c_str())));
        }
        const QByteArray second = file(dictionary("<f4", "(2, 3)"), QByteArray(24, '\0'), 2);
        for (qsizetype length = 0; length < second.size(); ++length)
            QVERIFY(!refusal(second.left(length)).empty());
    }

    void hugeShapesTakeNoMemory_data()
    {
        QTest::addColumn<QByteArray>("shape");
        QTest::newRow("2³¹ values") << QByteArray("(2147483648,)");
        QTest::newRow("a billion") << QByteArray("(1000, 1000, 1000)");
    }

    void hugeShapesTakeNoMemory()
    {
        // A file of 128 bytes that claims gigabytes is seen to be short before room is made for them.
        QFETCH(QByteArray, shape);
        for (const char *type : {"<f4", "<f8"})
            QVERIFY(contains(refusal(file(dictionary(type, shape.data()), {})), "is truncated: its shape ("));
    }

    void writtenInPieces()
    {
        const std::vector<float> values = someNoise(60);
        write(path("whole.npy"), {12, 5}, values);
        NumPyWriter writer(path("pieces.npy"), {12, 5});
        for (std::size_t first = 0; first < values.size(); first += 7)
            writer.write(std::span(values).subspan(first, std::min<std::size_t>(7, values.size() - first)));
        writer.finish();
        QCOMPARE(readBytes(path("pieces.npy")), readBytes(path("whole.npy")));
    }

    void tooFewOrTooManyValues()
    {
        for (std::size_t count : {0u, 5u, 7u}) {
            NumPyWriter writer(path("wrong.npy"), {2, 3});
            writer.write(std::vector<float>(count));
            const std::string said = errorOf([&] { writer.finish(); });
            QVERIFY2(contains(said, " of 6 values were written"), said.c_str());
        }
        QVERIFY(!QFile::exists(m_folder.filePath("wrong.npy")));
    }

    void appearsWhenFinished()
    {
        {
            NumPyWriter writer(path("late.npy"), {2});
            writer.write(std::vector<float>{1, 2});
            QVERIFY(!QFile::exists(m_folder.filePath("late.npy")));
        }
        QVERIFY(!QFile::exists(m_folder.filePath("late.npy"))); // never finished
        QVERIFY(QDir(m_folder.path()).entryList({"late*", ".late*"}, QDir::Files | QDir::Hidden).isEmpty());
    }

    void noSuchFile()
    {
        QVERIFY(contains(errorOf([&] { readNumPy(path("none.npy")); }), "none.npy: cannot be opened"));
        QVERIFY(!errorOf([&] { readNumPy(m_folder.path().toStdString()); }).empty());
        QVERIFY(!errorOf([&] { NumPyWriter(path("no/folder.npy"), {1}); }).empty());
    }

private:
    std::string path(const char *name) const { return m_folder.filePath(name).toStdString(); }
    std::string refusal(const QByteArray &bytes) const
    {
        writeBytes(path("refused.npy"), bytes);
        return errorOf([&] { readNumPy(path("refused.npy")); });
    }

    QTemporaryDir m_folder;
};

FAINTLINE_TEST(tst_NumPy)
#include "tst_NumPy.moc"
