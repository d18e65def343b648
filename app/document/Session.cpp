#include "app/document/Session.h"

#include "app/base/filePath.h"
#include "base/AtomicFile.h"
#include "base/readingJson.h"
#include "base/wholeNumber.h"

#include <QDir>
#include <QFileInfo>

namespace faintline {

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

    Json toJson(const Source &source, const std::string &hash, const QDir &folder)
    {
        if (source.isSimulated()) {
            Json scene = {{"name", QFileInfo(source.path).fileName().toStdString()},
                          {"scenario", source.pings ? toJson(*source.pings) : toJson(*source.scene)}};
            if (!source.injections.empty())
                scene["injected"] = toJson(source.injections);
            return scene;
        }
        const OpenOptions &options = source.options;
        const QString path = absolutePath(source.path);
        Json json = {{"path", folder.relativeFilePath(path).toStdString()}, {"sha256", hash}};
        if (options.iq)
            json["iq"] = true;
        if (!options.rawType.empty()) {
            json["rawType"] = options.rawType;
            json["rawRateHz"] = options.rawRateHz;
            json["rawChannels"] = options.rawChannels;
            json["rawHeaderBytes"] = options.rawHeaderBytes;
        }
        if (!source.injections.empty())
            json["injected"] = toJson(source.injections);
        return json;
    }

    Source sourceFromJson(const Json &json, const QDir &folder)
    {
        checkKeys(json, "recording",
                  {"name", "scenario", "path", "sha256", "iq", "rawType", "rawRateHz", "rawChannels", "rawHeaderBytes",
                   "injected"});
        Source source;
        if (json.contains("injected"))
            for (const Json &one : json["injected"])
                source.injections.push_back(
                    injectionFromJson(one, "recording.injected[" + std::to_string(source.injections.size()) + "]"));
        if (json.contains("scenario")) {
            source.path = QString::fromStdString(json.value("name", std::string("scenario")));
            if (isPingScene(json["scenario"]))
                source.pings = pingSceneFromJson(json["scenario"]);
            else
                source.scene = lineSceneFromJson(json["scenario"]);
            return source;
        }
        source.path =
            QDir::cleanPath(folder.absoluteFilePath(QString::fromStdString(json.at("path").get<std::string>())));
        source.options.iq = json.value("iq", false);
        source.options.rawType = json.value("rawType", std::string());
        source.options.rawRateHz = json.value("rawRateHz", 0.0);
        source.options.rawChannels = wholeNumber(json, "recording", "rawChannels", 1);
        source.options.rawHeaderBytes = wholeNumber(json, "recording", "rawHeaderBytes", Index(0));
        return source;
    }

    Json toJson(const Span &span)
    {
        return {span.low, span.high};
    }

    Span spanFromJson(const Json &json)
    {
        return {json.at(0).get<double>(), json.at(1).get<double>()};
    }

    ViewState viewFromJson(const Json &json)
    {
        checkKeys(json, "view",
                  {"seconds", "hz", "cursor", "orientation", "colourMap", "logarithmic", "radio", "bearing",
                   "cursorBearing", "polar"});
        ViewState view;
        if (json.contains("seconds") && json.contains("hz"))
            view.visible = {spanFromJson(json["seconds"]), spanFromJson(json["hz"])};
        if (json.contains("cursor"))
            view.cursor = {json["cursor"].at(0).get<double>(), json["cursor"].at(1).get<double>()};
        if (json.contains("bearing"))
            view.bearing = spanFromJson(json["bearing"]);
        if (json.contains("cursorBearing"))
            view.cursorBearing = json["cursorBearing"].get<double>();
        view.isPolar = json.value("polar", false);
        view.orientation = QString::fromStdString(json.value("orientation", std::string()));
        view.colourMap = QString::fromStdString(json.value("colourMap", std::string()));
        view.isLogarithmic = json.value("logarithmic", false);
        view.isRadioAxis = json.value("radio", false);
        return view;
    }

    QDir folderOf(const QString &path)
    {
        return QFileInfo(absolutePath(path)).dir();
    }

    Session sessionFromJson(const Json &json, const QString &path)
    {
        checkKeys(json, "", {"faintline", "recording", "settings", "view", "annotations"});
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
            session.view = viewFromJson(json["view"]);
        if (json.contains("annotations"))
            session.annotations = annotationsFromJson(json["annotations"], "annotations");
        return session;
    }

} // namespace

Json toJson(const ViewState &view)
{
    Json json = Json::object();
    if (view.visible) {
        json["seconds"] = toJson(view.visible->time);
        json["hz"] = toJson(view.visible->frequency);
    }
    if (view.cursor)
        json["cursor"] = {view.cursor->seconds, view.cursor->hz};
    if (view.bearing)
        json["bearing"] = toJson(*view.bearing);
    if (view.cursorBearing)
        json["cursorBearing"] = *view.cursorBearing;
    if (view.isPolar)
        json["polar"] = true;
    json["orientation"] = view.orientation.toStdString();
    json["colourMap"] = view.colourMap.toStdString();
    if (view.isLogarithmic)
        json["logarithmic"] = true;
    if (view.isRadioAxis)
        json["radio"] = true;
    return json;
}

bool isSessionPath(const QString &path)
{
    return path.endsWith(QLatin1String(".faintline"), Qt::CaseInsensitive);
}

Session readSession(const QString &path)
{
    const std::string where = pathBytes(path);
    const Json json = readJsonFile(where);
    try {
        return sessionFromJson(json, path);
    } catch (const Error &error) {
        throw error.in(where);
    } catch (const Json::exception &error) {
        throw Error(where, "is not a Faintline session: " + complaint(error));
    }
}

std::string sessionText(const Session &session, const QString &folder)
{
    Json json = {{"faintline", formatVersion},
                 {"recording", toJson(session.source, session.recordingHash, QDir(folder))},
                 {"settings", Json::parse(settingsToJson(session.settings))},
                 {"view", toJson(session.view)}};
    if (!session.annotations.isEmpty())
        json["annotations"] = toJson(session.annotations);
    return json.dump(2) + "\n";
}

void writeSession(const QString &path, Session session)
{
    if (!session.source.isSimulated() && session.recordingHash.empty())
        session.recordingHash = recordingHash(pathBytes(session.source.path));
    writeTextFile(pathBytes(path), sessionText(session, folderOf(path).path()));
}

QString recordingMismatch(const Session &session)
{
    if (session.recordingHash.empty() || recordingHash(pathBytes(session.source.path)) == session.recordingHash)
        return {};
    return QStringLiteral("it has changed since the session was saved; results may differ");
}

} // namespace faintline
