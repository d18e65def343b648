#include "app/cli/addOpening.h"
#include "app/cli/commands.h"
#include "app/cli/inRange.h"

#include "base/files/AtomicFile.h"
#include "base/json.h"
#include "base/oneLine.h"
#include "noise/openFrames.h"
#include "noise/pings/NormalisedPings.h"
#include "plan/firstSettings.h"
#include "plan/slopeUnit.h"
#include "signal/Timeline.h"
#include "signal/openRecording.h"

#include <CLI/CLI.hpp>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

namespace faintline::cli {

RunContext Common::context() const
{
    RunContext context;
    context.stop = stop;
    context.threads = threads;
    const bool lines = progress == "json";
    if (progress == "none" || (!lines && !isatty(STDERR_FILENO)))
        return context;
    context.progress = [lines, last = -1](double fraction, std::string_view what) mutable {
        const int percent = int(100.0 * fraction);
        if (percent == last)
            return;
        last = percent;
        if (lines)
            std::fprintf(stderr, "{\"progress\": %.2f, \"doing\": \"%.*s\"}\n", fraction, int(what.size()),
                         what.data());
        else
            std::fprintf(stderr, "\r\033[K%3d %%  %.*s%s", percent, int(what.size()), what.data(),
                         percent >= 100 ? "\n" : "");
        std::fflush(stderr);
    };
    return context;
}

namespace {

