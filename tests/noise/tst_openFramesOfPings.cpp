#include "support/frames.h"
#include "support/test.h"

#include "noise/openFrames.h"
#include "noise/pings/NormalisedPings.h"
#include "signal/formats/NumPy.h"
#include "support/recordings.h"

#include <cmath>

using namespace faintline;
using namespace faintline::test;

namespace {

constexpr Index pings = 40;
constexpr Index ranges = 60;
constexpr Index beams = 8;
constexpr std::size_t values = std::size_t(pings * ranges * beams);

const char *const axes = R"("axes": [{"name": "range", "unit": "m", "first": 500, "step": 5},
    {"name": "bearing", "unit": "°", "step": 45, "cyclic": true}], "time": {"step": 20})";

QByteArray header(const QByteArray &type, const QByteArray &shape)
{
    QByteArray text = "{'descr': " + type + ", 'fortran_order': False, 'shape': " + shape + ", }";
    text = text.leftJustified(192 - 10 - 1, ' ') + '\n';
    return QByteArray("\x93NUMPY\x01\x00", 8) + char(text.size()) + '\0' + text;
}

template <class T>
QByteArray bytesOf(const std::vector<T> &numbers)
{
    return {reinterpret_cast<const char *>(numbers.data()), qsizetype(numbers.size() * sizeof(T))};
}

std::vector<float> exponentials()
{
    std::vector<float> y(values);
    Random(77, 0).exponentials(y);
    return y;
}

/// Reverberation that falls by 20 dB, as int16 magnitudes.
std::vector<std::int16_t> magnitudes()
{
    std::vector<std::int16_t> result;
    const std::vector<float> y = exponentials();
    for (std::size_t i = 0; i < y.size(); ++i) {
        const double mean = std::pow(10.0, 6.0 - 2.0 * double(i / beams % ranges) / double(ranges));
        result.push_back(std::int16_t(std::lround(std::sqrt(mean * double(y[i])))));
    }
    return result;
}

} // namespace

/// Stacks of recorded pings: their numbers, what is said or guessed of them, and that normalised ones stay as they are.
class tst_openFramesOfPings : public QObject
{
    Q_OBJECT

private slots:
    void init() { m_folder = std::make_unique<QTemporaryDir>(); }

    void typesOfNumbers()
    {
        checkType<std::int8_t>("|i1", "int8");
        checkType<std::uint8_t>("|u1", "uint8");
        checkType<std::int16_t>("<i2", "int16");
        checkType<std::uint16_t>("<u2", "uint16");
        checkType<std::int32_t>("<i4", "int32");
        checkType<std::uint32_t>("<u4", "uint32");
        checkType<float>("<f4", "float32");
        checkType<double>("<f8", "float64");
        std::vector<float> parts(48);
        for (std::size_t i = 0; i < parts.size(); ++i)
            parts[i] = float(i);
        const auto raw = openRawPings(write("'<c8'", bytesOf(parts), {}, "(2, 3, 4)"), {});
        QCOMPARE(raw->info().sampleType, std::string("complex64"));
        QVERIFY(raw->info().isComplex);
        std::vector<double> read(24);
        raw->read(1, 1, read);
        QCOMPARE(read.front(), 24.0);
        QCOMPARE(read.back(), 47.0);
    }

    void pairsAreComplex()
    {
        std::vector<std::int16_t> parts(2 * values);
        std::vector<float> unit(2 * values);
        Random(5, 0).normals(unit, 700.0f);
        for (std::size_t i = 0; i < parts.size(); ++i)
            parts[i] = std::int16_t(std::lround(unit[i]));
        const std::string stack =
            write("'<i2'", bytesOf(parts), QByteArray("{") + axes + R"(, "values": "iq"})", "(40, 60, 8, 2)");
        const auto frames = openFrames(stack);
        QVERIFY(frames);
        QCOMPARE(frames->grid().axes.size(), std::size_t(2));
        QCOMPARE(frames->grid().axes[1].count, beams);
        QCOMPARE(pingAssumption(*frames), std::string("int16, I/Q; divided by its noise over range and bearing"));
        QCOMPARE(pingGuess(*frames), std::string());
        double sum = 0.0;
        for (const float y : allOf(*frames))
            sum += double(y);
        QVERIFY(std::abs(sum / double(values) - 1.0) < 0.03);
    }

