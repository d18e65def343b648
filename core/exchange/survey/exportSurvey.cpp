#include "exchange/survey/exportSurvey.h"

#include "base/Error.h"
#include "base/Field.h"
#include "base/files/AtomicFile.h"
#include "base/files/fileName.h"
#include "base/oneLine.h"
#include "base/utc.h"
#include "exchange/csvText.h"
#include "exchange/reviewedText.h"
#include "signal/openRecording.h"

#include <cmath>
#include <filesystem>
#include <initializer_list>

namespace faintline {

namespace fs = std::filesystem;

namespace {

    /// Each number after a comma; unknown ones are empty.
    std::string cells(std::initializer_list<double> numbers)
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
               + "," + std::to_string(e.id)
               + cells({e.onsetSeconds, e.detectSeconds, e.endSeconds, e.position.back(), e.driftPerSecond, e.statistic,
                        e.isConfirmed ? 1.0 : 0.0, e.isOpen ? 1.0 : 0.0, e.snrDb, e.bandWidth, e.noiseProbability,
                        e.windowSeconds, one.box.lowHz.value_or(NAN), one.box.highHz.value_or(NAN)})
               + "," + nameOf(one.box.verdict) + "," + csvText(oneLine(one.box.note)) + "\n";
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
    file.write("recording,utc_onset,event,t_onset,t_detect,t_end,f,drift_hz_per_s,statistic,confirmed,open,snr_db,"
               "band_hz,noise_probability,window_s,f_low,f_high,review,note\n");
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
    file.write("recording,track,t,f,statistic,f_low,f_high,presence,snr_db\n");
    for (const SurveyRecording &recording : survey.recordings()) {
        const std::string name = csvText(oneLine(storedPath(recording.file.path, survey.path())));
        std::string text;
        for (const SurveyPoint &p : survey.points(recording.id))
            text += name + "," + std::to_string(p.track)
                    + cells({p.seconds, p.position, p.statistic, p.low, p.high, p.presence, p.snrDb}) + "\n";
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

} // namespace faintline
