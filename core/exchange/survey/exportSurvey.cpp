#include "exchange/survey/exportSurvey.h"

#include "base/Error.h"
#include "base/Field.h"
#include "base/files/AtomicFile.h"
#include "base/files/fileName.h"
#include "base/json.h"
#include "base/oneLine.h"
#include "base/utc.h"
#include "exchange/csvText.h"
#include "exchange/reviewedText.h"
#include "exchange/survey/surveySchema.h"
#include "signal/openRecording.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <map>
#include <sstream>
#include <string_view>
#include <vector>

#include <sys/stat.h>

namespace faintline {

namespace fs = std::filesystem;

namespace {

    /// Each number after a comma; unknown ones are empty.
    template <class Numbers = std::initializer_list<double>>
    std::string cells(const Numbers &numbers)
    {
        std::string text;
        for (const double number : numbers)
            text += ',' + (std::isnan(number) ? std::string() : formatNumber(number));
        return text;
    }

    std::string row(const SurveyEvent &one, const SurveyRecording &recording)
    {
        const Event &e = one.event;
        return (recording.startUnixSeconds ? formatUtc(*recording.startUnixSeconds + e.onsetSeconds) : std::string())
               + ","
               + csvLine(surveyEventColumns(),
                         [&](const TableColumn<Event> &column) {
                             const CellValue value = column.value(e);
                             const double *number = std::get_if<double>(&value);
                             return number && std::isnan(*number) ? std::string() : cellText(value);
                         })
               + cells({one.box.lowHz.value_or(NAN), one.box.highHz.value_or(NAN)}) + "," + nameOf(one.box.verdict)
               + "," + csvText(oneLine(one.box.note)) + "\n";
    }

    /// Properties of a recording's file, if it is still there, and those that the survey keeps.
    RecordingInfo infoOf(const SurveyRecording &recording)
    {
        RecordingInfo info;
        try {
            info = openRecording(recording.file.path)->info();
        } catch (const Error &) { // the survey remains usable without its recordings
        }
        if (info.sampleRateHz != *recording.sampleRateHz)
            info = {};
        info.sampleRateHz = *recording.sampleRateHz;
        info.centreHz = recording.centreHz.value_or(0.0);
        info.startUnixSeconds = recording.startUnixSeconds;
        if (info.centreHz != 0.0 && !info.isComplex) { // opened as I and Q
            info.isComplex = true;
            info.channelCount /= 2;
        }
        return info;
    }

    std::string listText(const std::vector<SurveyEvent> &events, const SurveyRecording &recording, SurveyList list)
    {
        std::vector<ReviewedRow> rows;
        for (const SurveyEvent &one : events) {
            rows.push_back({&one.event, one.event.id, one.box});
            rows.back().box.note = oneLine(one.box.note);
        }
        if (list == SurveyList::Raven)
            return ravenText(rows);
        if (list == SurveyList::Audacity)
            return audacityText(rows);
        if (!recording.sampleRateHz)
            throw Error(recording.file.path, "contains frames; SigMF annotations require samples");
        return sigmfText(rows, infoOf(recording));
    }

    const std::string standard = "https://raw.githubusercontent.com/tdwg/camtrap-dp/1.0.2/";

    // Columns of the tables, in the order of their schemas.
    constexpr std::string_view deploymentColumns =
        "deploymentID,locationID,locationName,latitude,longitude,coordinateUncertainty,deploymentStart,deploymentEnd,"
        "setupBy,cameraID,cameraModel,cameraDelay,cameraHeight,cameraDepth,cameraTilt,cameraHeading,detectionDistance,"
        "timestampIssues,baitUse,featureType,habitat,deploymentGroups,deploymentTags,deploymentComments";
    constexpr std::string_view mediaColumns =
        "mediaID,deploymentID,captureMethod,timestamp,filePath,filePublic,fileName,"
        "fileMediatype,exifData,favorite,mediaComments";
    constexpr std::string_view observationColumns =
        "observationID,deploymentID,mediaID,eventID,eventStart,eventEnd,observationLevel,observationType,"
        "cameraSetupType,scientificName,count,lifeStage,sex,behavior,individualID,individualPositionRadius,"
        "individualPositionAngle,individualSpeed,bboxX,bboxY,bboxWidth,bboxHeight,classificationMethod,classifiedBy,"
        "classificationTimestamp,classificationProbability,observationTags,observationComments";

