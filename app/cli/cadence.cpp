#include "app/cli/commands.h"
#include "app/cli/inRange.h"

#include "base/files/AtomicFile.h"
#include "exchange/TopHits.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

namespace faintline::cli {

namespace {

    struct CadenceOptions {
        std::vector<std::string> tables;
        std::string events;
        double slackHz = 0.0;
    };

    void findIn(const CadenceOptions &options, const Common &common)
    {
        checkOutputs({options.events});
        std::vector<TopHits> observations;
        for (const std::string &table : options.tables)
            observations.push_back(readTopHits(table));
        const std::vector<CadenceEvent> events = findCadence(observations, options.slackHz, common.context());
        if (!options.events.empty())
            writeTextFile(options.events, cadenceCsv(events));
        else
            std::printf("%s", cadenceCsv(events).c_str());
    }

} // namespace

void addCadence(CLI::App &app, Common &common)
{
    const auto options = std::make_shared<CadenceOptions>();
    CLI::App *command = app.add_subcommand(
        "cadence", "Find drifting signals that are present in all observations on target and in none off target");
    addInput(*command, common, "TABLES", options->tables,
             "Tables of hits (.dat) of observations alternately on and off target, as detect --hits writes them")
        ->required()
        ->expected(2, 1000);
    addOutput(*command, common, "--events", options->events, "Write the events: .csv; default: print them");
    command->add_option("--slack", options->slackHz, "Additional tolerance about a signal's straight line, Hz")
        ->check(inRange(0.0, 1e9))
        ->capture_default_str();
    command->callback([options, &common] { findIn(*options, common); });
}

} // namespace faintline::cli
