#include "live/listen.h"
#include "support/test.h"

#include "analyse/analyse.h"
#include "calibrate/calibrate.h"
#include "exchange/writeEvents.h"
#include "scene/SimulatedRecording.h"
#include "signal/formats/SigmfRecording.h"
#include "support/recordings.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <thread>

using namespace faintline;
using namespace faintline::test;

namespace {

constexpr double heardRate = 1000.0;

StreamFormat format()
{
    return {parseSampleType("rf32_le", "test"), heardRate, 1, 0.0, "test"};
}

std::vector<std::byte> bytesOf(std::span<const float> samples)
{
    const auto bytes = std::as_bytes(samples);
    return {bytes.begin(), bytes.end()};
}

/// Delivers what it was given, one piece at a time.
class GivenSource final : public SampleSource
{
public:
    GivenSource(StreamFormat format, std::vector<Heard> pieces, bool isPatient = true)
        : m_format(std::move(format)), m_pieces(std::move(pieces)), m_isPatient(isPatient)
    {
    }
    const StreamFormat &format() const override { return m_format; }
    bool isPatient() const override { return m_isPatient; }
    Heard hear(std::chrono::milliseconds) override
    {
        if (m_next == m_pieces.size()) {
            Heard end;
            end.isOver = true;
            return end;
        }
        return std::move(m_pieces[m_next++]);
    }

private:
    StreamFormat m_format;
    std::vector<Heard> m_pieces;
    std::size_t m_next = 0;
    bool m_isPatient;
};

/// Never says anything, for ever.
class QuietSource final : public SampleSource
{
public:
    const StreamFormat &format() const override { return m_format; }
    Heard hear(std::chrono::milliseconds patience) override
    {
        std::this_thread::sleep_for(patience);
        return {};
    }

private:
    StreamFormat m_format = ::format();
};

struct Gap {
    Index at;
    Index length;
};

/// The samples in pieces of random lengths, those of the gaps lost.
std::vector<Heard> piecesOf(const std::vector<float> &samples, const std::vector<Gap> &gaps, std::uint64_t seed)
{
    Random random(seed, 1);
    std::vector<Heard> pieces;
    Index lost = 0;
    auto gap = gaps.begin();
    for (Index at = 0; at < std::ssize(samples);) {
        if (gap != gaps.end() && gap->at == at) {
            lost = gap->length;
            at += gap++->length;
            continue;
        }
        Index count = 1 + Index(random.uniform() * 3000.0);
        count = std::min(count, std::ssize(samples) - at);
        if (gap != gaps.end())
            count = std::min(count, gap->at - at);
        Heard heard;
        heard.bytes = bytesOf(std::span(samples).subspan(std::size_t(at), std::size_t(count)));
        heard.lostSamples = std::exchange(lost, 0);
        if (heard.lostSamples > 0)
            heard.incident = Heard::Incident::Lost;
        pieces.push_back(std::move(heard));
        at += count;
    }
    return pieces;
}

std::vector<Gap> randomGaps(int count, Index samples, Index longest, std::uint64_t seed)
{
    Random random(seed, 2);
    std::vector<Gap> gaps;
    const Index share = samples / count;
    for (int i = 0; i < count; ++i) {
        const auto length = 1 + Index(random.uniform() * double(longest));
        gaps.push_back({i * share + 1 + Index(random.uniform() * double(share - length - 2)), length});
    }
    return gaps;
}

/// Ten minutes with lines that come and go, one of them interrupted.
std::vector<float> scene(double seconds = 600.0)
{
    LineScene lines{.sampleRateHz = heardRate, .durationSeconds = seconds};
    lines.noise.deviation = 0.1;
    lines.seed = 4;
    const auto add = [&](LineSettings line) {
        line.durationSeconds = std::min(line.durationSeconds, seconds - line.startSeconds);
        if (line.durationSeconds > 0.0)
            lines.lines.push_back(line);
    };
    for (int i = 0; i < 8; ++i) {
        LineSettings line{.snrDb = 6.0 + i,
                          .referenceSeconds = 0.25,
                          .startSeconds = 20.0 + 60.0 * i,
                          .durationSeconds = 25.0 + 15.0 * i,
                          .frequencyHz = 60.0 + 50.0 * i,
                          .driftHzPerSecond = 0.05 * i};
        add(line);
        line.startSeconds += line.durationSeconds + 2.0;
        add(line);
    }
    LineSettings faint; // found in pieces
    faint.referenceSeconds = 0.25;
    for (const double snrDb : {0.0, 0.5, 1.0, 1.5, 2.0}) {
        faint.snrDb = snrDb;
        faint.frequencyHz = 470.0 - 85.0 * snrDb;
        faint.wanderHz = 2.0;
        lines.lines.push_back(faint);
    }
    const SimulatedRecording recording(lines);
    return readAll(recording);
}

/// A minute of noise with a line at 210 Hz.
std::vector<float> minuteWithALine(double snrDb, double startSeconds, double durationSeconds, int seed)
{
    LineScene scene{.sampleRateHz = heardRate, .durationSeconds = 60.0};
    scene.noise.deviation = 0.1;
    scene.seed = seed;
    scene.lines = {{.snrDb = snrDb,
                    .referenceSeconds = 0.25,
                    .startSeconds = startSeconds,
                    .durationSeconds = durationSeconds,
                    .frequencyHz = 210.0}};
    return readAll(SimulatedRecording(scene));
}

ListenSettings settings(const std::string &record)
{
    ListenSettings result;
    result.analysis.spectrogram.windowSeconds = 0.25;
    result.analysis.decide.falseAlarmsPerHour = 60.0;
    result.recordPath = record;
    return result;
}

} // namespace

