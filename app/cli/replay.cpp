#include "app/cli/commands.h"
#include "app/cli/provenance.h"
#include "app/cli/readProvenance.h"
#include "app/cli/windowExport.h"

#include "base/Error.h"
#include "base/files/AtomicFile.h"
#include "base/files/fileName.h"
#include "base/files/temporaries.h"
#include "base/json.h"
#include "base/oneLine.h"
#include "calibrate/CalibrationStore.h"
#include "signal/Timeline.h"
#include "signal/fileHash.h"
#include "signal/formats/SigmfRecording.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>

namespace faintline::cli {

namespace fs = std::filesystem;

namespace {

    const std::string suffix = ".provenance.json";

    Json textsFrom(const std::vector<std::string> &names)
    {
        Json texts = Json::array();
        for (const std::string &name : names)
            texts.push_back(textFromFileName(name));
        return texts;
    }

    /// A folder that is removed with its contents.
    class TemporaryFolder
    {
    public:
        TemporaryFolder()
        {
            makeTemporary([this] {
                std::string name = (fs::temp_directory_path() / "faintline-replay-XXXXXX").string();
                if (!mkdtemp(name.data()))
                    throw Error(name, "cannot be created", Error::Kind::Failure);
                m_path = name;
                return name;
            });
        }
        ~TemporaryFolder()
        {
            std::error_code ignored;
            fs::remove_all(m_path, ignored);
            forgetTemporary(m_path.string());
        }
        TemporaryFolder(const TemporaryFolder &) = delete;
        TemporaryFolder &operator=(const TemporaryFolder &) = delete;
        const fs::path &path() const { return m_path; }

    private:
        fs::path m_path;
    };

    /// Folders that replay may read: the result's folder and those that the user allows. The author of a provenance
    /// record may name any file of this machine.
    class ReadableFolders
    {
    public:
        ReadableFolders(const fs::path &result, const std::vector<std::string> &allowed)
            : m_result(result.filename().string())
        {
            m_folders.push_back(fs::canonical(result.parent_path()));
            for (const std::string &folder : allowed) {
                std::error_code code;
                m_folders.push_back(fs::canonical(folder, code));
                if (code || !fs::is_directory(m_folders.back()))
                    throw Error("--allow " + folder, "no such folder");
            }
        }

        /// Throws if a path, with all links resolved, leads out of them.
        void check(const std::string &path) const
        {
            const fs::path real = fs::weakly_canonical(path);
            const auto holds = [&](const fs::path &folder) {
                return std::mismatch(folder.begin(), folder.end(), real.begin(), real.end()).first == folder.end();
            };
            if (std::none_of(m_folders.begin(), m_folders.end(), holds))
                throw Error(path, "lies outside the folder of " + m_result
                                      + ", which requires it; permit replay to "
                                        "read it with --allow FOLDER");
        }

    private:
        std::string m_result;
        std::vector<fs::path> m_folders;
    };

    /// Both files of a recording. Annotations of that name have no samples.
    void checkSigmf(const std::string &file, const ReadableFolders &readable)
    {
        if (!SigmfRecording::isNamedSo(file) || !fs::exists(file))
            return;
        readable.check(SigmfRecording::metaPath(file));
        std::string samples;
        try {
            samples = SigmfRecording::dataPath(file);
        } catch (const Error &) {
            return; // cannot be opened as a recording
        }
        readable.check(samples);
    }

    bool sameBytes(const fs::path &a, const fs::path &b)
    {
        std::ifstream first(a, std::ios::binary);
        std::ifstream second(b, std::ios::binary);
        if (!first || !second)
            return false;
        return std::equal(std::istreambuf_iterator<char>(first), {}, std::istreambuf_iterator<char>(second), {});
    }

    /// Prints and returns whether the files are identical.
    bool compare(const fs::path &kept, const fs::path &remade)
    {
        const bool isSame = sameBytes(kept, remade);
        std::printf("%s: %s\n", oneLine(kept.filename().string()).c_str(), isSame ? "the same bytes" : "differs");
        return isSame;
    }

