#include "app/cli/commands.h"
#include "app/cli/provenance.h"
#include "app/cli/windowExport.h"

#include "base/AtomicFile.h"
#include "base/Error.h"
#include "base/json.h"
#include "recording/fileHash.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

namespace faintline::cli {

namespace fs = std::filesystem;

namespace {

    const std::string suffix = ".provenance.json";

    struct Provenance {
        std::string version;
        fs::path folder;
        std::vector<std::string> arguments;
        std::vector<std::pair<std::string, std::string>> inputs; ///< name, hash
        std::vector<std::string> outputs;
    };

    Provenance readProvenance(const std::string &path)
    {
        const Json json = readJsonFile(path);
        try {
            Provenance provenance{json.at("faintline"), json.at("folder").get<std::string>(), json.at("arguments"), {}, json.at("outputs")};
            for (const Json &input : json.at("inputs"))
                provenance.inputs.emplace_back(input.at("file"), input.at("hash"));
            // What was not written by one of these might do anything, or call itself.
            const auto is = [&](const char *command) {
                return std::find(provenance.arguments.begin(), provenance.arguments.end(), command) != provenance.arguments.end();
            };
            if (provenance.outputs.empty() || is("replay") || !(is("detect") || is("compare") || is("simulate") || is("inject")))
                throw Error(path, "is no provenance of something that detect, compare, simulate or inject wrote");
            return provenance;
        } catch (const Json::exception &) {
            throw Error(path, "is no provenance: it needs faintline, folder, arguments, inputs and outputs");
        }
    }

    /// A folder that goes with everything in it.
    class TemporaryFolder
    {
    public:
        TemporaryFolder()
        {
            std::string name = (fs::temp_directory_path() / "faintline-replay-XXXXXX").string();
            if (!mkdtemp(name.data()))
                throw Error(name, "cannot be made", Error::Kind::Failure);
            m_path = name;
        }
        ~TemporaryFolder()
        {
            std::error_code ignored;
            fs::remove_all(m_path, ignored);
        }
        TemporaryFolder(const TemporaryFolder &) = delete;
        TemporaryFolder &operator=(const TemporaryFolder &) = delete;
        const fs::path &path() const { return m_path; }

    private:
        fs::path m_path;
    };

    bool sameBytes(const fs::path &a, const fs::path &b)
    {
        std::ifstream first(a, std::ios::binary);
        std::ifstream second(b, std::ios::binary);
        if (!first || !second)
            return false;
        return std::equal(std::istreambuf_iterator<char>(first), {}, std::istreambuf_iterator<char>(second), {});
    }

    /// Whether it is; says so.
    bool compare(const fs::path &kept, const fs::path &remade)
    {
        const bool isSame = sameBytes(kept, remade);
        std::printf("%s: %s\n", kept.filename().c_str(), isSame ? "the same bytes" : "differs");
        return isSame;
    }

    void replayWindowExport(const Json &json, const fs::path &kept, const std::string &recording, const Common &common)
    {
        const std::string version = json.value("version", std::string());
        if (version != FAINTLINE_VERSION)
            std::printf("made with version %s, this is %s\n", version.c_str(), FAINTLINE_VERSION);
        const TemporaryFolder folder;
        const fs::path remade = folder.path() / kept.filename();
        remakeWindowExport(json, kept.string(), recording, remade.string(), common.context());
        if (!compare(kept, remade))
            throw Error(kept.string(), "is not what its provenance makes", Error::Kind::Failure);
    }

    bool isPicture(const std::string &name)
    {
        return name.ends_with(".png") || name.ends_with(".svg") || name.ends_with(".pdf") || name.ends_with(".html");
    }

