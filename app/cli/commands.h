#pragma once

#include "app/cli/PartOptions.h"

#include "base/Error.h"
#include "base/RunContext.h"
#include "base/Shard.h"
#include "base/files/InputFiles.h"
#include "exchange/Session.h"
#include "plan/AnalysisSettings.h"
#include "scene/SimulatedPings.h"
#include "signal/openRecording.h"

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace faintline::cli {

/// Shared by all subcommands.
struct Common {
    std::stop_token stop;
    int threads = 2;
    std::string progress = "auto";
    std::vector<std::string> arguments; ///< of this run, for provenance files
    bool keepsProvenance = true;
    /// Applied to each path of a file to read or write before its use; paths are unchanged if empty.
    std::function<std::string(const std::string &path)> read, written;
    std::vector<std::string> inputs, outputs; ///< files of this run that addInput and addOutput declared
    std::shared_ptr<const InputFiles> inputFiles{};

    /// Keeps the inputs from being replaced. Throws Error if an output is one of them.
    void guardInputs();

    /// Shows progress on standard error as requested.
    RunContext context() const;
};

/// Options for a recording and the settings of its analysis, the same in all subcommands.
struct AnalysisOptions {
    std::string file;
    std::string session;
    std::string preset;
    std::vector<std::string> assignments; ///< --set name=value
    int channel = -1;
    PartOptions part;
    OpenOptions open;
    std::vector<std::string> more; ///< further files of the recording
    bool asTimeline = false;

    void addTo(CLI::App &command, Common &common);
    void addSettingsTo(CLI::App &command, Common &common); ///< all except the recording
    /// Further files of the recording, with --timeline.
    void addMoreTo(CLI::App &command, Common &common);
    void checkMore() const; ///< throws if there are further files without --timeline
    std::vector<std::string> names() const;
    /// The session that FILE names, if it does: its settings come before the other options.
    std::optional<Session> namedSession() const;
    /// The session's, or the file itself. Throws Error if the recording is no longer that of the session.
    Source source() const;
    AnalysisSettings settings() const;
    RecordingPointer recording() const;
    /// The recording, or the frames of a file that is none: simulated pings, a stack (FILE.npy), power over time and
    /// frequency, normalised as the settings ask.
    OpenedSource opened(const AnalysisSettings &settings, const RunContext &context) const;
    /// With the numbers of the session that FILE names, under which the user knows its events.
    std::shared_ptr<const Analysis> numbered(std::shared_ptr<const Analysis> analysis) const;
    std::vector<std::string> inputs() const; ///< all input files; a SigMF recording has two

private:
    void checkSession() const;

    const Common *m_common = nullptr;
    mutable RecordingPointer m_recording; ///< once opened
};

void addInfo(CLI::App &app, Common &common);
void addDescribe(CLI::App &app, Common &common);
void addDetect(CLI::App &app, Common &common);
void addStatistic(CLI::App &app, Common &common);
void addExplain(CLI::App &app, Common &common);
void addSimulate(CLI::App &app, Common &common);
void addReproduce(CLI::App &app, Common &common);
void addEvaluate(CLI::App &app, Common &common);
void addMerge(CLI::App &app, Common &common);
void addCalibrate(CLI::App &app, Common &common);
void addInject(CLI::App &app, Common &common);
void addSequential(CLI::App &app, Common &common);
void addCompare(CLI::App &app, Common &common);
void addReplay(CLI::App &app, Common &common);
void addListen(CLI::App &app, Common &common);
void addStraighten(CLI::App &app, Common &common);
void addDoppler(CLI::App &app, Common &common);
void addSurvey(CLI::App &app, Common &common);
void addCadence(CLI::App &app, Common &common);

/// Executes a command line. Throws CLI::ParseError, Error, Cancelled.
void runCommandLine(const std::vector<std::string> &arguments, Common common);
void addBench(CLI::App &app, Common &common);

/// The source of a session, or the file itself.
Source sourceIn(const std::string &path, const OpenOptions &options);

/// The pings of a simulated sonar; null for other sources.
std::shared_ptr<const SimulatedPings> pingsOf(const Source &source);

/// What is said of a recording: what opening it found, and samples that are not finite, for which those of float
/// recordings are read, as far as that takes seconds.
std::vector<std::string> notesOf(const Recording &recording);

/// Says something on standard error: "note: PATH: WORDS".
void tellNote(const std::string &note, const Common &common);

/// Says what was guessed of recorded pings, if anything was.
void tellGuess(const NormalisedFrames &frames, const std::string &path, const Common &common);

/// Options for input and output files. Every file that a command reads or writes must be declared with them, because
/// only then is an output that is an input refused, and is an output redirected by a replay, which may run untrusted
/// commands.
CLI::Option *addInput(CLI::App &command, Common &common, const std::string &name, std::string &path,
                      const std::string &description);
CLI::Option *addInput(CLI::App &command, Common &common, const std::string &name, std::vector<std::string> &paths,
                      const std::string &description);
CLI::Option *addOutput(CLI::App &command, Common &common, const std::string &name, std::string &path,
                       const std::string &description);

/// Parses "2/8", counted from 0 or from 1, depending on the job scheduler; 0 and N denote the same shard. Throws Error.
Shard shardFrom(const std::string &text);

/// Throws if two outputs are one file, whatever their spelling, or one would replace what is written with another. Empty
/// names are ignored.
void checkDifferent(const std::vector<std::string> &outputs);
/// The same, and throws if one cannot be written, before a computation whose result would be lost.
void checkOutputs(const std::vector<std::string> &paths);

} // namespace faintline::cli