    /// A table of the standard as a file; columns that are not set stay empty.
    class Table
    {
    public:
        /// `columns`: their names, separated by commas.
        Table(const std::string &path, std::string_view columns) : m_columns(columns), m_file(path)
        {
            m_file.write(m_columns + "\n");
        }

        void add(const std::map<std::string, std::string> &values)
        {
            std::string row;
            std::istringstream columns(m_columns);
            for (std::string column; std::getline(columns, column, ',');)
                row += (values.contains(column) ? csvText(values.at(column)) : std::string()) + ',';
            row.back() = '\n';
            m_file.write(row);
        }

        void commit() { m_file.commit(); }

    private:
        std::string m_columns;
        AtomicFile m_file;
    };

    /// A recording and its names in the package.
    struct Medium {
        SurveyRecording recording;
        std::string path;
        std::string deployment;
        double start = 0.0;
        double end = 0.0;
    };

    struct DeploymentTime {
        double start = std::numeric_limits<double>::infinity();
        double end = -std::numeric_limits<double>::infinity();
    };

    /// The standard requires whole seconds.
    std::string wholeSeconds(double unixSeconds)
    {
        return formatUtc(std::floor(unixSeconds));
    }

    std::string dateOf(double unixSeconds)
    {
        return formatUtc(unixSeconds).substr(0, 10);
    }

    std::vector<Medium> mediaOf(SurveyDatabase &survey, const CamtrapPlace &place)
    {
        std::vector<Medium> media;
        for (SurveyRecording &recording : survey.recordings()) {
            if (!recording.isAnalysed())
                continue;
            const std::optional<double> start =
                recording.startUnixSeconds ? recording.startUnixSeconds : place.startUnixSeconds;
            if (!start || formatUtc(*start).empty())
                throw Error(recording.file.path, "has no start time, which Camtrap DP requires; give --start, such as "
                                                 "2024-07-26T00:00:00Z");
            Medium one;
            one.path = textFromFileName(pathBelow(recording.file.path, survey.path()));
            const std::string folder = fs::path(one.path).parent_path().string();
            one.deployment = folder.empty() ? "recordings" : folder;
            one.start = *start;
            one.end = *start + recording.durationSeconds.value_or(0.0);
            one.recording = std::move(recording);
            media.push_back(std::move(one));
        }
        if (media.empty())
            throw Error(survey.path(), "contains no analysed recordings");
        return media;
    }

    void writeDeployments(const std::string &path, const std::vector<Medium> &media, const CamtrapPlace &place)
    {
        Table table(path, deploymentColumns);
        std::map<std::string, DeploymentTime> stretches;
        for (const Medium &one : media) {
            DeploymentTime &stretch = stretches[one.deployment];
            stretch.start = std::min(stretch.start, one.start);
            stretch.end = std::max(stretch.end, one.end);
        }
        for (const auto &[name, stretch] : stretches)
            table.add({{"deploymentID", name},
                       {"latitude", formatNumber(place.latitude)},
                       {"longitude", formatNumber(place.longitude)},
                       {"deploymentStart", wholeSeconds(stretch.start)},
                       {"deploymentEnd", wholeSeconds(std::ceil(stretch.end))}});
        table.commit();
    }

    std::string mediatypeOf(const SurveyRecording &recording)
    {
        std::string type;
        for (const char c : recording.container)
            if (std::isalnum(static_cast<unsigned char>(c)))
                type += char(std::tolower(static_cast<unsigned char>(c)));
        return "audio/" + (type.empty() ? "basic" : type);
    }