    /// Takes a path of the command line as an input.
    auto readBy(Common &common)
    {
        return [&common](const std::string &asked) {
            const std::string path = common.read && !asked.empty() ? common.read(asked) : asked;
            common.inputs.push_back(path);
            return path;
        };
    }

} // namespace

void Common::guardInputs()
{
    std::vector<std::string> files;
    for (const std::string &input : inputs) {
        const std::vector<std::string> all = filesReadFor(input);
        files.insert(files.end(), all.begin(), all.end());
    }
    inputFiles = std::make_shared<const InputFiles>(files);
    for (const std::string &output : outputs)
        try {
            checkReplacesNoInput(output);
        } catch (const Error &error) {
            if (!output.ends_with(".sigmf-meta"))
                throw;
            throw Error(error.where(), error.why() + "; detect --annotate adds events to a recording's annotations");
        }
}

CLI::Option *addInput(CLI::App &command, Common &common, const std::string &name, std::string &path,
                      const std::string &description)
{
    return command.add_option(name, path, description)->transform(readBy(common));
}

CLI::Option *addInput(CLI::App &command, Common &common, const std::string &name, std::vector<std::string> &paths,
                      const std::string &description)
{
    return command.add_option(name, paths, description)->transform(readBy(common));
}

CLI::Option *addOutput(CLI::App &command, Common &common, const std::string &name, std::string &path,
                       const std::string &description)
{
    const auto written = [&common](const std::string &asked) {
        const std::string own = common.written && !asked.empty() ? common.written(asked) : asked;
        common.outputs.push_back(own);
        return own;
    };
    return command.add_option(name, path, description)->transform(written);
}

void AnalysisOptions::addTo(CLI::App &command, Common &common)
{
    addInput(command, common, "FILE", file,
             "Recording (WAV, FLAC, SigMF …), a folder or a list (.timeline) of files that form one recording, a "
             "scene to simulate (.json), or a session (.faintline) with its recording and settings")
        ->required();
    addSettingsTo(command, common);
}

void AnalysisOptions::addMoreTo(CLI::App &command, Common &common)
{
    addInput(command, common, "FILES", more, "Further files of the same recording, in any order; needs --timeline");
    command.add_flag("--timeline", asTimeline,
                     "Take several files as one recording, in the order of their time stamps, with gaps as gaps");
}

std::vector<std::string> AnalysisOptions::names() const
{
    std::vector<std::string> all{file};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

void AnalysisOptions::checkMore() const
{
    if (!more.empty() && !asTimeline)
        throw Error(more.front(), "is a second recording; give --timeline to take several files as one recording; "
                                  "'survey' searches each of them");
}

void AnalysisOptions::addSettingsTo(CLI::App &command, Common &common)
{
    m_common = &common;
    addInput(command, common, "--session", session, "Session or settings file to start from");
    command.add_option("--preset", preset, "Named settings to start from (see 'describe')");
    command.add_option("--set", assignments, "A setting, name=value; may be repeated")
        ->take_all()
        ->allow_extra_args(false);
    command.add_option("--channel", channel, "Channel, counted from 0")->check(inRange(0, 1023));
    part.addTo(command);
    addOpening(command, open);
}

std::optional<Session> AnalysisOptions::namedSession() const
{
    if (!isSessionPath(file))
        return std::nullopt;
    checkSession();
    Session named = readSession(file);
    if (m_common->read && !named.source.isSimulated())
        named.source.path = m_common->read(named.source.path);
    return named;
}

void AnalysisOptions::checkSession() const
{
    if (!session.empty())
        throw Error("--session", "is not allowed with a session as FILE");
    if (asTimeline)
        throw Error("--timeline", "is not allowed with a session as FILE");
    if (open.iq || !open.rawType.empty() || open.rawRateHz > 0.0)
        throw Error(file, "is a session, which says how its recording is read; leave out --iq and --raw-…");
}

Source AnalysisOptions::source() const
{
    const std::optional<Session> named = namedSession();
    if (!named)
        return sourceOf(file, open);
    if (!recordingMismatch(*named).empty())
        throw Error(named->source.path, "has changed since " + file
                                            + " was saved; save the session again, or take only its settings: detect "
                                              "RECORDING --session SESSION");
    return named->source;
}

AnalysisSettings AnalysisOptions::settings() const
{
    AnalysisSettings settings;
    const std::optional<Session> named = namedSession();
    const Source from = named ? named->source : sourceOf(file, open);
    if (named)
        settings = named->settings;
    if (!session.empty()) {
        const Json json = readJsonFile(session);
        settings = settingsFromJson(json.contains("settings") ? json["settings"].dump() : json.dump(), session);
    }
    if (!preset.empty())
        settings = faintline::preset(preset).settings;
    else if (session.empty() && !named && from.pings)
        settings = firstSettings(pingGrid(*from.pings));
    if (session.empty() && !named && !file.empty() && from.hasSamples())
        settings = withFittedOrder(settings, recording()->info());
    if (channel >= 0)
        setSetting(settings, "selection.channel", std::to_string(channel));
    std::vector<std::string> all = part.assignments();
    all.insert(all.end(), assignments.begin(), assignments.end());
    for (const std::string &assignment : all) {
        const std::size_t equals = assignment.find('=');
        if (equals == std::string::npos)
            throw Error("--set " + assignment, "must be name=value, such as spectrogram.windowSeconds=0.5");
        setSetting(settings, assignment.substr(0, equals), assignment.substr(equals + 1));
    }
    if (settings.model.slopeUnit != SlopeUnit::BinsPerFrame && !file.empty() && from.hasSamples())
        settings = withSlopesInBins(settings, recording()->info());
    checkSettings(settings);
    return settings;
}

RecordingPointer AnalysisOptions::recording() const
{
    if (!m_recording)
        m_recording = asTimeline ? openTogether(names(), open) : openSamples(source());
    return m_recording;
}

OpenedSource AnalysisOptions::opened(const AnalysisSettings &settings, const RunContext &context) const
{
    const Source from = source();
    if (from.hasSamples() || !more.empty())
        return recording();
    const OpenedSource opened = openSource(from, normalisationBy(settings), context);
    if (!from.isSimulated())
        tellGuess(*opened.frames, from.path, *m_common);
    return opened;
}

std::shared_ptr<const Analysis> AnalysisOptions::numbered(std::shared_ptr<const Analysis> analysis) const
{
    std::optional<Session> named = namedSession();
    return named ? named->numbers.number(std::move(analysis)) : analysis;
}

std::vector<std::string> AnalysisOptions::inputs() const
{
    if (file.empty())
        return {session};
    const std::optional<Session> named = namedSession();
    if (named && named->source.isSimulated())
        return {file};
    std::vector<std::string> files = named ? filesBehind({named->source.path}, !named->source.options.rawType.empty())
                                           : filesBehind(names(), !open.rawType.empty());
    files.push_back(named ? file : session);
    return files;
}

Shard shardFrom(const std::string &text)
{
    const std::size_t slash = text.find('/');
    const std::optional<double> index = slash == std::string::npos ? std::nullopt : parseNumber(text.substr(0, slash));
    const std::optional<double> count = slash == std::string::npos ? std::nullopt : parseNumber(text.substr(slash + 1));
    const auto isWhole = [](double value) { return value == std::floor(value); };
    if (!index || !count || !isWhole(*index) || !isWhole(*count) || *count < 1.0 || *count > 1e6 || *index < 0.0
        || *index > *count)
        throw Error("--shard " + text, "must be I/N with 0 ≤ I ≤ N (0 and N name the same shard)");
    return {int(*index), int(*count)};
}

void checkDifferent(const std::vector<std::string> &outputs)
{
    std::vector<std::string> before;
    for (const std::string &output : outputs) {
        if (output.empty())
            continue;
        const std::vector<std::string> own = filesWrittenFor(output);
        for (const std::string &file : own)
            if (std::ranges::any_of(before, [&](const std::string &other) { return isSameFile(file, other); }))
                throw Error(file, "is given for two outputs");
        before.insert(before.end(), own.begin(), own.end());
    }
}

void checkOutputs(const std::vector<std::string> &paths)
{
    checkDifferent(paths);
    for (const std::string &path : paths)
        if (!path.empty())
            const AtomicFile probe(path); // removed again without a trace
}

Source sourceIn(const std::string &path, const OpenOptions &options)
{
    return isSessionPath(path) ? readSession(path).source : sourceOf(path, options);
}

std::shared_ptr<const SimulatedPings> pingsOf(const Source &source)
{
    return source.pings ? inFile(source.path, [&] { return std::make_shared<SimulatedPings>(*source.pings); })
                        : nullptr;
}

std::vector<std::string> notesOf(const Recording &recording)
{
    const RecordingInfo &info = recording.info();
    constexpr Index mostSamples = Index(1) << 28;
    constexpr Index block = 1 << 16;
    const Index end = std::min(info.sampleCount, std::max<Index>(1, mostSamples / info.channelCount));
    Index notObserved = 0;
    for (int channel = 0; channel < info.channelCount; ++channel) {
        if (recording.isFinite(channel, 0, end))
            continue;
        for (Index first = 0; first < end; first += block)
            notObserved += recording.nonFiniteCountIn(channel, first, std::min(block, end - first));
    }
    std::vector<std::string> notes = info.notes;
    if (notObserved > 0)
        notes.push_back(std::to_string(notObserved) + " sample(s)"
                        + (end < info.sampleCount ? " of the first " + std::to_string(end) : "")
                        + " are not finite; frames that reach into them are not observed.");
    return notes;
}

void tellNote(const std::string &note, const Common &common)
{
    if (common.progress == "json")
        std::fprintf(stderr, "%s\n", Json{{"note", note}}.dump(-1, ' ', true).c_str());
    else
        std::fprintf(stderr, "note: %s\n", note.c_str());
}

void tellGuess(const NormalisedFrames &frames, const std::string &path, const Common &common)
{
    if (const std::string guess = pingGuess(frames); !guess.empty())
        tellNote(oneLine(path) + ": " + guess, common);
}

} // namespace faintline::cli
