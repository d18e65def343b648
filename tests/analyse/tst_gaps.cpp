#include "analyse/analyse.h"
#include "analyse/events.h"
#include "base/Random.h"
#include "inspect/noiseLaw.h"
#include "noise/CausalSpectrogram.h"
#include "scene/InjectedRecording.h"
#include "support/recordings.h"
#include "support/test.h"

#include <cmath>
#include <numbers>

using namespace faintline;
using namespace faintline::test;

/// What was not heard is not taken for silence: frames that reach into a gap are not observed, and a line goes on
/// behind.
class tst_gaps : public QObject
{
    Q_OBJECT

private slots:
    void framesAreNotObserved();
    void noiseBesideAGap();
    void linesGoOn();
    void aLineThatEndsAtAGapEndsThere();
    void noiseLawLooksBeside();
    void injectedLinesStayOutside();
};

namespace {

constexpr double rate = 1000.0;
constexpr Index gapBegin = 100'250;
constexpr Index gapEnd = 140'600;

/// Noise with a faint drifting line up to a sample; its gap reads as 0, and tells so unless it is hidden.
RecordingPointer holed(double amplitude, bool isHidden = false, std::size_t lineEnd = 240'000)
{
    std::vector<float> samples(240'000);
    Random(5, 0).normals(samples, 1.0f);
    for (std::size_t n = 0; n < lineEnd; ++n) {
        const double t = double(n) / rate;
        samples[n] += float(amplitude * std::cos(2.0 * std::numbers::pi * (180.0 * t + 0.5 * 0.1 * t * t)));
    }
    const auto recording = std::make_shared<MemoryRecording>(std::move(samples), rate);
    recording->leaveOut(gapBegin, gapEnd - gapBegin, isHidden);
    return recording;
}

AnalysisSettings twoSeconds()
{
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = 2.0;
    return settings;
}

std::shared_ptr<const Analysis> analysed(const RecordingPointer &recording)
{
    return analyse(recording, twoSeconds());
}

} // namespace

void tst_gaps::framesAreNotObserved()
{
    const auto spectrogram = std::make_shared<const Spectrogram>(holed(0.0), twoSeconds().spectrogram);
    const NormalisedFramesPointer frames = normalise(spectrogram, {});
    const auto cells = std::size_t(frames->grid().size());
    std::vector<float> power(cells);
    std::vector<float> y(cells);
    for (Index frame = 0; frame < frames->time().count; ++frame) {
        const bool isTorn = frame * 1000 < gapEnd && frame * 1000 + 2000 > gapBegin;
        QCOMPARE(spectrogram->isObserved(frame), !isTorn);
        spectrogram->read(frame, 1, power);
        frames->read(frame, 1, y);
        QCOMPARE(std::all_of(power.begin(), power.end(), [](float value) { return value == 0.0f; }), isTorn);
        QCOMPARE(std::count_if(y.begin(), y.end(), [](float value) { return std::isnan(value); }),
                 isTorn ? Index(cells) : 0);
    }
}

// The noise up to the gap and behind it has a mean of 1: the gap is no part of the background.
void tst_gaps::noiseBesideAGap()
{
    const auto spectrogram = std::make_shared<const Spectrogram>(holed(0.0), twoSeconds().spectrogram);
    const NormalisedFramesPointer frames = normalise(spectrogram, {});
    std::vector<float> y(std::size_t(frames->grid().size()));
    for (const Index from : {Index(80), Index(141)}) {
        double sum = 0.0;
        double count = 0.0;
        for (Index frame = from; frame < from + 18; ++frame) {
            frames->read(frame, 1, y);
            for (std::size_t cell = 10; cell + 10 < y.size(); ++cell, count += 1.0)
                sum += double(y[cell]);
        }
        QVERIFY2(std::abs(sum / count - 1.0) < 0.03, qPrintable(QString::number(sum / count)));
    }
}

// One event from end to end, which tells nothing of the gap; where the gap is hidden the same line breaks in two.
void tst_gaps::linesGoOn()
{
    const auto analysis = analysed(holed(0.15));
    const std::vector<Event> found = events(*analysis);
    QCOMPARE(found.size(), std::size_t(1));
    const double middle = 0.5 * (found[0].onsetSeconds + found[0].endSeconds);
    QVERIFY2(std::abs(found[0].position.back() - (180.0 + 0.1 * middle)) < 0.03,
             QByteArray::number(found[0].position.back() - (180.0 + 0.1 * middle)));
    const Track &track = analysis->tracks.front();
    for (const std::size_t i : track.presentPoints())
        QVERIFY(analysis->frames->spectrogram()->isObserved(track.points[i].frame));
    QVERIFY(found[0].onsetSeconds < 10.0 && found[0].endSeconds > 230.0);
    QVERIFY(std::abs(found[0].driftPerSecond - 0.1) < 0.005);
    QVERIFY(events(*analysed(holed(0.15, true))).size() >= 2);
}

void tst_gaps::aLineThatEndsAtAGapEndsThere()
{
    const std::vector<Event> found = events(*analysed(holed(0.15, false, gapBegin)));
    QCOMPARE(found.size(), std::size_t(1));
    QVERIFY2(found[0].endSeconds > 95.0 && found[0].endSeconds <= double(gapBegin) / rate,
             QByteArray::number(found[0].endSeconds));
}

void tst_gaps::noiseLawLooksBeside()
{
    const auto law = checkNoiseLaw(*analysed(holed(0.0)));
    QVERIFY(law.has_value());
    QVERIFY2(law->isFollowed(), law->warning().c_str());
}

void tst_gaps::injectedLinesStayOutside()
{
    InjectedLine line;
    line.line.frequencyHz = 300.0;
    line.amplitude = 1.0;
    const InjectedRecording injected(holed(0.0), {line}, 0, 1);
    QVERIFY(injected.isWhole(0, gapBegin) && !injected.isWhole(gapBegin, 1) && injected.isWhole(gapEnd, 100));
}

FAINTLINE_TEST(tst_gaps)
#include "tst_gaps.moc"
