#include "exchange/survey/carryOutSurvey.h"

#include "analyse/analyse.h"
#include "base/Error.h"
#include "base/RunContext.h"
#include "base/files/fileName.h"
#include "base/oneLine.h"
#include "exchange/reviewedText.h"
#include "exchange/survey/SurveyOrigin.h"
#include "exchange/survey/SurveyOutcome.h"
#include "exchange/survey/surveySchema.h"
#include "exchange/survey/writeSurvey.h"
#include "plan/firstSettings.h"
#include "signal/fileHash.h"
#include "signal/formats/SigmfRecording.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <latch>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <thread>

#include <sys/stat.h>

namespace faintline {

namespace {

    std::vector<std::string> filesOf(const std::string &path, const SurveySettings &settings)
    {
        if (settings.open.rawType.empty() && SigmfRecording::isNamedSo(path))
            try {
                return {SigmfRecording::metaPath(path), SigmfRecording::dataPath(path)};
            } catch (const Error &) { // reported when it is opened
                return {path};
            }
        if (hasEnding(path, ".npy") && std::filesystem::exists(gridPathOf(path)))
            return {path, gridPathOf(path)};
        return {path};
    }

    NormalisedFramesPointer openPowerOf(const SurveySettings &settings, SurveyRecording &described,
                                        const RunContext &context)
    {
        const std::string &path = described.file.path;
        if (const auto power = openPower(path)) {
            described.container = power->info().container;
            described.startUnixSeconds = power->info().startUnixSeconds;
        }
        const auto frames = openFrames(path, {settings.analysis.selection, settings.analysis.noise}, context);
        if (!frames->grid().isSpectrum())
            throw Error(path, "contains frames with several axes; a survey requires recordings, or frames with a "
                              "frequency axis only");
        described.durationSeconds = double(frames->time().count) * frames->time().step;
        return frames;
    }

    RecordingPointer openSamplesOf(const SurveySettings &settings, SurveyRecording &described)
    {
        const RecordingPointer recording = openRecording(described.file.path, settings.open);
        const RecordingInfo &info = recording->info();
        described.container = info.container;
        described.sampleRateHz = info.sampleRateHz;
        described.durationSeconds = info.durationSeconds();
        if (info.isCentreKnown())
            described.centreHz = info.centreHz;
        described.startUnixSeconds = info.startUnixSeconds;
        return recording;
    }

    std::shared_ptr<const Analysis> analyseFile(const SurveySettings &settings, SurveyRecording &described,
                                                const RunContext &context)
    {
        OpenedSource opened;
        if (settings.open.rawType.empty() && holdsFrames(described.file.path))
            opened.frames = openPowerOf(settings, described, context);
        else
            opened.recording = openSamplesOf(settings, described);
        const AnalysisSettings fitted =
            opened.recording ? withFittedOrder(settings.analysis, opened.recording->info()) : settings.analysis;
        return analyse(opened, fitted, {.depth = AnalysisDepth::Tracks}, context);
    }

    void describe(const Analysis &analysis, SurveyRecording &described)
    {
        described.settings = settingsToJson(analysis.settings);
        if (const FrameGeometry geometry = analysis.frames->geometry(); geometry.isOfSpectra())
            described.windowSeconds = geometry.windowSeconds;
        described.threshold = analysis.threshold;
        described.unit = statisticUnit(analysis.settings.detector);
        described.lnK = analysis.calibration->lnK;
    }

    std::vector<SurveyPoint> pointsOf(const Analysis &analysis)
    {
        std::vector<SurveyPoint> points;
        for (const Track &track : analysis.tracks)
            for (const std::size_t i : track.presentPoints()) {
                SurveyPoint &point = points.emplace_back(SurveyPoint{track.id, {}});
                for (std::size_t at = 0; at < point.values.size(); ++at)
                    point.values[at] = surveyTrackColumns()[at].number({&analysis, &track, i});
            }
        return points;
    }

    SurveyOutcome failed(SurveyOutcome outcome, const std::string &reason)
    {
        outcome.recording.reason = oneLine(reason, longestMessage);
        return outcome;
    }

    /// Length and date of a recording's file, or of both its files; without the hash. A missing file has length 0.
    SurveyFile fileOf(const std::string &path, const SurveySettings &settings)
    {
        SurveyFile file{path, 0, 0, {}};
        for (const std::string &one : filesOf(path, settings)) {
            struct stat status = {};
            if (::stat(one.c_str(), &status) != 0)
                continue;
            file.bytes += status.st_size;
            file.modified = std::max(file.modified, std::int64_t(status.st_mtim.tv_sec) * 1'000'000'000
                                                        + std::int64_t(status.st_mtim.tv_nsec));
        }
        return file;
    }

