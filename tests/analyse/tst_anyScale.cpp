#include "analyse/analyse.h"
#include "evaluate/experiments/scaledInjection.h"
#include "inspect/advice.h"
#include "scene/InjectedRecording.h"
#include "scene/SimulatedRecording.h"
#include "signal/openRecording.h"
#include "support/recordings.h"
#include "support/test.h"

#include <cmath>
#include <limits>

using namespace faintline;
using namespace faintline::test;

namespace {

constexpr double rate = 400.0;

/// A minute with one clear line from 15 s on.
const std::vector<float> &samples()
{
    static const std::vector<float> all = [] {
        LineScene scene;
        scene.sampleRateHz = rate;
        scene.durationSeconds = 60.0;
        scene.noise.deviation = 1.0;
        LineSettings line;
        line.snrDb = 5.0;
        line.startSeconds = 15.0;
        line.frequencyHz = 90.0;
        scene.lines.push_back(line);
        std::vector<float> values(std::size_t(rate * scene.durationSeconds));
        SimulatedRecording(scene).read(0, 0, std::ssize(values), values);
        return values;
    }();
    return all;
}

AnalysisSettings scaledSettings()
{
    AnalysisSettings s = preset("billon").settings;
    s.spectrogram.windowSeconds = 0.25;
    return s;
}

template <class Number>
QByteArray bytesOf(const std::vector<float> &values, double scale)
{
    QByteArray bytes;
    for (const float value : values) {
        const auto number = static_cast<Number>(double(value) * scale);
        bytes.append(reinterpret_cast<const char *>(&number), sizeof number);
    }
    return bytes;
}

struct Found {
    std::vector<Index> frames;
    std::vector<Index> cells;
    std::vector<double> peaks;
    bool operator==(const Found &) const = default;
};

Found found(const Analysis &analysis)
{
    Found result;
    for (const Track &track : analysis.tracks) {
        result.peaks.push_back(track.peakStatistic);
        for (const TrackPoint &point : track.points) {
            result.frames.push_back(point.frame);
            result.cells.push_back(point.cell);
        }
    }
    return result;
}

} // namespace

/// The unit that samples are written in changes nothing; a recording of which nothing can be used says so.
class tst_anyScale : public QObject
{
    Q_OBJECT

private slots:
    void sameTracksWhateverTheUnit_data()
    {
        QTest::addColumn<QString>("type");
        QTest::addColumn<double>("scale");
        for (const char *type : {"rf32_le", "rf64_le", "sigmf"})
            for (const double scale : {1e-22, 1e-19, 1e-18, 1e-10, 1e9, 1e15})
                QTest::addRow("%s, %g", type, scale) << QString::fromLatin1(type) << scale;
        QTest::newRow("the least floats") << QStringLiteral("rf32_le") << 1e-34;
        QTest::newRow("a power of two") << QStringLiteral("rf32_le") << std::ldexp(1.0, -60);
    }

    void sameTracksWhateverTheUnit()
    {
        QFETCH(QString, type);
        QFETCH(double, scale);
        const Found ordinary = found(*analyse(open(QStringLiteral("rf32_le"), 1.0), scaledSettings()));
        QVERIFY(ordinary.peaks.size() == 1 && ordinary.frames.size() > 200);
        const Found scaled = found(*analyse(open(type, scale), scaledSettings()));
        QCOMPARE(scaled.frames, ordinary.frames);
        QCOMPARE(scaled.cells, ordinary.cells);
        QVERIFY2(std::abs(scaled.peaks[0] - ordinary.peaks[0]) < 1e-3 * ordinary.peaks[0],
                 qPrintable(QString::number(scaled.peaks[0])));
        if (scale == std::ldexp(1.0, -60))
            QVERIFY(scaled == ordinary); // to the bit
    }

