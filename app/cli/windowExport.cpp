#include "app/cli/windowExport.h"

#include "analyse/analyse.h"
#include "base/files/fileName.h"
#include "base/json.h"
#include "exchange/CampaignFile.h"
#include "exchange/Session.h"
#include "exchange/writeDoppler.h"
#include "exchange/writeEvents.h"
#include "exchange/writeReviewed.h"
#include "inspect/SignalNumbers.h"
#include "inspect/straighten.h"
#include "signal/Timeline.h"
#include "signal/formats/writeRecording.h"
#include "signal/openRecording.h"

#include <filesystem>
#include <optional>

namespace faintline::cli {

namespace fs = std::filesystem;

namespace {

    /// The file that the provenance tells of by name and hash.
    std::string find(const Json &source, const WindowExport &table)
    {
        const std::string name = fs::path(fileNameFromText(source.at("path").get<std::string>())).filename().string();
        const bool isBeside = table.recording.empty();
        const std::string path = isBeside ? (fs::absolute(table.path).parent_path() / name).string() : table.recording;
        if (!fs::exists(path))
            throw Error(path, "the input of " + table.path + " was not found; give its path with --recording");
        if (isBeside)
            table.mayRead(path);
        if (isBeside && Timeline::isNamedSo(path))
            for (const std::string &file : filesBehind({path}))
                table.mayRead(file);
        if (recordingHash(path) != source.at("sha256").get<std::string>())
            throw Error(path, "is not the input of " + table.path);
        return path;
    }

    std::shared_ptr<const Analysis> analysed(const WindowExport &table, const RunContext &context)
    {
        const Json &recording = table.provenance.at("recording");
        Source source = sourceFromJson(recording, {});
        if (!source.isSimulated())
            source.path = find(recording, table);
        SignalNumbers numbers;
        if (table.provenance.contains("numbers"))
            numbers = SignalNumbers::fromJson(table.provenance["numbers"], "numbers");
        return numbers.number(analyse(
            openSource(source), settingsFromJson(table.provenance.at("settings").dump(), "settings"), {}, context));
    }

    void remakeEvents(const WindowExport &table, const std::string &out, const RunContext &context)
    {
        const Json &provenance = table.provenance;
        const bool isOfTracks = provenance.value("tracks", false);
        if (isOfTracks)
            checkTracksPath(out);
        else
            checkReviewedPath(out);
        const auto analysis = analysed(table, context);
        const Annotations annotations = provenance.contains("annotations")
                                            ? annotationsFromJson(provenance["annotations"], "annotations")
                                            : Annotations();
        std::vector<Event> shown = events(*analysis);
        if (provenance.contains("shownThreshold")) // it was being dragged
            std::erase_if(shown, [least = provenance["shownThreshold"].get<double>()](const Event &event) {
                return event.statistic < least;
            });
        if (isOfTracks)
            return writeTracksOf(shown, *analysis, out);
        writeReviewed(*analysis, shown, annotations, out);
    }

    void remakeDoppler(const WindowExport &table, const std::string &out, const RunContext &context)
    {
        const Json &made = table.provenance["doppler"];
        const auto analysis = analysed(table, context);
        std::vector<Event> chosen;
        for (const Json &number : made.at("events"))
            chosen.push_back(chosenEvent(*analysis, number.get<int>()));
        writeDoppler(dopplerReport(*analysis, std::move(chosen), made.at("centreHz"), made.at("propagation")), out);
    }

    /// Values that were left to the program are not in the provenance.
    void remakeStraightened(const WindowExport &table, const std::string &out, const RunContext &context)
    {
        const Json &made = table.provenance["straighten"];
        const auto analysis = analysed(table, context.part(0.0, 0.8));
        StraightenChoice choice{made.value("smoothSeconds", 0.0), {}, {}};
        if (made.contains("targetHz"))
            choice.targetHz = made["targetHz"].get<double>();
        if (made.contains("method"))
            choice.kind = straighteningOf(made["method"].get<std::string>());
        const Straightened straight =
            straightened(*analysis, chosenEvent(*analysis, made.at("event").get<int>()), choice);
        const bool isInteger = made.at("type").get<std::string>() == "int16";
        writeRecording(*straight.recording, out, isInteger ? WrittenType::Int16 : WrittenType::Float32,
                       context.part(0.8, 1.0));
    }

    void remakeCurve(const WindowExport &table, const std::string &out, const RunContext &context)
    {
        const Json &provenance = table.provenance;
        const Experiment experiment = experimentFromJson(provenance.at("experiment"), "experiment");
        if (const std::string recording = recordingOf(experiment); !recording.empty())
            table.mayRead(recording);
        std::vector<int> runs = runsOfShard(experiment, 0, 1);
        if (provenance.contains("runs")) { // it was stopped
            runs.clear();
            for (const Json &run : provenance["runs"])
                runs.push_back(runFromJson(run, experiment, "runs"));
        }
        Campaign campaign{experiment, {}, {}};
        carryOut(campaign, runs, context);
        writeCurve(campaign, out);
    }

} // namespace

bool isOfWindow(const Json &provenance)
{
    return provenance.is_object() && !provenance.contains("arguments") && provenance.contains("version")
           && provenance["version"].is_string();
}

void remake(const WindowExport &table, const std::string &out, const RunContext &context)
{
    try {
        if (table.provenance.contains("sequential"))
            throw Error(table.path,
                        "is a chart of a sequential test; use 'faintline replay' if the test was on radar scans");
        if (table.provenance.contains("experiment"))
            return remakeCurve(table, out, context);
        if (table.provenance.contains("doppler"))
            return remakeDoppler(table, out, context);
        if (table.provenance.contains("straighten"))
            return remakeStraightened(table, out, context);
        if (table.provenance.contains("recording"))
            return remakeEvents(table, out, context);
    } catch (const Json::exception &error) {
        throw Error(table.path, "has an invalid provenance: " + complaint(error));
    }
    throw Error(table.path, "has a provenance that names neither a recording nor an experiment");
}

} // namespace faintline::cli