/// What is heard live gives the events of its recording, gaps and all, to the byte.
class tst_listen : public QObject
{
    Q_OBJECT

private slots:
    void isTheSameAsItsRecording_data()
    {
        QTest::addColumn<int>("gaps");
        QTest::addColumn<int>("longest");
        QTest::addColumn<QString>("setting");
        QTest::newRow("without gaps") << 0 << 0 << "";
        QTest::newRow("short gaps") << 100 << 40 << "";
        QTest::newRow("long gaps") << 7 << 40000 << "";
        QTest::newRow("windows that overlap more") << 3 << 500 << "spectrogram.stepsPerWindow=4";
        QTest::newRow("a band") << 3 << 500 << "selection.lowHz=100,selection.highHz=300";
        QTest::newRow("from and to") << 3 << 500 << "selection.fromSeconds=30,selection.toSeconds=400";
        QTest::newRow("tracks that are confirmed later") << 0 << 0 << "track.confirmFrames=5";
        QTest::newRow("another detector") << 0 << 0 << "detector.kind=pOfN";
    }

    void isTheSameAsItsRecording()
    {
        QFETCH(int, gaps);
        QFETCH(int, longest);
        QFETCH(QString, setting);
        const std::string record = path((QTest::currentDataTag() + std::string(".sigmf-meta")).c_str());
        const std::vector<float> samples = scene();
        GivenSource source(
            format(),
            piecesOf(samples, gaps > 0 ? randomGaps(gaps, std::ssize(samples), longest, 5) : std::vector<Gap>(), 6));
        ListenSettings used = settings(record);
        for (const QString &each : setting.split(',', Qt::SkipEmptyParts))
            setSetting(used.analysis, each.section('=', 0, 0).toStdString(), each.section('=', 1).toStdString());
        const ListenResult live = listen(source, used, {});
        QVERIFY(live.isAnalysedToTheEnd && live.isRecordedWhole);
        const SigmfRecording kept(record);
        if (used.analysis.selection.toSeconds == 0.0)
            QCOMPARE(kept.info().sampleCount, std::ssize(samples));
        const auto file =
            analyse(std::make_shared<SigmfRecording>(record), settingsForListening(used.analysis, format()));
        QVERIFY(live.events.size() >= 8);
        QCOMPARE(QByteArray::fromStdString(eventsCsv(live.plan, live.events)),
                 QByteArray::fromStdString(eventsCsv(*file, events(*file))));
        const bool isAsked = setting != "detector.kind=pOfN"; // others are only cut to their signals
        QVERIFY(std::ranges::all_of(live.events, [&](const Event &e) { return std::isfinite(e.snrDb) == isAsked; }));
    }

