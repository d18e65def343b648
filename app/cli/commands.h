#pragma once

#include "app/cli/PartOptions.h"

#include "analysis/AnalysisSettings.h"
#include "base/Error.h"
#include "base/RunContext.h"
#include "base/Shard.h"
#include "recording/openRecording.h"
#include "spectrum/SimulatedPings.h"

#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace faintline::cli {

/// What every subcommand is given.
struct Common {
    std::stop_token stop;
    int threads = 2;
    std::string progress = "auto";
    std::vector<std::string> arguments; ///< of this run, for the provenance of what it writes
    bool keepsProvenance = true;
    /// What every path of a file to be read, and of one to be written, goes through before it is used; as they are
    /// where empty.
    std::function<std::string(const std::string &path)> read, written;

    /// Shows progress on standard error as asked for.
    RunContext context() const;
};

/// The options that name a recording and the settings of its analysis, alike in every subcommand.
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
    void addSettingsTo(CLI::App &command, Common &common); ///< all but the recording
    /// Further files of the recording, with --timeline.
    void addMoreTo(CLI::App &command, Common &common);
    void checkMore() const; ///< throws where there are some without it
    std::vector<std::string> names() const;
    AnalysisSettings settings() const;
    RecordingPointer recording() const;
    /// The frames of a file that is no recording: simulated pings, a stack (FILE.npy), power over time and frequency;
    /// null of others. Slopes in the settings become bins a frame.
    NormalisedFramesPointer frames(AnalysisSettings &settings, const RunContext &context) const;
    std::vector<std::string> inputs() const; ///< the files that it all comes from; a SigMF recording is two
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

/// Does what a command line asks for. Throws CLI::ParseError, Error, Cancelled.
void runCommandLine(const std::vector<std::string> &arguments, Common common);
void addBench(CLI::App &app, Common &common);

/// The simulated pings of a scene file whose kind is "pings"; nothing if the file is another.
std::shared_ptr<const SimulatedPings> openPings(const std::string &path);

/// Opens a recording file, or simulates one from a scene's JSON file.
RecordingPointer openAny(const std::string &path, const OpenOptions &options);

/// Options that name a file to be read, and one to be written. A file that a command makes has to be named by the
/// second: only then a replay, which runs what a stranger may have written, sends it elsewhere.
CLI::Option *addInput(CLI::App &command, Common &common, const std::string &name, std::string &path,
                      const std::string &description);
CLI::Option *addOutput(CLI::App &command, Common &common, const std::string &name, std::string &path,
                       const std::string &description);

/// "2/8": counted from 0 or from 1, whichever suits the job scheduler; 0 and N name the same. Throws Error.
Shard shardFrom(const std::string &text);

/// Throws where one of these files cannot be written, or is named twice, before anything is computed that would be
/// lost. Empty names are none.
void checkOutputs(const std::vector<std::string> &paths);

/// What `make` finds wrong in a file is said with the file's name before it.
template <class Make>
auto inFile(const std::string &path, const Make &make)
{
    try {
        return make();
    } catch (const Error &error) {
        throw error.in(path);
    }
}

} // namespace faintline::cli