    void scaleAndOffset()
    {
        const std::vector<std::uint8_t> numbers(values, 10);
        const auto raw = openRawPings(write("'|u1'", bytesOf(numbers)), {});
        QCOMPARE(raw->info().quantum, 1.0);
        writeBytes(path("a.grid.json"),
                   QByteArray("{") + axes + R"(, "values": "decibels", "scale": 0.5, "offset": -100})");
        const auto scaled = openRawPings(path("a.npy"), path("a.grid.json"));
        QCOMPARE(scaled->info().quantum, 0.5);
        QVERIFY(scaled->info().stated == PingValues::Decibels);
        std::vector<double> read(std::size_t(ranges * beams));
        scaled->read(3, 1, read);
        QCOMPARE(read.front(), -95.0);
    }

    void normalisedStacksStayAsTheyAre()
    {
        const std::vector<float> y = exponentials();
        for (const QByteArray &more : {QByteArray("}"), QByteArray(R"(, "values": "normalised"})")}) {
            const std::string stack = write("'<f4'", bytesOf(y), QByteArray("{") + axes + more);
            QVERIFY(!openPings(stack, path("a.grid.json")));
            QVERIFY(allOf(*openFrames(stack)) == y);
        }
        QVERIFY(allOf(*openFrames(write("'<f4'", bytesOf(y)))) == y);
        // Spectrograms and other files are none of its business.
        QVERIFY(!openPings(write("'<f4'", bytesOf(y), {}, "(40, 480)"), {}));
        writeBytes(path("a.wav"), "RIFF");
        QVERIFY(!openRawPings(path("a.wav"), {}));
    }

    void whatIsStatedIsTaken()
    {
        const QByteArray bytes = bytesOf(magnitudes());
        const auto stated = openFrames(write("'<i2'", bytes, QByteArray("{") + axes + R"(, "values": "magnitude"})"));
        QCOMPARE(pingAssumption(*stated), std::string("int16, magnitude; divided by its noise over range and bearing"));
        QCOMPARE(pingGuess(*stated), std::string());
        QCOMPARE(stated->time().step, 20.0);
        FramesOptions options;
        options.pings.values = PingValues::Magnitude;
        QVERIFY(allOf(*openFrames(write("'<i2'", bytes), options)) == allOf(*stated));
        options.pings.values = PingValues::Power; // the setting comes first
        const auto other =
            openFrames(write("'<i2'", bytes, QByteArray("{") + axes + R"(, "values": "magnitude"})"), options);
        QVERIFY(allOf(*other) != allOf(*stated));
    }

    void whatIsGuessedIsTold()
    {
        const auto frames = openFrames(write("'<i2'", bytesOf(magnitudes())));
        QCOMPARE(
            pingGuess(*frames),
            std::string("int16, taken as magnitude from its distribution; divided by its noise over range and bearing "
                        "(pings.values sets what the numbers are)"));
    }

    void aGivenStackIsNotGuessed()
    {
        std::vector<float> steep = exponentials();
        for (std::size_t i = 0; i < steep.size(); ++i)
            steep[i] *= std::pow(10.0f, -2.0f * float(i / beams % ranges) / float(ranges));
        const std::string stack = write("'<f4'", bytesOf(steep));
        QVERIFY(allOf(*openStack(stack, {})) == steep);
        QVERIFY(allOf(*openFrames(stack)) != steep);
        const auto given = openStack(write("'<f4'", bytesOf(steep), QByteArray("{") + axes + R"(, "values": "power"})"),
                                     path("a.grid.json"));
        QCOMPARE(pingAssumption(*given), std::string("float32, power; divided by its noise over range and bearing"));
    }

