#include "app/cli/commands.h"
#include "app/cli/inRange.h"

#include "base/Error.h"
#include "base/files/fileName.h"
#include "base/oneLine.h"
#include "base/utc.h"
#include "exchange/survey/carryOutSurvey.h"
#include "exchange/survey/exportSurvey.h"
#include "exchange/survey/findRecordings.h"
#include "exchange/survey/writeSurvey.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>
#include <optional>

namespace faintline::cli {

namespace {

    struct SurveyOptions {
        AnalysisOptions analysis; ///< its file stays empty
        std::vector<std::string> names;
        std::string out;
        std::string shard;
        int jobs = 0;
    };

    void warnOf(const std::string &path, const std::string &why)
    {
        std::fprintf(stderr, "warning: %s: %s\n", oneLine(path).c_str(), why.c_str());
    }

    void survey(const SurveyOptions &options, const Common &common)
    {
        if (options.names.empty() || options.out.empty())
            throw Error("survey", "requires folders or recordings, and --out");
        SurveyRun run;
        run.settings = {options.analysis.settings(), options.analysis.open};
        run.shard = options.shard.empty() ? Shard{} : shardFrom(options.shard);
        run.jobs = options.jobs > 0 ? options.jobs : common.threads;
        std::vector<std::string> unreadable;
        run.recordings = findRecordings(options.names, !run.settings.open.rawType.empty(), unreadable);
        for (const std::string &folder : unreadable)
            warnOf(folder, "cannot be read");
        if (run.recordings.empty())
            throw Error(options.names.front(), "contains no recordings");
        checkOutputs({options.out});
        const RunContext context = common.context();
        const SurveyTally tally = carryOutSurvey(run, options.out, context, warnOf);
        context.checkpoint(1.0, "done");
        if (tally.failed > 0 || !unreadable.empty())
            throw Error(options.out,
                        std::to_string(tally.failed) + " recording(s) could not be analysed and "
                            + std::to_string(unreadable.size()) + " folder(s) could not be read; "
                            + std::to_string(tally.analysed + tally.kept) + " recording(s) were analysed",
                        Error::Kind::Failure);
    }

    void addMergeTo(CLI::App &survey, Common &common)
    {
        struct Options {
            std::vector<std::string> shards;
            std::string out;
        };
        const auto options = std::make_shared<Options>();
        CLI::App *command = survey.add_subcommand("merge", "Merge the shards of a survey; the result is identical to a "
                                                           "survey without shards");
        addInput(*command, common, "SHARD", options->shards, "Shards, in any order")->required();
        addOutput(*command, common, "--out", options->out, "Survey to write, .sqlite")->required();
        command->fallthrough(false); // a merge has no settings
        command->callback([options] {
            checkOutputs({options->out});
            mergeSurveys(options->shards, options->out);
        });
    }

    struct ExportOptions {
        std::string survey;
        std::string events;
        std::string tracks;
        std::string stoneSoup;
        std::string raven;
        std::string audacity;
        std::string sigmf;
        std::string camtrap;
        std::string start;
        std::optional<double> latitude;
        std::optional<double> longitude;
    };

    std::vector<std::string> recordingsOf(SurveyDatabase &survey)
    {
        std::vector<std::string> files;
        for (const SurveyRecording &recording : survey.recordings()) {
            const std::vector<std::string> read = filesReadFor(recording.file.path);
            files.insert(files.end(), read.begin(), read.end());
        }
        return files;
    }

