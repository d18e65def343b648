#include "live/LiveHistory.h"
#include "support/test.h"

#include "analyse/analyse.h"
#include "exchange/writeEvents.h"
#include "inspect/closeup.h"
#include "scene/SimulatedRecording.h"
#include "signal/Timeline.h"
#include "signal/formats/SigmfRecording.h"
#include "support/recordings.h"

#include <set>
#include <thread>

using namespace faintline;
using namespace faintline::test;

namespace {

constexpr double liveRate = 1000.0;

StreamFormat format()
{
    return {parseSampleType("rf32_le", "test"), liveRate, 1, 0.0, "test"};
}

/// Samples in memory, a tenth of a second at a time; half a second is lost at one place, if any.
class GivenSource final : public SampleSource
{
public:
    explicit GivenSource(std::vector<float> samples, double lossSeconds = -1.0)
        : m_samples(std::move(samples)), m_lossAt(Index(lossSeconds * liveRate))
    {
    }
    const StreamFormat &format() const override { return m_format; }
    bool isPatient() const override { return true; }
    Heard hear(std::chrono::milliseconds) override
    {
        const std::size_t count = std::min<std::size_t>(100, m_samples.size() - m_next);
        const auto bytes = std::as_bytes(std::span(m_samples).subspan(m_next, count));
        Heard heard;
        if (Index(m_next) == m_lossAt)
            heard.lostSamples = 500;
        m_next += count;
        heard.bytes.assign(bytes.begin(), bytes.end());
        heard.isOver = m_next == m_samples.size();
        return heard;
    }

private:
    StreamFormat m_format = ::format();
    std::vector<float> m_samples;
    Index m_lossAt;
    std::size_t m_next = 0;
};

/// Two lines that stay: one strong, one that stands little above the threshold.
std::vector<float> scene(double seconds)
{
    LineScene lines{.sampleRateHz = liveRate, .durationSeconds = seconds};
    lines.noise.deviation = 0.1;
    for (const auto &[hz, snrDb] : {std::pair(120.0, 8.0), std::pair(310.0, 3.0)}) {
        LineSettings line{.snrDb = snrDb, .startSeconds = 20.0, .frequencyHz = hz};
        lines.lines.push_back(line);
    }
    return readAll(SimulatedRecording(lines));
}

ListenSettings settings(const std::string &record = {})
{
    ListenSettings result;
    result.analysis.spectrogram.windowSeconds = 0.25;
    result.analysis.decide.falseAlarmsPerHour = 60.0;
    result.recordPath = record;
    return result;
}

struct Run {
    LiveHistory history;
    ListenResult result;
    std::vector<std::string> refusals;
    std::vector<EventChange> changes;
};

/// Listens, and wishes for other settings once so much of the time has passed. Until they are in force or refused,
/// whose calibration takes seconds, frames come in their own time: else the source would be over before.
std::unique_ptr<Run> run(std::vector<float> samples, const ListenSettings &used, double wishSeconds = 0.0,
                         const std::optional<AnalysisSettings> &wish = {})
{
    auto run = std::make_unique<Run>();
    GivenSource source(std::move(samples));
    double now = 0.0;
    double step = 0.0;
    bool hasWished = false;
    bool isWaiting = false;
    ListenSinks sinks;
    sinks.event = [&](const EventChange &change, const AnalysisPlan &) {
        run->history.take(change);
        run->changes.push_back(change);
    };
    sinks.plan = [&](const AnalysisPlan &plan) {
        run->history.take(plan);
        step = plan.time().step;
        isWaiting = false;
    };
    sinks.frame = [&](const ListenFrame &frame) {
        run->history.take(frame);
        now = step * double(frame.number);
        if (isWaiting)
            std::this_thread::sleep_for(std::chrono::duration<double>(10.0 * step)); // for a calibration in a sanitizer
    };
    sinks.notice = [&](const ListenNotice &notice, const StreamFormat &) {
        if (notice.kind != ListenNotice::Kind::Refused)
            return;
        run->refusals.push_back(notice.words);
        isWaiting = false;
    };
    sinks.wish = [&]() -> std::optional<AnalysisSettings> {
        if (!wish || hasWished || now < wishSeconds)
            return {};
        hasWished = isWaiting = true;
        return wish;
    };
    run->result = listen(source, used, sinks);
    return run;
}

bool haveSameRows(const PeakPyramid &a, Index from, const PeakPyramid &b, Index rows)
{
    for (Index row = 0; row < rows; ++row)
        if (!std::ranges::equal(a.row(0, from + row), b.row(0, row)))
            return false;
    return rows > 0;
}

} // namespace