    /// The hash of the file; empty if it cannot be read.
    std::string hashOf(const SurveyFile &file, const SurveySettings &settings)
    {
        std::string hash;
        try {
            for (const std::string &one : filesOf(file.path, settings))
                hash += '+' + fileHash(one);
        } catch (const Error &) {
            return {};
        }
        return hash.substr(std::min<std::size_t>(1, hash.size()));
    }

    /// Analyses one recording of a survey as `detect` does. If that fails, the outcome contains the reason. Throws only
    /// Cancelled.
    SurveyOutcome surveyRecording(const SurveyFile &file, const SurveySettings &settings, const RunContext &context)
    {
        SurveyOutcome outcome;
        SurveyRecording &described = outcome.recording;
        described.file = file;
        try {
            const auto analysis = analyseFile(settings, described, context);
            describe(*analysis, described);
            for (Event &event : events(*analysis)) {
                Annotation box;
                fillBox(*analysis, event, box);
                outcome.events.push_back({std::move(event), std::move(box)});
            }
            outcome.points = pointsOf(*analysis);
            outcome.areas = areaEvents(*analysis);
            return outcome;
        } catch (const Error &error) {
            return failed(outcome, error.where() == file.path ? error.why() : error.what());
        } catch (const std::bad_alloc &) {
            return failed(outcome, "out of memory; choose a shorter part, a narrower band or a shorter window");
        } catch (const Cancelled &) {
            throw;
        } catch (const std::exception &error) {
            return failed(outcome, error.what());
        }
    }

    /// A recording to be analysed.
    struct Task {
        SurveyFile file;
        std::int64_t known = 0; ///< its number in the database if it was analysed before
        std::string knownHash;
    };

    /// Result of a task; no outcome: the content has not changed.
    struct Result {
        Task task;
        std::optional<SurveyOutcome> outcome;

        /// The recording was analysed before, and now it or the second of its files cannot be read, for example on a
        /// disk that is not mounted.
        bool isAway() const
        {
            return outcome && !outcome->recording.isAnalysed() && task.known
                   && task.knownHash.starts_with(task.file.hash);
        }
    };

    Result resultOf(Task task, const SurveySettings &settings, const RunContext &context)
    {
        task.file.hash = hashOf(task.file, settings);
        if (task.known != 0 && !task.file.hash.empty() && task.file.hash == task.knownHash)
            return {task, std::nullopt};
        return {task, surveyRecording(task.file, settings, context)};
    }

    /// Threads that carry out tasks in order, one at a time each. The owner takes the results; the threads end with the
    /// object.
    class Workers
    {
    public:
        Workers(const std::vector<Task> &tasks, const SurveySettings &settings, int jobs, const RunContext &context)
            : m_tasks(tasks), m_settings(settings), m_stopWith(context.stop, [this] { m_stop.request_stop(); }),
              m_fractions(std::size_t(jobs))
        {
            for (int i = 0; i < std::min<std::ptrdiff_t>(jobs, std::ssize(tasks)); ++i)
                m_threads.emplace_back(
                    [this, i, threads = context.threads, jobs] { work(std::size_t(i), threads, jobs); });
        }
        ~Workers() { m_stop.request_stop(); }
        Workers(const Workers &) = delete;
        Workers &operator=(const Workers &) = delete;

        /// The results that are available, or become available within `patience`.
        std::vector<Result> take(std::chrono::milliseconds patience)
        {
            std::unique_lock lock(m_guard);
            m_arrived.wait_for(lock, patience, [this] { return !m_results.empty(); });
            return std::exchange(m_results, {});
        }

        /// Completed part of the tasks in progress, in tasks.
        double inWork() const
        {
            double sum = 0.0;
            for (const std::atomic<double> &fraction : m_fractions)
                sum += fraction;
            return sum;
        }

    private:
        /// The first task has all threads to itself: it calibrates, and the others use its calibration.
        void work(std::size_t own, int threads, int jobs)
        {
            if (own > 0)
                m_firstIsDone.wait();
            for (std::size_t task = m_next++; task < m_tasks.size(); task = m_next++) {
                RunContext context;
                context.stop = m_stop.get_token();
                context.threads = task == 0 ? threads : std::max(1, threads / jobs);
                context.progress = [this, own](double fraction, std::string_view) { m_fractions[own] = fraction; };
                const bool goesOn = carryOut(m_tasks[task], own, context);
                if (task == 0)
                    m_firstIsDone.count_down();
                if (!goesOn)
                    return;
            }
        }

        bool carryOut(const Task &task, std::size_t own, const RunContext &context)
        {
            if (m_stop.stop_requested())
                return false;
            try {
                Result result = resultOf(task, m_settings, context);
                const std::lock_guard lock(m_guard);
                m_fractions[own] = 0.0;
                m_results.push_back(std::move(result));
            } catch (const Cancelled &) {
                return false;
            }
            m_arrived.notify_one();
            return true;
        }

