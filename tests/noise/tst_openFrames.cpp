#include "noise/openFrames.h"
#include "support/test.h"

#include "signal/formats/NumPy.h"
#include "support/recordings.h"

#include <cmath>

using namespace faintline;
using namespace faintline::test;

namespace {

constexpr Index fileFrames = 60;
constexpr Index fileCells = 40;

std::vector<float> someValues()
{
    std::vector<float> values(std::size_t(fileFrames * fileCells));
    Random(131, 0).exponentials(values);
    return values;
}

const char *const powerGrid = R"({"values": "power", "time": {"first": 1, "step": 0.5},
    "axes": [{"name": "frequency", "unit": "Hz", "first": 100, "step": 2}]})";

/// A float64 array put together by hand.
QByteArray doubles(const std::vector<float> &values)
{
    QByteArray header = "{'descr': '<f8', 'fortran_order': False, 'shape': (60, 40), }";
    header = header.leftJustified(128 - 10 - 1, ' ') + '\n';
    QByteArray bytes = QByteArray("\x93NUMPY\x01\x00", 8) + char(header.size()) + '\0' + header;
    for (const float value : values) {
        const double wide = double(value) + 1e-12;
        bytes.append(reinterpret_cast<const char *>(&wide), sizeof wide);
    }
    return bytes;
}

} // namespace

/// Which files hold frames already, of what kind they are, and that parts of a NumPy spectrogram are its values.
class tst_openFrames : public QObject
{
    Q_OBJECT

private slots:
    void init() { m_folder = std::make_unique<QTemporaryDir>(); }

    void kindsOfFiles()
    {
        writeBytes(path("a.fil"), QByteArray("\x0c\x00\x00\x00HEADER_START", 16));
        writeBytes(path("named.wav"), QByteArray("\x0c\x00\x00\x00HEADER_START", 16));
        writeBytes(path("b.fil"), "RIFF");
        QVERIFY(holdsFrames(path("a.fil")) && holdsFrames(path("named.wav"))); // by content
        QVERIFY(!holdsFrames(path("b.fil")) && !holdsFrames(path("nowhere.fil")) && !holdsFrames(path(".")));
        QVERIFY(holdsFrames(path("nowhere.npy")) && holdsFrames(path("nowhere.NPY"))); // by name
        QVERIFY(!holdsFrames("npy") && !holdsFrames(""));
        QVERIFY(!openPower(path("b.fil")) && !openPower(path("nowhere.fil")) && !openFrames(path("b.fil")));
    }

    void gridsLieBesideTheirStack()
    {
        QCOMPARE(gridPathOf("folder/a.npy"), std::string("folder/a.grid.json"));
        QCOMPARE(gridPathOf("a.b.NPY"), std::string("a.b.grid.json"));
    }

    void axesOfASpectrogram()
    {
        const auto power = openPower(makeStack(powerGrid));
        QVERIFY(power);
        const PowerInfo &info = power->info();
        QCOMPARE(info.container, std::string("NumPy spectrogram"));
        QCOMPARE(info.sampleType, std::string("float32"));
        QCOMPARE(info.time.first, 1.0);
        QCOMPARE(info.time.step, 0.5);
        QCOMPARE(info.time.count, fileFrames);
        QCOMPARE(info.frequency.first, 100.0);
        QCOMPARE(info.frequency.step, 2.0);
        QCOMPARE(info.frequency.count, fileCells);
        QCOMPARE(info.channelCount, 1);
        QCOMPARE(openPower(makeStack(powerGrid, true))->info().sampleType, std::string("float64"));
    }

    void partsAreTheFilesValues_data()
    {
        QTest::addColumn<bool>("isDouble");
        QTest::newRow("float32") << false;
        QTest::newRow("float64") << true;
    }

    void partsAreTheFilesValues()
    {
        QFETCH(bool, isDouble);
        const auto power = openPower(makeStack(powerGrid, isDouble));
        const std::vector<float> whole = someValues();
        for (const PowerPart &part :
             {PowerPart{0, 0, fileFrames, 0, fileCells}, PowerPart{0, 7, 1, 39, 1}, PowerPart{0, 59, 1, 0, fileCells},
              PowerPart{0, 3, 20, 5, 11}, PowerPart{0, 3, 0, 5, 0}}) {
            std::vector<float> found(std::size_t(part.frames * part.cells));
            power->read(part, found);
            for (Index frame = 0; frame < part.frames; ++frame)
                for (Index cell = 0; cell < part.cells; ++cell)
                    QCOMPARE(found[std::size_t(frame * part.cells + cell)],
                             whole[std::size_t((part.firstFrame + frame) * fileCells + part.firstCell + cell)]);
        }
    }