    void aPartOfIt()
    {
        AnalysisSettings part = scaledSettings();
        part.selection.fromSeconds = 20.0;
        part.selection.toSeconds = 50.0;
        part.selection.lowHz = 60.0;
        part.selection.highHz = 120.0;
        const Found ordinary = found(*analyse(open(QStringLiteral("rf32_le"), 1.0), part));
        const Found scaled = found(*analyse(open(QStringLiteral("rf64_le"), 1e-21), part));
        QVERIFY(!ordinary.frames.empty());
        QCOMPARE(scaled.frames, ordinary.frames);
        QCOMPARE(scaled.cells, ordinary.cells);
    }

    void injectedLines()
    {
        LineSettings line;
        line.snrDb = 8.0;
        line.startSeconds = 10.0;
        line.durationSeconds = 40.0;
        line.frequencyHz = 150.0;
        line.referenceSeconds = 0.25;
        double amplitude = 0.0;
        Found ordinary;
        for (const double scale : {1.0, 1e-21, 1e14}) {
            const RecordingPointer base = open(QStringLiteral("rf32_le"), scale);
            const InjectedLine injected = scaledInjection(line, base, scaledSettings(), {});
            const auto made = std::make_shared<InjectedRecording>(base, std::vector{injected}, 0, 7);
            const Found now = found(*analyse(made, scaledSettings()));
            if (scale == 1.0) {
                amplitude = injected.amplitude;
                ordinary = now;
                QCOMPARE(now.peaks.size(), std::size_t(2));
            }
            QVERIFY(std::abs(injected.amplitude / (amplitude * scale) - 1.0) < 1e-4); // in the samples' own unit
            QCOMPARE(now.frames, ordinary.frames);
            QCOMPARE(now.cells, ordinary.cells);
        }
    }

    void simulatedNoiseOfAnyDeviation()
    {
        LineScene scene;
        scene.sampleRateHz = rate;
        scene.durationSeconds = 20.0;
        std::vector<Index> frames;
        for (const double deviation : {1.0, 1e-12, 1e6}) {
            scene.noise.deviation = deviation;
            scene.lines = {LineSettings{8.0, 0.25, 5.0, 0.0, 100.0}};
            const Found now = found(*analyse(std::make_shared<SimulatedRecording>(scene), scaledSettings()));
            QVERIFY(!now.frames.empty());
            if (frames.empty())
                frames = now.frames;
            QCOMPARE(now.frames, frames);
        }
    }