/// What is shown of a live run is what a file with the same samples shows, and settings that change on the way hold
/// from a frame on.
class tst_LiveHistory : public QObject
{
    Q_OBJECT

private slots:
    // The oracle is the analysis of the file that was written: the same bytes in both pictures, and the same events.
    void showsWhatItsRecordingShows()
    {
        const std::string record = m_folder.filePath("shown.sigmf-meta").toStdString();
        const auto live = run(scene(120.0), settings(record));
        const LiveView view = live->history.view();
        const auto file =
            analyse(std::make_shared<SigmfRecording>(record), settingsForListening(settings().analysis, format()));
        QCOMPARE(view.time.count, file->time().count);
        QVERIFY(haveSameRows(*file->input, 0, *view.input, view.time.count));
        QVERIFY(haveSameRows(*file->statistic, 0, *view.statistic, view.time.count));
        QVERIFY(haveSameRows(*file->input, 0, *view.newInput, view.time.count));
        QCOMPARE(view.plan->threshold, file->threshold);
        QVERIFY(view.events->size() >= 2);
        QCOMPARE(QByteArray::fromStdString(eventsCsv(*view.plan, *view.events)),
                 QByteArray::fromStdString(eventsCsv(*file, events(*file))));
        QVERIFY(view.changes.empty());
        for (const Event &event : *view.events)
            QVERIFY(std::ranges::any_of(view.tracks, [&](const auto &track) {
                return track->id == event.id
                       && std::abs(view.time.value(double(track->points.back().frame)) - event.endSeconds)
                              <= 2.0 * view.time.step;
            }));
    }

    // Frames of 8192 cells: of the end some 2000 of them at least.
    void keepsTheNewestFramesSingle()
    {
        ListenSettings used = settings();
        used.analysis.spectrogram.windowSeconds = 8.192;
        setSetting(used.analysis, "detector.kind", "energy");
        setSetting(used.analysis, "decide.thresholdNats", "1000");
        used.analysis.noise.blockWindows = 4.0;
        const auto live = run(someNoise(17'200'000, 3), used);
        const LiveView view = live->history.view();
        const Index full = LiveHistory::singleFrames(view.input->cells());
        QCOMPARE(full, (Index(64) << 20) / (4 * view.input->cells()));
        QVERIFY(view.time.count > 2 * full);
        QVERIFY(view.newInput->frameCount() > full);
        QVERIFY(view.newInput->frameCount() <= 2 * full);
        QCOMPARE(view.newInput->framesPerRow(0), 1);
        QCOMPARE(view.input->framesPerRow(0), 1);
        const Index from = view.time.count - view.newInput->frameCount();
        QCOMPARE(view.newInput->time().first, view.time.value(double(from)));
        QVERIFY(haveSameRows(*view.input, from, *view.newInput, view.newInput->frameCount()));
    }