    void aStackWithoutPowerIsNormalisedAlready()
    {
        const std::string stack = makeStack({});
        QVERIFY(!openPower(stack));
        const auto made = openFrames(stack);
        QVERIFY(made);
        std::vector<float> y(std::size_t(fileFrames * fileCells));
        made->read(0, fileFrames, y);
        QVERIFY(y == someValues());
    }

    void powerIsNormalisedInItsSelection()
    {
        FramesOptions options;
        options.selection.fromSeconds = 5.0;
        options.selection.toSeconds = 20.0;
        options.selection.lowHz = 110.0;
        options.selection.highHz = 150.0;
        options.noise.halfWidthCells = 4;
        const auto made = openFrames(makeStack(powerGrid), options);
        QVERIFY(made);
        QCOMPARE(made->time().first, 5.0);
        QCOMPARE(made->time().count, Index(31));
        QCOMPARE(made->grid().axes.front().first, 110.0);
        QCOMPARE(made->grid().axes.front().count, Index(21));
        std::vector<float> y(std::size_t(31 * 21));
        made->read(0, 31, y);
        QVERIFY(std::all_of(y.begin(), y.end(), [](float value) { return std::isfinite(value) && value >= 0.0f; }));
    }

    void refusals()
    {
        QVERIFY(contains(errorOf([&] { openFrames(path("nowhere.npy")); }), path("nowhere.npy")));
        // A grid that is damaged is no power, and told of when the stack is read.
        const std::string stack = makeStack("{");
        QVERIFY(!NumPyPower::recognises(stack, path("a.grid.json")));
        QVERIFY(contains(errorOf([&] { openFrames(stack); }), "a.grid.json"));
        writeBytes(path("a.grid.json"), R"({"values": "power", "axes": []})");
        QVERIFY(contains(errorOf([&] { openFrames(stack); }), "a.grid.json"));
        NumPyWriter writer(path("cube.npy"), {2, 3, 4});
        writer.write(std::vector<float>(24, 1.0f));
        writer.finish();
        writeBytes(path("cube.grid.json"),
                   R"({"values": "power", "time": {"first": 0, "step": 1},
                       "axes": [{"name": "range", "unit": "m", "first": 0, "step": 1},
                                {"name": "bearing", "unit": "°", "first": 0, "step": 1}]})");
        QVERIFY(!openPower(path("cube.npy"))); // pings, with axes of their own
        QCOMPARE(openFrames(path("cube.npy"))->grid().axes.size(), std::size_t(2));
    }

    void aFileThatShrinks()
    {
        const std::string stack = makeStack(powerGrid);
        const auto power = openPower(stack);
        QVERIFY(QFile::resize(QString::fromStdString(stack), QFile(QString::fromStdString(stack)).size() - 4));
        std::vector<float> row(std::size_t(fileCells), 0.0f);
        power->read({0, fileFrames - 2, 1, 0, fileCells}, row);
        QCOMPARE(errorOf([&] {
                     power->read({0, fileFrames - 1, 1, 0, fileCells}, row);
                 }),
                 stack + ": was truncated while open");
    }

private:
    std::string path(const char *name) const { return m_folder->filePath(name).toStdString(); }

    /// a.npy, with a grid file unless that is empty.
    std::string makeStack(const QByteArray &grid, bool isDouble = false) const
    {
        if (isDouble) {
            writeBytes(path("a.npy"), doubles(someValues()));
        } else {
            NumPyWriter writer(path("a.npy"), {fileFrames, fileCells});
            writer.write(someValues());
            writer.finish();
        }
        if (!grid.isEmpty())
            writeBytes(path("a.grid.json"), grid);
        return path("a.npy");
    }

    std::unique_ptr<QTemporaryDir> m_folder;
};

FAINTLINE_TEST(tst_openFrames)
#include "tst_openFrames.moc"
