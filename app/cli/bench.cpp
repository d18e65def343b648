#include "app/cli/commands.h"
#include "app/cli/inRange.h"

#include "app/cli/speed/measureSpeed.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

namespace faintline::cli {

void addBench(CLI::App &app, Common &common)
{
    struct Options {
        std::vector<std::string> names;
        SpeedOptions speed;
        bool json = false;
    };
    const auto options = std::make_shared<Options>();
    CLI::App *command = app.add_subcommand("bench", "Measure the inner loops on this machine, as ratios to their plain "
                                                    "forms and to memory bandwidth");
    command
        ->add_option("NAME", options->names,
                     "all, LIST, a kernel such as recursion-21, or a common prefix of "
                     "several names")
        ->required();
    command->add_option("--rounds", options->speed.rounds, "Number of rounds, over which medians are taken")
        ->check(inRange(1, 1000))
        ->capture_default_str();
    command->add_flag("--json", options->json, "JSON instead of a table");
    command->callback([options, &common] {
        if (options->names == std::vector<std::string>{"LIST"} || options->names == std::vector<std::string>{"list"}) {
            for (const SpeedKernel &kernel : speedKernels())
                std::printf("%s\n    %s\n", kernel.name.c_str(), kernel.title.c_str());
            return;
        }
        std::vector<SpeedKernel> chosen;
        for (const std::string &name : options->names)
            for (SpeedKernel &kernel : speedKernels(name))
                chosen.push_back(std::move(kernel));
        if (!options->json)
            std::printf("%s, medians of %d interleaved rounds\n\n", instructionSet().c_str(), options->speed.rounds);
        std::vector<SpeedResult> results;
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            const auto count = double(chosen.size());
            results.push_back(measureSpeed(chosen[i], options->speed,
                                           common.context().part(double(i) / count, double(i + 1) / count)));
            if (!options->json) {
                std::printf("%s\n", speedText(results.back()).c_str());
                std::fflush(stdout);
            }
        }
        if (options->json)
            std::printf("%s\n", speedJson(results, options->speed).c_str());
    });
}

} // namespace faintline::cli