    void exponents()
    {
        QCOMPARE(open(QStringLiteral("rf32_le"), 1.0)->scaleExponent(0), 0);
        QCOMPARE(open(QStringLiteral("rf32_le"), 1e-8)->scaleExponent(0), 0);
        QCOMPARE(open(QStringLiteral("rf32_le"), 1e8)->scaleExponent(0), 0);
        QCOMPARE(open(QStringLiteral("rf32_le"), 1e-18)->scaleExponent(0), -60);
        QCOMPARE(open(QStringLiteral("rf32_le"), 1e15)->scaleExponent(0), 60);
        // Silence and what is no number do not count, however much of it there is.
        std::vector<float> sparse(400'000, 0.0f);
        for (std::size_t i = 0; i < sparse.size(); i += 2)
            sparse[i] = i < 200'000 ? std::numeric_limits<float>::quiet_NaN() : 0.0f;
        sparse[123'457] = 1e-20f;
        QCOMPARE(openBytes(bytesOf<float>(sparse, 1.0), "rf32_le")->scaleExponent(0), -60);
    }

    void nothingThatCouldBeUsed_data()
    {
        QTest::addColumn<QString>("type");
        QTest::addColumn<double>("value");
        QTest::addColumn<double>("other");
        QTest::addColumn<QString>("message");
        const auto row = [](const char *name, const char *type, double value, double other, const char *message) {
            QTest::newRow(name) << QString::fromLatin1(type) << value << other << QString::fromUtf8(message);
        };
        constexpr double nan = std::numeric_limits<double>::quiet_NaN();
        row("no numbers", "rf32_le", nan, nan, "all of the 4000 samples read are not finite in single precision");
        row("too large", "rf64_le", 1e60, -1e60, "all of the 4000 samples read are not finite in single precision");
        row("of each", "rf32_le", nan, 0.0, "all of the 4000 samples read are 0 or not finite");
    }

    void nothingThatCouldBeUsed()
    {
        QFETCH(QString, type);
        QFETCH(double, value);
        QFETCH(double, other);
        QFETCH(QString, message);
        QByteArray bytes;
        for (int i = 0; i < 4000; ++i) {
            const double number = i % 2 ? value : other;
            const auto narrow = float(number);
            bytes.append(type == QLatin1String("rf64_le")
                             ? QByteArray(reinterpret_cast<const char *>(&number), sizeof number)
                             : QByteArray(reinterpret_cast<const char *>(&narrow), sizeof narrow));
        }
        const RecordingPointer recording = openBytes(bytes, type.toStdString());
        const std::string said = errorOf([&] { analyse(recording, scaledSettings()); });
        QVERIFY2(contains(said, "has no usable samples: " + message.toStdString()), said.c_str());
    }

    /// A recorder without its microphone: nothing is wrong, and nothing is there.
    void silenceIsValid_data()
    {
        QTest::addColumn<QString>("type");
        QTest::addColumn<QByteArray>("bytes");
        QTest::newRow("zeros") << "rf32_le" << QByteArray(16000, '\0');
        QTest::newRow("integers") << "ri16_le" << QByteArray(8000, '\0');
        QByteArray small;
        for (int i = 0; i < 4000; ++i) {
            const double number = i % 2 ? 1e-60 : -1e-200;
            small.append(reinterpret_cast<const char *>(&number), sizeof number);
        }
        QTest::newRow("too small") << "rf64_le" << small;
    }

    void silenceIsValid()
    {
        QFETCH(QString, type);
        QFETCH(QByteArray, bytes);
        const auto analysis = analyse(openBytes(bytes, type.toStdString()), scaledSettings());
        QVERIFY(analysis->tracks.empty());
        const std::vector<Advice> advice = advise(*analysis);
        QCOMPARE(advice.size(), std::size_t(1));
        QVERIFY2(advice[0].sentence.starts_with("the recording is silent: all of the 4000 samples read are 0 or below"),
                 advice[0].sentence.c_str());
    }

    void oneSoundSampleIsUsed()
    {
        std::vector<float> values(4000, 0.0f);
        values[3500] = 1e-3f;
        QCOMPARE(errorOf([&] { analyse(openBytes(bytesOf<float>(values, 1.0), "rf32_le"), scaledSettings()); }),
                 std::string());
    }

private:
    RecordingPointer openBytes(const QByteArray &bytes, const std::string &type)
    {
        const std::string path = m_folder.filePath(QStringLiteral("%1.raw").arg(++m_number)).toStdString();
        writeBytes(path, bytes);
        OpenOptions options;
        options.rawType = type;
        options.rawRateHz = rate;
        return openRecording(path, options);
    }

    RecordingPointer open(const QString &type, double scale)
    {
        if (type != QLatin1String("sigmf"))
            return openBytes(type == QLatin1String("rf64_le") ? bytesOf<double>(samples(), scale)
                                                              : bytesOf<float>(samples(), scale),
                             type.toStdString());
        const std::string stem = m_folder.filePath(QStringLiteral("%1").arg(++m_number)).toStdString();
        writeBytes(stem + ".sigmf-meta",
                   R"({"global": {"core:datatype": "rf64_le", "core:sample_rate": 400, "core:version": "1.0.0"},
                                             "captures": [{"core:sample_start": 0}], "annotations": []})");
        writeBytes(stem + ".sigmf-data", bytesOf<double>(samples(), scale));
        return openRecording(stem + ".sigmf-meta");
    }

    QTemporaryDir m_folder;
    int m_number = 0;
};

FAINTLINE_TEST(tst_anyScale)
#include "tst_anyScale.moc"