    void exportAll(const ExportOptions &options)
    {
        for (const std::string &table : {options.events, options.tracks, options.stoneSoup})
            if (!table.empty())
                checkEnding(table, {".csv"});
        const std::optional<double> start = options.start.empty() ? std::nullopt : parseUtc(options.start);
        if (!options.start.empty() && !start)
            throw Error("--start " + options.start, "must be a date and time, such as 2024-07-26T00:00:00Z");
        if (!options.camtrap.empty() && (!options.latitude || !options.longitude))
            throw Error("--camtrap", "requires --latitude and --longitude");
        SurveyDatabase survey(options.survey);
        survey.hold();
        const InputFiles searched(recordingsOf(survey));
        checkOutputs({options.events, options.tracks, options.stoneSoup});
        if (!survey.isFinished())
            std::fprintf(stderr, "warning: %s: the survey is not finished\n", oneLine(options.survey).c_str());
        if (!options.events.empty())
            exportEvents(survey, options.events);
        if (!options.tracks.empty())
            exportTracks(survey, options.tracks);
        if (!options.stoneSoup.empty())
            exportStoneSoup(survey, options.stoneSoup, start);
        if (!options.raven.empty())
            exportLists(survey, SurveyList::Raven, options.raven);
        if (!options.audacity.empty())
            exportLists(survey, SurveyList::Audacity, options.audacity);
        if (!options.sigmf.empty())
            exportLists(survey, SurveyList::Sigmf, options.sigmf);
        if (!options.camtrap.empty())
            exportCamtrap(survey, options.camtrap, {*options.latitude, *options.longitude, start});
    }

    void addExportTo(CLI::App &survey, Common &common)
    {
        const auto options = std::make_shared<ExportOptions>();
        CLI::App *command =
            survey.add_subcommand("export", "Write the events and tracks of a survey for other programs");
        addInput(*command, common, "SURVEY", options->survey, "Survey, .sqlite")->required();
        addOutput(*command, common, "--events", options->events, "Write all events, .csv");
        addOutput(*command, common, "--tracks", options->tracks, "Write all tracks, .csv");
        addOutput(*command, common, "--stone-soup", options->stoneSoup,
                  "Write the points of all tracks in order of time, .csv for Stone Soup");
        addOutput(*command, common, "--raven", options->raven, "Write a Raven selection table per recording: a folder");
        addOutput(*command, common, "--audacity", options->audacity, "Write Audacity labels per recording: a folder");
        addOutput(*command, common, "--sigmf", options->sigmf, "Write SigMF annotations per recording: a folder");
        addOutput(*command, common, "--camtrap", options->camtrap,
                  "Write a Camera Trap Data Package: a folder; requires --latitude and --longitude");
        command->add_option("--latitude", options->latitude, "Latitude of the recordings, degrees north")
            ->check(inRange(-90.0, 90.0));
        command->add_option("--longitude", options->longitude, "Longitude of the recordings, degrees east")
            ->check(inRange(-180.0, 180.0));
        command->add_option("--start", options->start,
                            "Start time (UTC) of recordings without one, such as 2024-07-26T00:00:00Z");
        command->fallthrough(false);
        command->callback([options] {
            const std::string all = options->events + options->tracks + options->stoneSoup + options->raven
                                    + options->audacity + options->sigmf + options->camtrap;
            if (all.empty())
                throw Error("survey export", "no output requested; give at least one of --events, --tracks, "
                                             "--stone-soup, --raven, --audacity, --sigmf or --camtrap");
            exportAll(*options);
        });
    }

} // namespace

void addSurvey(CLI::App &app, Common &common)
{
    const auto options = std::make_shared<SurveyOptions>();
    CLI::App *command =
        app.add_subcommand("survey", "Search many recordings with the same settings; an interrupted run is resumed");
    command->require_subcommand(0, 1);
    addInput(*command, common, "FOLDER", options->names, "Folders, which are searched recursively, and recordings");
    options->analysis.addSettingsTo(*command, common);
    addOutput(*command, common, "--out", options->out, "Survey to write, .sqlite");
    command->add_option("--shard", options->shard, "Analyse only part I of N, for 'survey merge'");
    command->add_option("--jobs", options->jobs, "Recordings analysed at the same time; by default one per thread")
        ->check(inRange(1, 1024));
    addMergeTo(*command, common);
    addExportTo(*command, common);
    command->callback([options, command, &common] {
        if (command->get_subcommands().empty())
            survey(*options, common);
    });
}

} // namespace faintline::cli