    void tellVersion(const std::string &version)
    {
        if (version != FAINTLINE_VERSION)
            std::printf("made with version %s, this is %s\n", oneLine(version, 40).c_str(), FAINTLINE_VERSION);
    }

    void replayWindowExport(const Json &json, const fs::path &kept, const std::string &recording,
                            const ReadableFolders &readable, const Common &common)
    {
        tellVersion(json.value("version", std::string()));
        const TemporaryFolder folder;
        CalibrationStore::moveTo(folder.path() / "calibrations");
        const fs::path remade = folder.path() / kept.filename();
        const auto mayRead = [&](const std::string &path) {
            readable.check(path);
            checkSigmf(path, readable);
        };
        remake({json, kept.string(), recording, mayRead}, remade.string(), common.context());
        if (!compare(kept, remade))
            throw Error(kept.string(), "differs from the result of its provenance", Error::Kind::Failure);
    }

    bool isPicture(const std::string &name)
    {
        return name.ends_with(".png") || name.ends_with(".svg") || name.ends_with(".pdf") || name.ends_with(".html");
    }

    /// Every file that the provenance names among what went in, before anything is made of it.
    void checkInputs(const Provenance &provenance, const std::string &result, const ReadableFolders &readable)
    {
        for (const auto &[file, hash] : provenance.inputs) {
            readable.check(file);
            if (!fs::is_regular_file(file) || fileHash(file) != hash)
                throw Error(file, "is not the input of " + result);
        }
    }

    /// What a command line of somebody else's writes goes into a folder, each file into one of its own under its name.
    struct Redirection {
        fs::path folder;
        std::vector<fs::path> written;

        std::string operator()(const std::string &asked)
        {
            const fs::path own = folder / std::to_string(written.size());
            fs::create_directory(own);
            const fs::path name = fs::path(asked).filename();
            if (name.empty() || name == "." || name == "..")
                throw Error(asked, "is not the name of a file");
            written.push_back(own / name);
            return written.back().string();
        }
    };

    /// Whether all are the same that are beside the result still; `asked` has to be among them.
    void compareAll(const std::vector<fs::path> &written, const fs::path &folder, const fs::path &asked)
    {
        std::string different;
        bool isMade = false;
        for (const fs::path &one : written) {
            std::vector<fs::path> made; // with a recording of two files, and the grid of frames
            for (const fs::directory_entry &entry : fs::directory_iterator(one.parent_path()))
                made.push_back(entry.path());
            std::sort(made.begin(), made.end());
            for (const fs::path &remade : made) {
                const fs::path kept = folder / remade.filename();
                isMade = isMade || kept == asked;
                if (!fs::exists(kept) && kept != asked)
                    continue; // another file of the same run, kept elsewhere
                if (!compare(kept, remade) && different.empty())
                    different = kept.string();
            }
        }
        if (!isMade)
            throw Error(asked.string(), "is not an output of its provenance");
        if (!different.empty())
            throw Error(different, "differs from the result of its provenance", Error::Kind::Failure);
    }

    void runAgain(const std::vector<std::string> &arguments, const std::string &path, const Common &common)
    {
        try {
            runCommandLine(arguments, common);
        } catch (const CLI::ParseError &error) { // --help is one, too
            throw Error(path, std::string("contains an invalid command line: ") + error.what());
        }
    }

