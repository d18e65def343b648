#include "app/cli/readProvenance.h"

#include "base/Error.h"
#include "base/files/fileName.h"
#include "base/json.h"

#include <algorithm>
#include <string_view>

namespace faintline::cli {

namespace {

    // Names are bytes and need not be valid text for JSON.
    std::string nameFrom(const Json &text)
    {
        return fileNameFromText(text.get<std::string>());
    }

    std::vector<std::string> namesFrom(const Json &texts)
    {
        std::vector<std::string> names;
        for (const Json &text : texts)
            names.push_back(nameFrom(text));
        return names;
    }

} // namespace

std::vector<std::string> fromCommandOn(const std::vector<std::string> &arguments)
{
    auto command = arguments.begin();
    while (command != arguments.end() && command->starts_with("--")) {
        const bool takesNext = command->find('=') == std::string::npos;
        command += std::min<std::ptrdiff_t>(takesNext ? 2 : 1, arguments.end() - command);
    }
    return {command, arguments.end()};
}

Provenance readProvenance(const std::string &path)
{
    const Json json = readJsonFile(path);
    try {
        Provenance provenance{json.at("faintline"),
                              nameFrom(json.at("folder")),
                              namesFrom(json.at("arguments")),
                              {},
                              namesFrom(json.at("outputs"))};
        for (const Json &input : json.at("inputs"))
            provenance.inputs.emplace_back(nameFrom(input.at("file")), input.at("hash"));
        // Other commands are rejected: they might do anything, or run replay again.
        constexpr std::string_view commands[]{"detect",     "compare", "simulate", "inject",
                                              "straighten", "doppler", "evaluate", "merge"};
        provenance.arguments = fromCommandOn(provenance.arguments);
        const bool isKnown =
            !provenance.arguments.empty()
            && std::find(std::begin(commands), std::end(commands), provenance.arguments.front()) != std::end(commands);
        constexpr std::size_t most = 1000;
        if (provenance.arguments.size() > most || provenance.outputs.size() > most)
            throw Error(path, "contains a command line that is too long");
        if (provenance.outputs.empty() || !isKnown)
            throw Error(path,
                        "is not the provenance of an output of detect, compare, simulate, inject, straighten, doppler, "
                        "evaluate or merge");
        return provenance;
    } catch (const Json::exception &) {
        throw Error(path, "is not a provenance: it needs faintline, folder, arguments, inputs and outputs");
    }
}

} // namespace faintline::cli