    // Bursts of noise 60 Hz wide, through each of which the detector finds paths.
    void mostPathsThroughBurstsAreWithdrawn()
    {
        Random random(31, 1);
        std::vector<float> samples(std::size_t(200.0 * heardRate));
        random.normals(samples, 0.1f);
        std::vector<float> slow(samples.size());
        random.normals(slow, 1.0f);
        double mean = 0.0;
        for (const double begin : {60.0, 100.0, 140.0})
            for (std::size_t i = 0; i < std::size_t(3.0 * heardRate); ++i) {
                const std::size_t at = std::size_t(begin * heardRate) + i;
                mean += 0.2 * (double(slow[at]) - mean);
                samples[at] += float(0.4 * mean * std::cos(2.0 * std::numbers::pi * 0.2 * double(i)));
            }
        GivenSource source(format(), piecesOf(samples, {}, 9));
        std::vector<Event> withdrawn;
        ListenSinks sinks;
        sinks.event = [&](const EventChange &change, const AnalysisPlan &) {
            if (change.isWithdrawn)
                withdrawn.push_back(change.event);
        };
        const ListenResult live = listen(source, settings({}), sinks);
        const auto isInBurst = [](const Event &event) {
            return std::ranges::any_of(std::array{60.0, 100.0, 140.0}, [&](double begin) {
                return !event.position.empty() && event.detectSeconds > begin && event.detectSeconds < begin + 3.5
                       && std::abs(event.position.back() - 200.0) < 100.0;
            });
        };
        const auto gone = std::ranges::count_if(withdrawn, isInBurst);
        QVERIFY(gone >= 5);
        QVERIFY(2 * std::ranges::count_if(live.events, isInBurst) <= gone);
    }

    // Each number is provisional first, final last, once each, and says in between what a track says.
    void changesOfAnEvent()
    {
        const std::vector<float> samples = scene();
        GivenSource source(format(), piecesOf(samples, {}, 7));
        ListenSettings used = settings({});
        setSetting(used.analysis, "track.confirmFrames", "5");
        used.updateSeconds = 5.0;
        std::map<int, std::vector<EventChange>> changes;
        ListenSinks sinks;
        sinks.event = [&](const EventChange &change, const AnalysisPlan &) {
            changes[change.event.id].push_back(change);
        };
        const ListenResult live = listen(source, used, sinks);
        using State = EventChange::State;
        std::size_t ownEvents = 0;
        bool hasJoined = false;
        for (const auto &each : changes) {
            const auto id = each.first; // clang 14 captures no structured binding
            const auto &own = each.second;
            QVERIFY(own.size() >= 2);
            QCOMPARE(own.front().state, State::Provisional);
            QCOMPARE(own.back().state, State::Final);
            const auto count = [&](State state) {
                return std::count_if(own.begin(), own.end(),
                                     [state](const EventChange &c) { return c.state == state; });
            };
            QCOMPARE(count(State::Provisional), 1);
            QCOMPARE(count(State::Final), 1);
            QVERIFY(count(State::Confirmed) <= 1);
            hasJoined = hasJoined || own.back().partOf.has_value();
            if (own.back().partOf || own.back().isWithdrawn)
                continue;
            ++ownEvents;
            const auto found =
                std::find_if(live.events.begin(), live.events.end(), [id](const Event &e) { return e.id == id; });
            QVERIFY(found != live.events.end());
            QCOMPARE(found->detectSeconds, own.front().event.detectSeconds);
            QCOMPARE(found->endSeconds, own.back().event.endSeconds);
            QCOMPARE(own.front().event.endSeconds,
                     own.front().event.detectSeconds); // told in the frame of the crossing
            // What was lost and found again is told of under its own number until it is joined.
            const bool hasParts = std::any_of(changes.begin(), changes.end(),
                                              [id](const auto &other) { return other.second.back().partOf == id; });
            const double lasted = found->endSeconds - found->detectSeconds;
            QVERIFY(hasParts || double(count(State::Updated)) >= std::floor(lasted / 5.0) - 1.0);
        }
        QCOMPARE(ownEvents, live.events.size());
        QVERIFY(hasJoined);
        QVERIFY(contains(eventLine(changes.begin()->second.front(), live.plan, 0.0), R"("state":"provisional")"));
    }