        const std::vector<Task> &m_tasks;
        const SurveySettings &m_settings;
        std::stop_source m_stop;
        std::stop_callback<std::function<void()>> m_stopWith;
        std::vector<std::atomic<double>> m_fractions; ///< of each worker's task
        std::atomic<std::size_t> m_next = 0;
        std::latch m_firstIsDone{1};
        std::mutex m_guard;
        std::condition_variable m_arrived;
        std::vector<Result> m_results;
        std::vector<std::jthread> m_threads; // destroyed first
    };

    /// The recordings of the shard that the database does not contain in their present state.
    std::vector<Task> tasksOf(const SurveyRun &run, SurveyDatabase &database, int &kept)
    {
        std::map<std::string, SurveyRecording> known;
        for (SurveyRecording &one : database.recordings())
            if (one.isAnalysed())
                known.emplace(one.file.path, one);
        std::vector<Task> tasks;
        const auto count = std::size_t(run.shard.count);
        for (std::size_t i = std::size_t(run.shard.index) % count; i < run.recordings.size(); i += count) {
            Task task{fileOf(run.recordings[i], run.settings), 0, {}};
            const auto there = known.find(run.recordings[i]);
            if (there != known.end()) {
                const SurveyFile &before = there->second.file;
                task.known = there->second.id;
                task.knownHash = before.hash;
                if (before.bytes == task.file.bytes && before.modified == task.file.modified) {
                    ++kept;
                    continue;
                }
            }
            tasks.push_back(std::move(task));
        }
        return tasks;
    }

    void put(const std::vector<Result> &results, SurveyDatabase &database)
    {
        database.begin();
        for (const Result &result : results)
            if (!result.outcome)
                database.setModified(result.task.known, result.task.file);
            else if (!result.isAway())
                database.put(*result.outcome);
        database.commit();
    }

    SurveyTally analyseAll(const std::vector<Task> &tasks, const SurveyRun &run, SurveyDatabase &database,
                           const RunContext &context, const SurveyWarning &warn)
    {
        SurveyTally tally;
        using Clock = std::chrono::steady_clock;
        constexpr std::size_t mostPending = 50; // recordings lost if the program is killed; each commit waits for the
                                                // disk
        Workers workers(tasks, run.settings, run.jobs, context);
        std::vector<Result> pending;
        auto committed = Clock::now();
        for (std::size_t done = 0; done < tasks.size();) {
            const bool isStopped = context.stop.stop_requested(); // earlier results are still stored
            for (Result &result : workers.take(std::chrono::milliseconds(100))) {
                ++done;
                if (!result.outcome)
                    ++tally.kept;
                else if (result.outcome->recording.isAnalysed())
                    ++tally.analysed;
                else if (++tally.failed; warn)
                    warn(result.task.file.path, result.outcome->recording.reason);
                pending.push_back(std::move(result));
            }
            const bool isDue = done == tasks.size() || isStopped || pending.size() >= mostPending
                               || Clock::now() > committed + std::chrono::seconds(1);
            if (isDue && !pending.empty()) {
                put(std::exchange(pending, {}), database);
                committed = Clock::now();
            }
            if (isStopped)
                throw Cancelled();
            if (context.progress)
                context.progress((double(done) + workers.inWork()) / double(tasks.size()),
                                 std::to_string(done) + " of " + std::to_string(tasks.size()) + " recordings");
        }
        return tally;
    }

    bool isThere(const std::string &path)
    {
        std::error_code code;
        return std::filesystem::exists(path, code)
               && !(std::filesystem::is_regular_file(path, code) && std::filesystem::file_size(path, code) == 0);
    }

} // namespace

SurveyTally carryOutSurvey(const SurveyRun &run, const std::string &out, const RunContext &context,
                           const SurveyWarning &warn)
{
    const SurveyOrigin origin = originOf(run.settings, run.shard.name());
    if (!isThere(out))
        beginSurvey(origin, out);
    SurveyDatabase database(out, Sqlite::Access::Write);
    database.connection().waitWhile([&] { return !context.stop.stop_requested(); }); // for example for an export
    checkOrigin(database.origin(), origin, out);
    int kept = 0;
    const std::vector<Task> tasks = tasksOf(run, database, kept);
    if (tasks.empty() && database.isFinished())
        return {0, kept, 0};
    try {
        database.setUnfinished();
        SurveyTally tally = analyseAll(tasks, run, database, context, warn);
        tally.kept += kept;
        database.lock(); // no review may be stored between the reading and the new file
        writeSurvey({&database}, origin, out);
        return tally;
    } catch (const Error &) {
        if (context.stop.stop_requested()) // while it waited for another program
            throw Cancelled();
        throw;
    }
}

} // namespace faintline
