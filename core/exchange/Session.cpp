#include "exchange/Session.h"

#include "base/files/AtomicFile.h"
#include "base/files/InputFiles.h"
#include "base/files/fileName.h"
#include "base/json.h"
#include "base/wholeNumber.h"
#include "exchange/survey/findRecordings.h"
#include "signal/Timeline.h"
#include "signal/formats/SigmfRecording.h"
#include "signal/openFields.h"

#include <filesystem>
#include <functional>

namespace faintline {

namespace fs = std::filesystem;

namespace {

    constexpr int formatVersion = 1;

    Json toJson(const Source::Injection &injection)
    {
        return {{"line", writeFields(injection.line.line, LineSettings::fields())},
                {"amplitude", injection.line.amplitude},
                {"channel", injection.channel},
                {"seed", injection.seed}};
    }

    Source::Injection injectionFromJson(const Json &json, const std::string &where)
    {
        checkKeys(json, where, {"line", "amplitude", "channel", "seed"});
        Source::Injection injection;
        readFields(json.at("line"), LineSettings::fields(), injection.line.line, where + ".line");
        injection.line.amplitude = json.at("amplitude").get<double>();
        injection.channel = wholeNumber(json, where, "channel", 0);
        injection.seed = wholeNumber(json, where, "seed", std::uint64_t(1));
        return injection;
    }

    Json toJson(const std::vector<Source::Injection> &injections)
    {
        Json list = Json::array();
        for (const Source::Injection &injection : injections)
            list.push_back(toJson(injection));
        return list;
    }

    Json toJson(const Source &source, const std::string &hash, const fs::path &folder)
    {
        Json json;
        if (source.isSimulated()) {
            json = {{"name", textFromFileName(fs::path(source.path).filename().string())},
                    {"scenario", source.pings ? toJson(*source.pings) : toJson(*source.scene)}};
        } else {
            const fs::path path = fs::absolute(source.path).lexically_normal();
            json = {{"path", textFromFileName(path.lexically_relative(folder.lexically_normal()).string())},
                    {"sha256", hash}};
            json.update(toJson(source.options));
        }
        if (!source.injections.empty())
            json["injected"] = toJson(source.injections);
        return json;
    }

    std::string folderOf(const std::string &path)
    {
        return fs::absolute(path).lexically_normal().parent_path().string();
    }

    Session sessionFromJson(const Json &json, const std::string &path)
    {
        checkKeys(json, "", {"faintline", "recording", "settings", "view", "annotations", "numbers"});
        if (json.value("faintline", Json()) != formatVersion)
            throw Error("faintline",
                        "must be " + std::to_string(formatVersion) + ", the version of the format this program reads");
        if (!json.contains("recording"))
            throw Error("recording", "is missing");
        Session session;
        session.source = sourceFromJson(json["recording"], folderOf(path));
        session.recordingHash = json["recording"].value("sha256", std::string());
        if (json.contains("settings"))
            session.settings = settingsFromJson(json["settings"].dump(), "settings");
        if (json.contains("view"))
            session.view = json["view"];
        if (json.contains("annotations"))
            session.annotations = annotationsFromJson(json["annotations"], "annotations");
        if (json.contains("numbers"))
            session.numbers = SignalNumbers::fromJson(json["numbers"], "numbers");
        return session;
    }

    void append(std::vector<std::string> &files, const std::function<std::vector<std::string>()> &find)
    {
        try {
            const std::vector<std::string> found = find();
            files.insert(files.end(), found.begin(), found.end());
        } catch (const Error &) { // opening it says so
        }
    }

    /// The recordings that a name denotes: itself, or those of a folder or a list.
    std::vector<std::string> recordingsNamed(const std::string &name)
    {
        std::vector<std::string> files;
        std::vector<std::string> unreadable;
        if (Timeline::isNamedSo(name))
            append(files, [&] { return Timeline::filesOf({name}); });
        if (std::error_code ignored; fs::is_directory(name, ignored))
            for (const bool isRaw : {false, true})
                append(files, [&] { return findRecordings({name}, isRaw, unreadable); });
        files.push_back(name);
        return files;
    }

} // namespace

std::vector<std::string> filesReadFor(const std::string &name)
{
    if (name.empty())
        return {};
    std::vector<std::string> files{name == "-" ? "/dev/stdin" : name};
    std::vector<std::string> names = recordingsNamed(name);
    if (isSessionPath(name))
        append(names, [&] { return recordingsNamed(readSession(name).source.path); });
    for (const std::string &recording : names) {
        append(files, [&] { return filesBehind({recording}); });
        files.insert(files.end(), {recording, truthPathOf(recording), gridPathOf(recording)});
    }
    return files;
}

std::vector<std::string> filesWrittenFor(const std::string &result)
{
    std::vector<std::string> files{result, result + ".provenance.json"};
    const std::string stem = result.substr(0, result.rfind('.'));
    if (SigmfRecording::isNamedSo(result))
        files.insert(files.end(), {stem + ".sigmf-meta", stem + ".sigmf-data"});
    if (hasEnding(result, ".npy"))
        files.push_back(gridPathOf(result));
    return files;
}

void checkReplacesNoInput(const std::string &result)
{
    for (const std::string &file : filesWrittenFor(result))
        InputFiles::refuse(file);
}

bool isSessionPath(const std::string &path)
{
    return hasEnding(path, ".faintline");
}

Session sessionOf(const Json &json, const std::string &path)
{
    try {
        return sessionFromJson(json, path);
    } catch (const Error &error) {
        throw error.in(path);
    } catch (const Json::exception &error) {
        throw Error(path, "is not a Faintline session: " + complaint(error));
    }
}

Session readSession(const std::string &path)
{
    return sessionOf(readJsonFile(path), path);
}

Source sourceFromJson(const Json &recording, const std::string &folder)
{
    Source source;
    source.options = openOptionsFromJson(recording, "recording", {"name", "scenario", "path", "sha256", "injected"});
    if (recording.contains("scenario")) {
        const std::string name = recording.value("name", std::string("scenario"));
        source = sourceOfScene(recording["scenario"], fileNameFromText(name));
    } else {
        const std::string path = fileNameFromText(recording.at("path").get<std::string>());
        source.path = (fs::path(folder) / path).lexically_normal().string();
    }
    if (recording.contains("injected"))
        for (const Json &one : recording["injected"])
            source.injections.push_back(
                injectionFromJson(one, "recording.injected[" + std::to_string(source.injections.size()) + "]"));
    return source;
}

std::string sessionText(const Session &session, const std::string &folder)
{
    Json json = {{"faintline", formatVersion},
                 {"recording", toJson(session.source, session.recordingHash, fs::current_path() / folder)},
                 {"settings", Json::parse(settingsToJson(session.settings))},
                 {"view", session.view}};
    if (!session.annotations.isEmpty())
        json["annotations"] = toJson(session.annotations);
    if (!session.numbers.areUsual())
        json["numbers"] = toJson(session.numbers);
    return json.dump(2) + "\n";
}

void writeSession(const std::string &path, Session session)
{
    if (!session.source.isSimulated() && session.recordingHash.empty())
        session.recordingHash = recordingHash(session.source.path);
    writeTextFile(path, sessionText(session, folderOf(path)), Durability::Machine, Written::Document);
}

std::string recordingMismatch(const Session &session)
{
    if (session.recordingHash.empty() || recordingHash(session.source.path) == session.recordingHash)
        return {};
    return "it has changed since the session was saved; results may differ";
}

} // namespace faintline