    void replay(const std::string &result, const std::string &recording, const std::vector<std::string> &allowed,
                const Common &common)
    {
        const fs::path path = fs::absolute(result.ends_with(suffix) ? result : result + suffix).lexically_normal();
        const fs::path asked = path.string().substr(0, path.string().size() - suffix.size());
        if (!fs::exists(path) && isPicture(result))
            throw Error(result, "is a picture; use 'faintline replay' for a PNG that 'faintline render' wrote");
        if (!fs::exists(path))
            throw Error(result, "has no provenance: no " + path.filename().string() + " was found beside it");
        const ReadableFolders readable(asked, allowed);
        if (const Json json = readJsonFile(path.string()); isOfWindow(json))
            return replayWindowExport(json, asked, recording, readable, common);
        if (!recording.empty())
            throw Error("--recording", "applies to tables exported from the window; " + result
                                           + " was written by a command, whose provenance names the recording");
        const Provenance provenance = readProvenance(path.string());
        tellVersion(provenance.version);
        std::vector<std::string> arguments = provenance.arguments;
        std::erase(arguments, "--summary"); // the output here is about the files
        for (const std::string &output : provenance.outputs) {
            const auto names = [&](const std::string &argument) {
                return argument == output || (argument.starts_with("--") && argument.ends_with("=" + output));
            };
            if (std::none_of(arguments.begin(), arguments.end(), names))
                throw Error(path.string(), "names the output " + output + ", which is not on its command line");
        }
        if (!fs::is_directory(provenance.folder))
            throw Error(provenance.folder.string(), "the folder in which the result was made no longer exists");
        fs::current_path(provenance.folder);
        checkInputs(provenance, result, readable);
        const TemporaryFolder folder;
        CalibrationStore::moveTo(folder.path() / "calibrations");
        const auto redirection = std::make_shared<Redirection>(Redirection{folder.path(), {}});
        Common confined = common;
        confined.keepsProvenance = false;
        confined.read = [&readable](const std::string &file) {
            readable.check(file);
            checkSigmf(file, readable);
            if (Timeline::isNamedSo(file))
                for (const std::string &part : filesBehind({file}))
                    readable.check(part);
            return file;
        };
        confined.written = [redirection](const std::string &file) { return (*redirection)(file); };
        runAgain(arguments, path.string(), confined);
        compareAll(redirection->written, path.parent_path(), asked);
    }

} // namespace

void writeProvenance(const Common &common, const std::vector<std::string> &inputs,
                     const std::vector<std::string> &outputs)
{
    const auto isLost = [](const std::string &input) { return !input.empty() && !fs::is_regular_file(input); };
    if (!common.keepsProvenance
        || std::any_of(inputs.begin(), inputs.end(), isLost)) // what came through a pipe is not there again
        return;
    Json json = {{"faintline", FAINTLINE_VERSION},
                 {"folder", textFromFileName(fs::current_path().string())},
                 {"arguments", textsFrom(fromCommandOn(common.arguments))}};
    json["inputs"] = Json::array();
    for (const std::string &input : inputs)
        if (!input.empty())
            json["inputs"].push_back({{"file", textFromFileName(input)}, {"hash", fileHash(input)}});
    std::vector<std::string> kept;
    for (const std::string &output : outputs)
        if (!output.empty() && (fs::is_regular_file(output) || !fs::exists(output))) // nothing is kept beside /dev/null
            kept.push_back(output);
    json["outputs"] = textsFrom(kept);
    for (const std::string &output : kept)
        writeTextFile(output + suffix, json.dump(2) + "\n");
}

void addReplay(CLI::App &app, Common &common)
{
    const auto result = std::make_shared<std::string>();
    const auto recording = std::make_shared<std::string>();
    const auto allowed = std::make_shared<std::vector<std::string>>();
    CLI::App *command = app.add_subcommand("replay", "Reproduce a result from its provenance and compare");
    command
        ->add_option(
            "RESULT", *result,
            "A file written by detect, compare, simulate, inject, straighten, doppler, evaluate or merge, or a "
            "table exported from the window, with its .provenance.json beside it")
        ->required();
    command->add_option("--recording", *recording,
                        "For a table exported from the window: the recording, if it is not "
                        "beside the table");
    command
        ->add_option("--allow", *allowed,
                     "Folder that may be read in addition to the one that contains RESULT; may "
                     "be repeated")
        ->take_all()
        ->allow_extra_args(false);
    command->callback([result, recording, allowed, &common] { replay(*result, *recording, *allowed, common); });
}

} // namespace faintline::cli