    // A line at 6 dB, for which a stream suffices that ends two windows after the crossing.
    void isToldSoonAfterTheCrossing()
    {
        const std::vector<float> samples = minuteWithALine(6.0, 30.0, 25.0, 5);
        const auto told = [&](double seconds) {
            const auto count = std::size_t(seconds * heardRate);
            GivenSource source(format(), piecesOf({samples.begin(), samples.begin() + std::ptrdiff_t(count)}, {}, 8));
            std::vector<double> crossings;
            ListenSinks sinks;
            sinks.event = [&](const EventChange &change, const AnalysisPlan &) {
                if (change.state == EventChange::State::Provisional
                    && std::abs(change.event.position.front() - 210.0) < 10.0)
                    crossings.push_back(change.event.detectSeconds);
            };
            listen(source, settings({}), sinks);
            return crossings;
        };
        const std::vector<double> crossings = told(60.0);
        QVERIFY(!crossings.empty() && crossings.front() > 30.0 && crossings.front() < 35.0);
        QCOMPARE(told(crossings.front() + 2.0 * 0.25), std::vector{crossings.front()});
        QVERIFY(told(crossings.front() - 0.25).empty()); // the line itself, not the stream's end
    }

    // A tracker goes on through noise for a while before it gives up; what is told of it does not.
    void nothingIsToldBeyondTheLastEvidence()
    {
        GivenSource source(format(), piecesOf(minuteWithALine(12.0, 10.0, 20.0, 6), {}, 8));
        ListenSettings used = settings({});
        used.updateSeconds = 1.0;
        int updates = 0;
        ListenSinks sinks;
        sinks.event = [&](const EventChange &change, const AnalysisPlan &) {
            if (std::abs(change.event.position.front() - 210.0) > 40.0)
                return;
            ++updates;
            QVERIFY2(change.event.endSeconds < 32.0, QByteArray::number(change.event.endSeconds));
            QVERIFY2(std::abs(change.event.position.front() - 210.0) < 4.0,
                     QByteArray::number(change.event.position.front()));
        };
        listen(source, used, sinks);
        QVERIFY(updates > 20);
    }