    void writeMedia(const std::string &path, const std::vector<Medium> &media)
    {
        Table table(path, mediaColumns);
        for (const Medium &one : media)
            table.add({{"mediaID", one.path},
                       {"deploymentID", one.deployment},
                       {"timestamp", wholeSeconds(one.start)},
                       {"filePath", one.path},
                       {"filePublic", "false"},
                       {"fileName", fs::path(one.path).filename().string()},
                       {"fileMediatype", mediatypeOf(one.recording)}});
        table.commit();
    }

    std::string tagsOf(const SurveyEvent &one)
    {
        const auto tag = [](const std::string &name, double value) { return name + ":" + formatNumber(value); };
        const Event &e = one.event;
        return tag("f_low", one.box.lowHz.value_or(0.0)) + " | " + tag("f_high", one.box.highHz.value_or(0.0)) + " | "
               + tag("f", e.position.back()) + " | " + tag("drift_hz_per_s", e.driftPerSecond) + " | "
               + tag("statistic", e.statistic) + " | " + tag("t_onset", e.onsetSeconds) + " | "
               + tag("t_end", e.endSeconds);
    }

    void writeObservations(const std::string &path, SurveyDatabase &survey, const std::vector<Medium> &media)
    {
        Table table(path, observationColumns);
        for (const Medium &medium : media)
            for (const SurveyEvent &one : survey.events(medium.recording.id)) {
                const Verdict verdict = one.box.verdict;
                const std::string id = medium.path + "#" + std::to_string(one.event.id);
                table.add({{"observationID", id},
                           {"deploymentID", medium.deployment},
                           {"mediaID", medium.path},
                           {"eventID", id},
                           {"eventStart", wholeSeconds(medium.start + one.event.onsetSeconds)},
                           {"eventEnd", wholeSeconds(medium.start + one.event.endSeconds)},
                           {"observationLevel", "media"},
                           {"observationType", verdict == Verdict::Accepted   ? "unknown"
                                               : verdict == Verdict::Rejected ? "blank"
                                                                              : "unclassified"},
                           {"classificationMethod", verdict == Verdict::None ? "machine" : "human"},
                           {"classifiedBy", verdict == Verdict::None ? "Faintline " + survey.origin().version : ""},
                           {"observationTags", tagsOf(one)},
                           {"observationComments", oneLine(one.box.note)}});
            }
        table.commit();
    }