    // While it is being written, in several files and with a gap: the oracle is the analysis of all of it afterwards.
    void looksBackAtItsRecording()
    {
        ListenSettings used = settings(m_folder.filePath("back.sigmf-meta").toStdString());
        used.rotation.longestSeconds = 25.0;
        GivenSource source(scene(120.0), 45.0);
        LiveHistory history;
        LiveView view;
        ListenSinks sinks;
        sinks.recording = [&](const auto &written) { history.take(written); };
        sinks.plan = [&](const AnalysisPlan &plan) { history.take(plan); };
        sinks.frame = [&](const ListenFrame &frame) {
            history.take(frame);
            if (frame.number == 700)
                view = history.view();
        };
        const ListenResult live = listen(source, used, sinks);
        QCOMPARE(live.files.size(), std::size_t(5));
        QVERIFY(live.recording.ends_with("back.timeline"));

        const auto soFar = analysisSoFar(view);
        QCOMPARE(soFar->time().count, Index(701));
        QVERIFY(!view.checkpoints->isEmpty());
        const auto whole = analyse(
            std::make_shared<Timeline>(std::vector{live.recording},
                                       [](const std::string &file) { return std::make_shared<SigmfRecording>(file); }),
            settingsForListening(settings().analysis, format()));
        const FrameStretch stretch{300, 701};
        constexpr std::size_t enough = 64 << 20;
        QVERIFY(haveSameRows(*whole->input, 300, *inputCloseup(*soFar, stretch, enough), 401));
        QVERIFY(haveSameRows(*whole->statistic, 300, *statisticCloseup(*soFar, stretch, enough), 401));
        const std::vector<float> samples = scene(120.0);
        std::vector<float> heard(2000);
        HeardRecording(view.written).read(0, 50'500, 2000, heard); // 500 of them were not
        QVERIFY(std::ranges::equal(heard, std::span(samples).subspan(50'000, 2000)));
        QVERIFY(!soFar->recording->isWhole(45'000, 501) && soFar->recording->isWhole(45'500, 30'000));
    }

    // The strong line's track goes on under its number; the mark stands where the threshold changed.
    void anotherThresholdKeepsTracks()
    {
        AnalysisSettings other = settings().analysis;
        other.decide.falseAlarmsPerHour = 5.0;
        const auto live = run(scene(240.0), settings(), 60.0, other);
        const LiveView view = live->history.view();
        QCOMPARE(view.changes.size(), std::size_t(1));
        QCOMPARE(view.changes[0].fields, std::vector<std::string>{"decide.falseAlarmsPerHour"});
        QVERIFY(view.changes[0].seconds >= 60.0 && view.changes[0].seconds < 240.0);
        QCOMPARE(view.changes[0].threshold, view.plan->threshold);
        QCOMPARE(live->result.plan.settings.decide.falseAlarmsPerHour, 5.0);
        const auto strong = std::ranges::find_if(*view.events, [](const Event &event) {
            return std::abs(event.position.back() - 120.0) < 2.0 && event.detectSeconds < 60.0;
        });
        QVERIFY(strong != view.events->end());
        QVERIFY(strong->endSeconds > 235.0);
    }

    void anotherDetectorBeginsAnew()
    {
        AnalysisSettings other = settings().analysis;
        setSetting(other, "track.confirmFrames", "5");
        const auto live = run(scene(240.0), settings(), 60.0, other);
        const LiveView view = live->history.view();
        QCOMPARE(view.changes.size(), std::size_t(1));
        const double at = view.changes[0].seconds;
        QVERIFY(view.time.value(double(view.time.count)) > 235.0); // the picture goes on
        std::set<int> numbers;
        int before = 0;
        int after = 0;
        for (const Event &event : *view.events) {
            QVERIFY(numbers.insert(event.id).second);
            if (std::abs(event.position.back() - 120.0) < 2.0)
                ++(event.detectSeconds < at ? before : after);
        }
        QVERIFY(before >= 1 && after >= 1); // found again
        for (const Event &event : *view.events)
            QVERIFY(event.detectSeconds >= at || event.endSeconds <= at);
        QCOMPARE(live->result.events.size(), view.events->size());
    }

    void otherFramesBeginAnew()
    {
        AnalysisSettings other = settings().analysis;
        other.spectrogram.windowSeconds = 0.5;
        const auto live = run(scene(240.0), settings(), 60.0, other);
        const LiveView view = live->history.view();
        QCOMPARE(view.changes.size(), std::size_t(1));
        QCOMPARE(view.changes[0].fields, std::vector<std::string>{"spectrogram.windowSeconds"});
        QVERIFY(view.time.first > 60.0);
        QCOMPARE(view.changes[0].seconds, view.time.first);
        QCOMPARE(view.input->frameCount(), view.time.count);
        QVERIFY(view.time.last() > 235.0);
        std::set<int> numbers;
        for (const Event &event : *view.events)
            QVERIFY(numbers.insert(event.id).second);
        QVERIFY(std::ranges::any_of(*view.events,
                                    [&](const Event &event) { return event.detectSeconds > view.time.first; }));
    }

    void refusesWhatCannotBe()
    {
        AnalysisSettings other = settings().analysis;
        other.selection.lowHz = 400.0;
        other.selection.highHz = 300.0;
        const auto live = run(scene(60.0), settings(), 20.0, other);
        QCOMPARE(live->refusals.size(), std::size_t(1));
        QVERIFY(live->refusals[0].find("selection.lowHz") != std::string::npos);
        QVERIFY(live->history.view().changes.empty());
        QVERIFY(live->result.isAnalysedToTheEnd);
    }

    // Asked for behind the last frame, which begins at 59.75 s.
    void tellsOfSettingsThatCameTooLate()
    {
        AnalysisSettings other = settings().analysis;
        other.decide.falseAlarmsPerHour = 5.0;
        const auto live = run(scene(60.0), settings(), 59.74, other);
        QCOMPARE(live->refusals.size(), std::size_t(1));
        QVERIFY2(live->refusals[0].starts_with("Listening ended before the changed settings took effect"),
                 live->refusals[0].c_str());
        QVERIFY(live->history.view().changes.empty());
        QCOMPARE(live->result.plan.settings.decide.falseAlarmsPerHour, 60.0);
    }

private:
    QTemporaryDir m_folder;
};

FAINTLINE_TEST(tst_LiveHistory)
#include "tst_LiveHistory.moc"
