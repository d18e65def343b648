#include "base/Random.h"
#include "noise/NoiseNormaliser.h"
#include "noise/SurrogateRecording.h"
#include "scene/SimulatedRecording.h"
#include "signal/ArrayRecording.h"
#include "support/recordings.h"
#include "support/test.h"

using namespace faintline;
using namespace faintline::test;

namespace {

/// Noise that falls toward high frequencies and doubles its amplitude half way; silent between seconds 40 and 60.
RecordingPointer colouredNoise(bool isComplex)
{
    constexpr Index count = 40000;
    const std::size_t floats = isComplex ? 2 : 1;
    std::vector<float> values(std::size_t(count) * floats);
    Random(7, 0).normals(values, 0.05f);
    for (std::size_t i = floats; i < values.size(); ++i)
        values[i] += 0.7f * values[i - floats];
    for (std::size_t i = values.size() / 2; i < values.size(); ++i)
        values[i] *= 2.0f;
    std::fill(values.begin() + std::ptrdiff_t(4000 * floats), values.begin() + std::ptrdiff_t(6000 * floats), 0.0f);
    return std::make_shared<MemoryRecording>(std::move(values), 100.0, isComplex);
}

std::shared_ptr<const SurrogateRecording>
surrogateOf(const Spectrogram &original, std::shared_ptr<const NoiseBackground> background, std::uint64_t seed)
{
    return std::make_shared<SurrogateRecording>(original.recordingPointer(), 0, original.windowSamples(),
                                                std::move(background), seed);
}

} // namespace

/// Noise like a recording's own.
class tst_SurrogateRecording : public QObject
{
    Q_OBJECT

private slots:
    void hasTheBackgroundOfTheRecording_data()
    {
        QTest::addColumn<bool>("isComplex");
        QTest::newRow("real") << false;
        QTest::newRow("I/Q") << true;
    }

    void hasTheBackgroundOfTheRecording()
    {
        QFETCH(bool, isComplex);
        SpectrogramSettings settings;
        settings.windowSeconds = 2.0;
        const auto original = std::make_shared<Spectrogram>(colouredNoise(isComplex), settings);
        const auto background = estimateBackground(*original, {});
        const auto surrogate = std::make_shared<Spectrogram>(surrogateOf(*original, background, 1), settings);
        const auto again = estimateBackground(*surrogate, {});
        QCOMPARE(surrogate->time().count, original->time().count);
        for (const double seconds : {20.0, 100.0, 150.0, 250.0, 350.0})
            for (const double hz : {3.0, 12.0, 25.0, 40.0}) {
                const double difference = again->lnPowerAt(seconds, hz) - background->lnPowerAt(seconds, hz);
                QVERIFY2(std::abs(difference) < 0.25,
                         qPrintable(QString("%1 at %2 s, %3 Hz").arg(difference).arg(seconds).arg(hz)));
            }
        // Another seed is other noise.
        std::vector<float> a(200);
        std::vector<float> b(200);
        const Index samples = isComplex ? 100 : 200;
        surrogateOf(*original, background, 1)->read(0, 1000, samples, a);
        surrogateOf(*original, background, 2)->read(0, 1000, samples, b);
        QVERIFY(a != b);
    }

    /// The squares of a strain of 1e-22 are below the range of single precision, unless its scale is removed.
    void hasTheScaleOfTheRecording()
    {
        const auto strain = std::make_shared<std::vector<float>>(10000);
        Random(8, 0).normals(*strain, 1e-22f);
        const Spectrogram original(
            std::make_shared<ArrayRecording>("strain", std::shared_ptr<const float>(strain, strain->data()),
                                             ArrayLayout{100.0, std::ssize(*strain)}),
            {.windowSeconds = 2.0});
        const auto background = estimateBackground(original, {});
        const Spectrogram surrogate(surrogateOf(original, background, 1), original.settings());
        const auto again = estimateBackground(surrogate, {});
        QVERIFY(std::abs(again->lnPowerAt(50.0, 25.0) - background->lnPowerAt(50.0, 25.0)) < 0.25);
    }

    void isSilentWhereTheRecordingIs()
    {
        SpectrogramSettings settings;
        settings.windowSeconds = 2.0;
        const Spectrogram original(colouredNoise(false), settings);
        const auto surrogate = surrogateOf(original, estimateBackground(original, {}), 1);
        std::vector<float> values(4000);
        surrogate->read(0, 3000, 4000, values);
        for (std::size_t i = 0; i < values.size(); ++i)
            QCOMPARE(values[i] == 0.0f, i >= 1000 && i < 3000);
    }

    void doesNotDependOnHowItIsRead()
    {
        SpectrogramSettings settings;
        settings.windowSeconds = 2.0;
        const Spectrogram original(colouredNoise(true), settings);
        const auto surrogate = surrogateOf(original, estimateBackground(original, {}), 1);
        std::vector<float> whole(2 * 5000);
        surrogate->read(0, 1000, 5000, whole);
        std::vector<float> part(2 * 77);
        surrogate->read(0, 3123, 77, part);
        QVERIFY(std::equal(part.begin(), part.end(), whole.begin() + 2 * (3123 - 1000)));
    }

    void keepsTheQuantisationStep()
    {
        std::vector<float> values(20000);
        Random random(9, 0);
        for (float &value : values)
            value = float(std::round(1.5 * random.normal()) / 32768.0);
        SpectrogramSettings settings;
        settings.windowSeconds = 2.0;
        const auto recording = std::make_shared<MemoryRecording>(std::move(values), 100.0);
        recording->mutableInfo().sampleType = "int16";
        const Spectrogram original(recording, settings);
        const auto surrogate = surrogateOf(original, estimateBackground(original, {}), 1);
        std::vector<float> read(2000);
        surrogate->read(0, 100, 2000, read);
        for (const float value : read)
            QCOMPARE(double(value) * 32768.0, std::round(double(value) * 32768.0));
        QVERIFY(std::any_of(read.begin(), read.end(), [](float value) { return value != 0.0f; }));
    }
};

FAINTLINE_TEST(tst_SurrogateRecording)
#include "tst_SurrogateRecording.moc"
