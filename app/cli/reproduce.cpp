#include "app/cli/commands.h"

#include "base/Error.h"
#include "reproduce/reproduce.h"
#include "reproduce/writeReproduction.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

namespace faintline::cli {

void addReproduce(CLI::App &app, Common &common)
{
    struct Options {
        std::vector<std::string> names;
        ReproduceOptions reproduce;
        std::string folder;
        bool json = false;
    };
    const auto options = std::make_shared<Options>();
    CLI::App *command = app.add_subcommand("reproduce", "Reproduce tables and figures of a publication: paper, result, "
                                                        "interval, gap");
    command
        ->add_option("NAME", options->names,
                     "LIST, a paper (billon, parsons, grossi), or one table or figure such as billon:table1")
        ->required();
    command->add_flag("--quick", options->reproduce.quick, "Run a tenth of the trials");
    command->add_option("--seed", options->reproduce.seed, "Seed of the simulations")->capture_default_str();
    command->add_option("--out", options->folder, "Folder for JSON, CSV and pictures");
    command->add_flag("--json", options->json, "JSON instead of a table");
    command->callback([options, &common] {
        if (options->names == std::vector<std::string>{"LIST"} || options->names == std::vector<std::string>{"list"}) {
            for (const Reproducible &entry : reproducibles())
                std::printf("%s\n    %s\n", entry.name.c_str(), entry.title.c_str());
            return;
        }
        std::vector<const Reproducible *> chosen;
        for (const std::string &name : options->names) {
            const std::size_t before = chosen.size();
            for (const Reproducible &entry : reproducibles())
                if (entry.name == name || entry.name.starts_with(name + ":"))
                    chosen.push_back(&entry);
            if (chosen.size() == before)
                reproducible(name); // says what there is
        }
        std::string outside;
        for (const Reproducible *entry : chosen) {
            const Reproduction made = entry->run(options->reproduce, common.context());
            if (!options->folder.empty())
                writeReproduction(made, options->folder);
            std::printf("%s\n", (options->json ? reproductionJson(made) : reproductionText(made)).c_str());
            std::fflush(stdout);
            if (!made.isInside())
                outside += (outside.empty() ? "" : ", ") + made.name;
        }
        if (!outside.empty())
            throw Error("reproduce", "outside its tolerance: " + outside, Error::Kind::Failure);
    });
}

} // namespace faintline::cli