    // A thousand, each of which has to be where it was: the oracle are the samples themselves.
    void gapsArePlacedToTheSample()
    {
        const std::vector<float> samples = someNoise(600'000, 9);
        const std::vector<Gap> gaps = randomGaps(1000, std::ssize(samples), 300, 10);
        GivenSource source(format(), piecesOf(samples, gaps, 11));
        Index told = 0;
        Index lost = 0;
        ListenSinks sinks;
        sinks.notice = [&](const ListenNotice &notice, const StreamFormat &) {
            if (notice.kind != ListenNotice::Kind::Lost)
                return;
            QCOMPARE(notice.sample, gaps[std::size_t(told)].at);
            QCOMPARE(notice.sampleCount, gaps[std::size_t(told)].length);
            lost += notice.sampleCount;
            ++told;
        };
        const ListenResult live = listen(source, settings(path("gaps.sigmf-meta")), sinks);
        QCOMPARE(told, Index(1000));
        QCOMPARE(live.lostCount, lost);
        const SigmfRecording kept(path("gaps.sigmf-meta"));
        std::vector<float> expected = samples;
        for (const Gap &gap : gaps)
            std::fill_n(expected.begin() + gap.at, gap.length, 0.0f);
        QCOMPARE(kept.info().sampleCount, std::ssize(samples));
        QVERIFY(readAll(kept) == expected);
        QVERIFY(readInPieces(kept, 5000) == expected);
        for (const Gap &gap : gaps) {
            QVERIFY(!kept.isWhole(gap.at, 1) && !kept.isWhole(gap.at + gap.length - 1, 1));
            QVERIFY(!kept.isWhole(gap.at - 1, 2) && !kept.isWhole(gap.at - 100, gap.length + 200));
            QVERIFY(kept.isWhole(gap.at - 1, 1) && kept.isWhole(gap.at + gap.length, 1));
        }
    }

    // A source that does not wait, and a buffer that cannot hold what it says at once.
    void overflowIsAGap()
    {
        const std::vector<float> samples = scene();
        GivenSource source(format(), piecesOf(samples, {}, 12), false);
        ListenSettings used = settings(path("overflow.sigmf-meta"));
        used.bufferBytes = 300'000;
        Index overflown = 0;
        ListenSinks sinks;
        sinks.notice = [&](const ListenNotice &notice, const StreamFormat &) {
            if (notice.kind == ListenNotice::Kind::Overflow)
                overflown += notice.sampleCount;
        };
        const ListenResult live = listen(source, used, sinks);
        QVERIFY(overflown > 0);
        QCOMPARE(live.lostCount, overflown);
        const auto file =
            analyse(std::make_shared<SigmfRecording>(used.recordPath), settingsForListening(used.analysis, format()));
        QCOMPARE(eventsCsv(live.plan, live.events), eventsCsv(*file, events(*file)));
    }

    void doesNotOverwrite()
    {
        const std::string name = path("there.sigmf-meta");
        writeBytes(name, "mine");
        GivenSource source(format(), piecesOf(scene(20.0), {}, 1));
        QVERIFY(contains(errorOf([&] { listen(source, settings(name), {}); }), "exists already"));
        QCOMPARE(readBytes(name), QByteArray("mine"));
    }

    void rotates()
    {
        const std::vector<float> samples = someNoise(60'000, 3);
        GivenSource source(format(), piecesOf(samples, {{30'123, 456}}, 4));
        ListenSettings used = settings(path("turn.sigmf-meta"));
        used.rotation.longestSeconds = 20.0;
        const ListenResult live = listen(source, used, {});
        QCOMPARE(live.files.size(), std::size_t(3));
        QCOMPARE(QString::fromStdString(live.recording), m_folder.filePath("turn.timeline"));
        QCOMPARE(readBytes(live.recording), QByteArray("turn.sigmf-meta\nturn-2.sigmf-meta\nturn-3.sigmf-meta\n"));
        std::vector<float> all;
        double start = 0.0;
        for (const std::string &file : live.files) {
            const SigmfRecording part(file);
            if (!all.empty()) // begins where the one before ended, by the clock
                QVERIFY(std::abs(*part.info().startUnixSeconds - start - double(all.size()) / heardRate) < 1e-4);
            else
                start = *part.info().startUnixSeconds;
            const std::vector<float> own = readAll(part);
            all.insert(all.end(), own.begin(), own.end());
        }
        std::vector<float> expected = samples;
        std::fill_n(expected.begin() + 30'123, 456, 0.0f);
        QVERIFY(all == expected);
    }

    void shorterThanAWindow()
    {
        GivenSource source(format(), piecesOf(someNoise(200), {}, 1));
        const ListenResult live = listen(source, settings(path("short.sigmf-meta")), {});
        QVERIFY(live.events.empty() && !live.plan.frames);
        QCOMPARE(SigmfRecording(path("short.sigmf-meta")).info().sampleCount, Index(200));
        GivenSource half(format(), piecesOf(someNoise(4000), {}, 1)); // and than a block
        QVERIFY(listen(half, settings({}), {}).plan.frames);
    }

    void stopsWhenAsked()
    {
        QuietSource source;
        std::stop_source stop;
        RunContext context;
        context.stop = stop.get_token();
        std::jthread asking([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
            stop.request_stop();
        });
        QElapsedTimer timer;
        (void)calibrateBand(settingsForListening(settings({}).analysis, format()), 251); // once, which takes seconds
        timer.start();
        listen(source, settings({}), {}, context);
        QVERIFY2(timer.elapsed() < 1000, qPrintable(QString::number(timer.elapsed())));
    }

private:
    std::string path(const char *name) const { return m_folder.filePath(name).toStdString(); }
    QTemporaryDir m_folder;
};

FAINTLINE_TEST(tst_listen)
#include "tst_listen.moc"