    void refusals_data()
    {
        QTest::addColumn<QByteArray>("type");
        QTest::addColumn<QByteArray>("grid");
        QTest::addColumn<QByteArray>("shape");
        QTest::addColumn<QByteArray>("words");
        const QByteArray own = QByteArray("{") + axes;
        QTest::newRow("big-endian") << QByteArray("'>i2'") << QByteArray() << QByteArray("(40, 60, 8)")
                                    << QByteArray("holds '>i2'; expected integers of 8, 16 or 32 bits");
        QTest::newRow("records") << QByteArray("[('a', '<i2')]") << QByteArray() << QByteArray("(40, 60, 8)")
                                 << QByteArray("holds records; expected numbers");
        QTest::newRow("truncated") << QByteArray("'<i2'") << QByteArray() << QByteArray("(41, 60, 8)")
                                   << QByteArray("is truncated: its shape requires 19680 values");
        QTest::newRow("nothing") << QByteArray("'<i2'") << QByteArray() << QByteArray("(0, 60, 8)")
                                 << QByteArray("holds no values");
        QTest::newRow("one axis") << QByteArray("'<i2'") << QByteArray() << QByteArray("(40, 480)")
                                  << QByteArray("expected float32 or float64");
        QTest::newRow("pairs of three") << QByteArray("'<i2'") << own + R"(, "values": "iq"})"
                                        << QByteArray("(40, 60, 8)")
                                        << QByteArray("\"iq\" requires frames whose last axis has two numbers");
        QTest::newRow("other values") << QByteArray("'<i2'") << own + R"(, "values": "loud"})"
                                      << QByteArray("(40, 60, 8)")
                                      << QByteArray("must be one of normalised, power, magnitude, decibels, iq");
        QTest::newRow("scale") << QByteArray("'<i2'") << own + R"(, "scale": 0})" << QByteArray("(40, 60, 8)")
                               << QByteArray("must be above 0");
        QTest::newRow("scale of nothing")
            << QByteArray("'<i2'") << own + R"(, "scale": 2})" << QByteArray("(40, 60, 8)")
            << QByteArray("require \"values\": power, magnitude, decibels or iq");
        QTest::newRow("magnitude of a spectrogram")
            << QByteArray("'<f4'") << QByteArray(R"({"axes": [{"name": "frequency"}], "values": "magnitude"})")
            << QByteArray("(20, 480)") << QByteArray("must be normalised or power for frames on one axis");
        QTest::newRow("normalised integers")
            << QByteArray("'<i2'") << own + R"(, "values": "normalised"})" << QByteArray("(40, 60, 8)")
            << QByteArray("holds int16, which cannot be taken as normalised; only .npy of float32 or float64 can");
    }

    void refusals()
    {
        QFETCH(QByteArray, type);
        QFETCH(QByteArray, grid);
        QFETCH(QByteArray, shape);
        QFETCH(QByteArray, words);
        const std::string stack = write(type, bytesOf(magnitudes()), grid, shape);
        const std::string said = errorOf([&] { openFrames(stack); });
        QVERIFY2(contains(said, words.toStdString()), said.c_str());
    }

private:
    std::string path(const char *name) const { return m_folder->filePath(name).toStdString(); }

    std::string write(const QByteArray &type, const QByteArray &bytes, const QByteArray &grid = {},
                      const QByteArray &shape = "(40, 60, 8)") const
    {
        writeBytes(path("a.npy"), header(type, shape) + bytes);
        QFile::remove(m_folder->filePath("a.grid.json"));
        if (!grid.isEmpty())
            writeBytes(path("a.grid.json"), grid);
        return path("a.npy");
    }

    /// Numbers 0, 1, 2 … 23 as T.
    template <class T>
    void checkType(const QByteArray &descriptor, const std::string &name)
    {
        std::vector<T> numbers;
        for (int i = 0; i < 24; ++i)
            numbers.push_back(T(i));
        const auto raw = openRawPings(write('\'' + descriptor + '\'', bytesOf(numbers), {}, "(2, 3, 4)"), {});
        QVERIFY(raw);
        QCOMPARE(raw->info().sampleType, name);
        QCOMPARE(raw->info().quantum, std::is_integral_v<T> ? 1.0 : 0.0);
        std::vector<double> read(12);
        raw->read(1, 1, read);
        for (int i = 0; i < 12; ++i)
            QCOMPARE(read[std::size_t(i)], double(12 + i));
    }

    std::unique_ptr<QTemporaryDir> m_folder;
};

FAINTLINE_TEST(tst_openFramesOfPings)
#include "tst_openFramesOfPings.moc"
