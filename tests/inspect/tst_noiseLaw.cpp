#include "analyse/analyse.h"
#include "inspect/noiseLaw.h"
#include "scene/SimulatedRecording.h"
#include "signal/ArrayRecording.h"
#include "support/test.h"

using namespace faintline;

namespace {

RecordingPointer noiseOf(int seed, double seconds, std::vector<LineSettings> lines = {})
{
    LineScene scene{.sampleRateHz = 400.0, .durationSeconds = seconds};
    scene.noise.deviation = 1.0;
    scene.seed = seed;
    scene.lines = std::move(lines);
    return std::make_shared<SimulatedRecording>(scene);
}

AnalysisSettings shortWindows()
{
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = 0.25;
    return settings;
}

/// The same frames, louder by a factor that the background does not know of.
class Louder final : public NormalisedFrames
{
public:
    Louder(NormalisedFramesPointer frames, float factor)
        : NormalisedFrames(frames->time(), frames->grid()), m_frames(std::move(frames)), m_factor(factor)
    {
    }
    void read(Index first, Index count, std::span<float> out) const override
    {
        m_frames->read(first, count, out);
        for (float &value : out)
            value *= m_factor;
    }

private:
    NormalisedFramesPointer m_frames;
    float m_factor;
};

} // namespace

/// The fraction of paths that go on outside tracks, on noise that follows its law and on noise that does not.
class tst_noiseLaw : public QObject
{
    Q_OBJECT

private slots:
    void whiteNoiseNeverWarns()
    {
        for (int seed = 1; seed <= 100; ++seed) {
            const auto law = checkNoiseLaw(*analyse(noiseOf(seed, 30.0), shortWindows()));
            QVERIFY(law);
            QVERIFY2(law->isFollowed(),
                     qPrintable(QString("seed %1: %2").arg(seed).arg(QString::fromStdString(law->warning()))));
        }
    }

    void aStrongLineIsNoNoise()
    {
        LineSettings line{.snrDb = 30.0, .frequencyHz = 80.0};
        const auto analysis = analyse(noiseOf(7, 120.0, {line}), shortWindows());
        QVERIFY(!analysis->tracks.empty());
        const auto law = checkNoiseLaw(*analysis);
        QVERIFY(law);
        QVERIFY2(law->isFollowed(), law->warning().c_str());
    }

    // As in a lesson: of eight lines of 3 dB, a threshold of 60 nat misses some.
    void missedLinesDoNotWarn()
    {
        AnalysisSettings settings = preset("billon").settings;
        settings.spectrogram.windowSeconds = 0.5;
        settings.decide.by = DecideSettings::By::Nats;
        settings.decide.thresholdNats = 60.0;
        std::vector<LineSettings> lines;
        for (int i = 0; i < 8; ++i) {
            LineSettings line{.snrDb = 3.0,
                              .referenceSeconds = 0.5,
                              .startSeconds = 10.0 + 35.0 * i,
                              .durationSeconds = 30.0,
                              .frequencyHz = 30.0 + 20.0 * i};
            lines.push_back(line);
        }
        const auto analysis = analyse(noiseOf(11, 300.0, lines), settings);
        QVERIFY(analysis->tracks.size() < lines.size());
        const auto law = checkNoiseLaw(*analysis);
        QVERIFY(law);
        QVERIFY2(law->isFollowed(), law->warning().c_str());
    }

    // A twentieth more power than the background says: three times as many false alarms and more.
    void wrongLevelsWarn()
    {
        auto analysis = *analyse(noiseOf(8, 300.0), shortWindows());
        for (const float factor : {1.06f, 0.94f}) {
            Analysis other = analysis;
            other.frames = std::make_shared<Louder>(analysis.frames, factor);
            const auto law = checkNoiseLaw(other);
            QVERIFY(law && !law->isFollowed());
            QVERIFY2(QString::fromStdString(law->warning())
                         .contains(factor > 1.0f ? "expect more false alarms" : "expect fewer"),
                     law->warning().c_str());
        }
    }

    // A recorder without its microphone makes no noise that could follow a law.
    void silenceDoesNotWarn()
    {
        const auto samples = std::make_shared<std::vector<float>>(24000, 0.0f);
        const RecordingPointer silent =
            std::make_shared<ArrayRecording>("silence", std::shared_ptr<const float>(samples, samples->data()),
                                             ArrayLayout{400.0, 24000, 1, false, 0.0});
        QVERIFY(!checkNoiseLaw(*analyse(silent, shortWindows())));
    }

    void whatHasNoLaw()
    {
        AnalysisSettings settings;
        setSetting(settings, "detector.kind", "energy");
        QVERIFY(!checkNoiseLaw(*analyse(noiseOf(9, 40.0), settings)));
        QVERIFY(!checkNoiseLaw(*analyse(noiseOf(9, 2.0), {})));
    }
};

FAINTLINE_TEST(tst_noiseLaw)
#include "tst_noiseLaw.moc"