    void replay(const std::string &result, const std::string &recording, const Common &common)
    {
        const fs::path asked = fs::absolute(result);
        const fs::path path = fs::absolute(result.ends_with(suffix) ? result : result + suffix);
        if (!fs::exists(path) && isPicture(result))
            throw Error(result,
                        "is a picture, which the window's program makes: 'faintline replay' takes a PNG that 'faintline render' wrote");
        if (!fs::exists(path))
            throw Error(result, "has no provenance: there is no " + path.filename().string() + " beside it");
        if (const Json json = readJsonFile(path.string()); isOfWindow(json)) {
            const std::string kept = path.string().substr(0, path.string().size() - suffix.size());
            return replayWindowExport(json, kept, recording, common);
        }
        if (!recording.empty())
            throw Error("--recording", "is for what the window exported; " + result + " was written by a command, which names its own");
        const Provenance provenance = readProvenance(path.string());
        if (provenance.version != FAINTLINE_VERSION)
            std::printf("made with version %s, this is %s\n", provenance.version.c_str(), FAINTLINE_VERSION);
        // Where the results are now, in the order in which they were named.
        const TemporaryFolder folder;
        std::vector<fs::path> kept;
        std::vector<fs::path> remade;
        std::vector<std::string> arguments = provenance.arguments;
        std::erase(arguments, "--summary"); // what is said here is about the files
        for (const std::string &output : provenance.outputs) {
            kept.push_back(path.parent_path() / fs::path(output).filename());
            remade.push_back(folder.path() / (std::to_string(remade.size()) + "-" + fs::path(output).filename().string()));
            bool isNamed = false;
            for (std::string &argument : arguments) {
                const bool isOption = argument.starts_with("--") && argument.ends_with("=" + output);
                if (argument != output && !isOption)
                    continue;
                argument = argument.substr(0, argument.size() - output.size()) + remade.back().string();
                isNamed = true;
            }
            if (!isNamed)
                throw Error(path.string(), "tells of " + output + ", which its own command line does not name");
        }
        if (!fs::is_directory(provenance.folder))
            throw Error(provenance.folder.string(), "is the folder it was made in, and is not there any more");
        fs::current_path(provenance.folder);
        for (const auto &[file, hash] : provenance.inputs)
            if (!fs::exists(file) || fileHash(file) != hash)
                throw Error(file, "is not what " + result + " was made from");
        Common quiet = common;
        quiet.keepsProvenance = false;
        runCommandLine(arguments, quiet);
        std::string different;
        for (std::size_t i = 0; i < kept.size(); ++i) {
            if (!fs::exists(kept[i]) && kept[i] != asked)
                continue; // another file of the same run, kept elsewhere
            if (!compare(kept[i], remade[i]) && different.empty())
                different = kept[i].string();
        }
        if (!different.empty())
            throw Error(different, "is not what its provenance makes", Error::Kind::Failure);
    }

} // namespace

void writeProvenance(const Common &common, const std::vector<std::string> &inputs, const std::vector<std::string> &outputs)
{
    const auto isLost = [](const std::string &input) { return !input.empty() && !fs::is_regular_file(input); };
    if (!common.keepsProvenance || std::any_of(inputs.begin(), inputs.end(), isLost)) // what came through a pipe is not there again
        return;
    Json json = {{"faintline", FAINTLINE_VERSION}, {"folder", fs::current_path().string()}, {"arguments", common.arguments}};
    json["inputs"] = Json::array();
    for (const std::string &input : inputs)
        if (!input.empty())
            json["inputs"].push_back({{"file", input}, {"hash", fileHash(input)}});
    json["outputs"] = Json::array();
    for (const std::string &output : outputs)
        if (!output.empty() && fs::is_regular_file(output)) // nothing is kept beside /dev/null
            json["outputs"].push_back(output);
    for (const Json &output : json["outputs"])
        writeTextFile(output.get<std::string>() + suffix, json.dump(2) + "\n");
}

void addReplay(CLI::App &app, Common &common)
{
    const auto result = std::make_shared<std::string>();
    const auto recording = std::make_shared<std::string>();
    CLI::App *command = app.add_subcommand("replay", "Make a result again from its own provenance, and compare");
    command
        ->add_option("RESULT", *result,
                     "A file written by detect, compare, simulate or inject, or a table exported from the window, with its "
                     ".provenance.json beside it")
        ->required();
    command->add_option("--recording", *recording, "Of a table exported from the window: the recording, if it is not beside it");
    command->callback([result, recording, &common] { replay(*result, *recording, common); });
}

} // namespace faintline::cli
