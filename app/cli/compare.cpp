#include "app/cli/commands.h"
#include "app/cli/inRange.h"
#include "app/cli/printSummary.h"
#include "app/cli/provenance.h"

#include "analyse/analyse.h"
#include "base/Error.h"
#include "base/files/AtomicFile.h"
#include "base/oneLine.h"
#include "evaluate/comparison/compareAnalyses.h"
#include "evaluate/comparison/differencePicture.h"
#include "evaluate/comparison/settingDifferences.h"
#include "evaluate/experiments/measureCost.h"
#include "exchange/writeComparison.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

namespace faintline::cli {

namespace {

    struct CompareOptions {
        AnalysisOptions common;
        std::string presetA, presetB;
        std::vector<std::string> setA, setB;
        CompareTolerance tolerance;
        std::string events;
        std::string difference;
        bool cost = false;
    };

    AnalysisSettings settingsOf(AnalysisOptions options, const std::string &preset,
                                const std::vector<std::string> &assignments)
    {
        if (!preset.empty())
            options.preset = preset;
        options.assignments.insert(options.assignments.end(), assignments.begin(), assignments.end());
        return options.settings();
    }

    std::string orNone(const std::string &value)
    {
        return value.empty() ? "none" : value;
    }

    void printSide(const char *name, const Analysis &analysis)
    {
        const double perHour = analysis.calibration->eventRateAt(analysis.threshold) * analysis.cellFramesPerHour;
        const std::string_view unit = detectorUnits[analysis.settings.detector.index()];
        std::printf("%s: %zu event(s), threshold %.2f %.*s (%.3g false alarms per hour on noise)\n", name,
                    analysis.tracks.size(), analysis.threshold, int(unit.size()), unit.data(), perHour);
    }

    void printDifferences(const AnalysisSettings &a, const AnalysisSettings &b)
    {
        const std::vector<SettingDifference> differences = settingDifferences(a, b);
        std::printf("%s\n", differences.empty() ? "their settings are the same" : "A and B differ in");
        for (const SettingDifference &difference : differences)
            std::printf("  %s%s%s: %s in A, %s in B\n", difference.field.name.c_str(),
                        difference.field.unit.empty() ? "" : ", ", difference.field.unit.c_str(),
                        oneLine(orNone(difference.a)).c_str(), oneLine(orNone(difference.b)).c_str());
    }

    void printEvents(const Comparison &comparison, const Analysis &analysis)
    {
        using In = ComparedEvent::In;
        std::printf("in both: %td, only in A: %td, only in B: %td\n", comparison.count(In::Both),
                    comparison.count(In::A), comparison.count(In::B));
        for (const ComparedEvent &compared : comparison.events) {
            const Event &event = compared.event();
            std::printf("%-4s  %s … %s s, at",
                        compared.in() == In::A   ? "A"
                        : compared.in() == In::B ? "B"
                                                 : "both",
                        secondsOf(event.onsetSeconds, analysis.time()).c_str(),
                        secondsOf(event.endSeconds, analysis.time()).c_str());
            for (std::size_t axis = 0; axis < event.position.size(); ++axis)
                std::printf(" %s %s", positionText(event.position[axis], analysis.grid().axes[axis]).c_str(),
                            oneLine(analysis.grid().axes[axis].unit).c_str());
            for (const auto &[name, side] : {std::pair{"A", &compared.a}, std::pair{"B", &compared.b}})
                if (*side)
                    std::printf("; %s: event %d, detected at %s s, %.1f", name, (*side)->id,
                                secondsOf((*side)->detectSeconds, analysis.time()).c_str(), (*side)->statistic);
            std::printf("\n");
        }
    }

    void compare(const CompareOptions &options, const Common &common)
    {
        if (!options.events.empty())
            checkComparisonPath(options.events);
        checkOutputs({options.events, options.difference});
        const AnalysisSettings settingsA = settingsOf(options.common, options.presetA, options.setA);
        const AnalysisSettings settingsB = settingsOf(options.common, options.presetB, options.setB);
        const RunContext context = common.context();
        const OpenedSource opened = options.common.opened(settingsA, context);
        const auto a = analyse(opened, settingsA, {}, context.part(0.0, 0.5));
        const auto b = analyse(opened, settingsB, {.previous = a.get()}, context.part(0.5, 1.0));
        const Comparison comparison = compareAnalyses(*a, *b, options.tolerance);
        context.checkpoint(1.0, "done");
        RunContext quiet;
        quiet.stop = context.stop;
        CommitTogether files;
        writeProvenance(common, options.common.inputs(), {options.events, options.difference});
        if (!options.events.empty())
            writeComparison(comparison, b->grid(), options.events);
        if (!options.difference.empty()) {
            const auto difference = differencePicture(*a, *b, quiet);
            if (!difference)
                throw Error("--difference", "is available for lines only, not for pings");
            writeDifference(*difference, options.difference);
        }
        files.commit();
        printSide("A", *a);
        printSide("B", *b);
        printDifferences(settingsA, settingsB);
        printEvents(comparison, *b);
        if (options.cost)
            std::printf("processor time per hour of recording: A %.3g s, B %.3g s\n", measureCost(*a, quiet),
                        measureCost(*b, quiet));
    }

} // namespace

void addCompare(CLI::App &app, Common &common)
{
    const auto options = std::make_shared<CompareOptions>();
    CLI::App *command = app.add_subcommand(
        "compare", "Compare two detectors or two settings on one recording: events found by both, or by only one");
    options->common.addTo(*command, common);
    command->add_option("--preset-a", options->presetA, "Preset from which A starts, in place of --preset");
    command->add_option("--preset-b", options->presetB, "Preset from which B starts, in place of --preset");
    command->add_option("--set-a", options->setA, "A setting of A only, name=value; may be repeated")
        ->take_all()
        ->allow_extra_args(false);
    command->add_option("--set-b", options->setB, "A setting of B only, name=value; may be repeated")
        ->take_all()
        ->allow_extra_args(false);
    command
        ->add_option("--cells", options->tolerance.cells,
                     "Largest distance between two paths of one signal, in "
                     "steps of the coarser grid")
        ->check(inRange(0.0, 1e6))
        ->capture_default_str();
    command
        ->add_option("--frames", options->tolerance.frames, "Largest distance in time, in frames of the coarser grid")
        ->check(inRange(0.0, 1e6))
        ->capture_default_str();
    addOutput(*command, common, "--events", options->events,
              "Write the events of both, .csv: column 'in' is A, B or both");
    addOutput(*command, common, "--difference", options->difference,
              "Write the difference layer, .npy: margin of B above its threshold minus that of A, nat, "
              "rounded to a quarter");
    command->add_flag("--cost", options->cost, "Print the cost of each, in seconds on this machine");
    command->callback([options, &common] { compare(*options, common); });
}

} // namespace faintline::cli