    std::string package(const SurveyDatabase &survey, const std::vector<Medium> &media, const CamtrapPlace &place)
    {
        DeploymentTime whole;
        for (const Medium &one : media) {
            whole.start = std::min(whole.start, one.start);
            whole.end = std::max(whole.end, one.end);
        }
        struct stat status = {};
        ::stat(survey.path().c_str(), &status);
        Json json;
        json["resources"] = Json::array();
        for (const char *name : {"deployments", "media", "observations"})
            json["resources"].push_back({{"name", name},
                                         {"path", std::string(name) + ".csv"},
                                         {"profile", "tabular-data-resource"},
                                         {"format", "csv"},
                                         {"mediatype", "text/csv"},
                                         {"encoding", "utf-8"},
                                         {"schema", standard + name + "-table-schema.json"}});
        json["profile"] = standard + "camtrap-dp-profile.json";
        json["created"] = formatUtc(double(status.st_mtim.tv_sec)); // date of the survey, to which the export adds
                                                                    // nothing
        json["title"] = "Survey of recordings by Faintline " + survey.origin().version;
        json["contributors"] = Json::array({{{"title", "Faintline " + survey.origin().version}}});
        json["project"] = {{"title", "Survey of recordings"},
                           {"samplingDesign", "opportunistic"},
                           {"captureMethod", {"timeLapse"}},
                           {"individualAnimals", false},
                           {"observationLevel", {"media"}}};
        json["spatial"] = {{"type", "Point"}, {"coordinates", {place.longitude, place.latitude}}};
        json["temporal"] = {{"start", dateOf(whole.start)}, {"end", dateOf(whole.end)}};
        json["taxonomic"] = Json::array();
        return json.dump(2) + "\n";
    }

} // namespace

std::string pathBelow(const std::string &recording, const std::string &database)
{
    fs::path below;
    for (const fs::path &part : fs::path(fileNameFromText(storedPath(recording, database))).relative_path())
        if (part != ".." && part != ".")
            below /= part;
    return below.string();
}

void exportEvents(SurveyDatabase &survey, const std::string &path)
{
    AtomicFile file(path);
    file.write("recording,utc_onset," + csvNames(surveyEventColumns()) + ",f_low,f_high,review,note\n");
    for (const SurveyRecording &recording : survey.recordings()) {
        std::string text;
        for (const SurveyEvent &event : survey.events(recording.id))
            text += csvText(oneLine(storedPath(recording.file.path, survey.path()))) + "," + row(event, recording);
        file.write(text);
    }
    file.commit();
}

void exportTracks(SurveyDatabase &survey, const std::string &path)
{
    AtomicFile file(path);
    file.write("recording,track," + csvNames(surveyTrackColumns()) + "\n");
    for (const SurveyRecording &recording : survey.recordings()) {
        const std::string name = csvText(oneLine(storedPath(recording.file.path, survey.path())));
        std::string text;
        for (const SurveyPoint &p : survey.points(recording.id))
            text += name + "," + std::to_string(p.track) + cells(p.values) + "\n";
        file.write(text);
    }
    file.commit();
}

void exportStoneSoup(SurveyDatabase &survey, const std::string &path, std::optional<double> startUnixSeconds)
{
    const std::int64_t unknown = survey.connection().integer(
        "SELECT count(*) FROM recordings WHERE start_unix_s IS NULL AND id IN (SELECT recording FROM tracks)");
    if (unknown > 0 && !startUnixSeconds)
        throw Error(survey.path(), std::to_string(unknown)
                                       + " recording(s) have no start time, which Stone Soup requires; give "
                                         "--start, such as 2024-07-26T00:00:00Z");
    SqliteStatement point = survey.connection().prepare(
        "SELECT coalesce(start_unix_s, ?) + t AS time, f, recording || '-' || track, path, t, statistic, snr_db "
        "FROM tracks JOIN recordings ON recordings.id = recording ORDER BY time, recording, track, point");
    point.with(startUnixSeconds);
    AtomicFile file(path);
    file.write("time,frequency_hz,track,recording,t,statistic,snr_db\n");
    while (point.next())
        file.write(formatUtc(point.number(0)) + cells({point.number(1)}) + "," + point.text(2) + ","
                   + csvText(oneLine(point.text(3))) + cells({point.number(4), point.number(5), point.number(6)})
                   + "\n");
    file.commit();
}

void exportLists(SurveyDatabase &survey, SurveyList list, const std::string &folder)
{
    const std::string ending = list == SurveyList::Raven      ? ".selections.txt"
                               : list == SurveyList::Audacity ? ".txt"
                                                              : ".sigmf-meta";
    for (const SurveyRecording &recording : survey.recordings()) {
        const std::vector<SurveyEvent> events = survey.events(recording.id);
        if (events.empty())
            continue;
        const fs::path path = fs::path(folder) / (pathBelow(recording.file.path, survey.path()) + ending);
        std::error_code code;
        fs::create_directories(path.parent_path(), code);
        writeTextFile(path.string(), listText(events, recording, list));
    }
}

void exportCamtrap(SurveyDatabase &survey, const std::string &folder, const CamtrapPlace &place)
{
    const std::vector<Medium> media = mediaOf(survey, place);
    std::error_code code;
    fs::create_directories(folder, code);
    const auto in = [&](const char *name) { return (fs::path(folder) / name).string(); };
    CommitTogether files;
    writeDeployments(in("deployments.csv"), media, place);
    writeMedia(in("media.csv"), media);
    writeObservations(in("observations.csv"), survey, media);
    writeTextFile(in("datapackage.json"), package(survey, media, place));
    files.commit();
}

} // namespace faintline
