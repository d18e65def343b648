#include "bindings/provenance.h"

#include "base/files/AtomicFile.h"
#include "base/files/fileName.h"
#include "base/json.h"
#include "signal/Timeline.h"
#include "signal/fileHash.h"

#include <algorithm>
#include <filesystem>

namespace faintline::python {

namespace fs = std::filesystem;

namespace {

    /// --set name=value for each setting that is not the default, the detector first: it brings settings of its own.
    std::vector<std::string> assignmentsOf(const AnalysisSettings &settings)
    {
        std::vector<std::string> arguments;
        AnalysisSettings reached;
        const auto assign = [&](const Field<AnalysisSettings> &field) {
            const std::optional<FieldValue> value = field.get(settings);
            if (!value || value == field.get(reached))
                return;
            arguments.insert(arguments.end(), {"--set", field.name + "=" + formatFieldValue(*value)});
            setSetting(reached, field.name, formatFieldValue(*value));
        };
        assign(settingField("detector.kind"));
        for (const Field<AnalysisSettings> &field : AnalysisSettings::fields())
            assign(field);
        return arguments;
    }

    Json textsFrom(const std::vector<std::string> &names)
    {
        Json texts = Json::array();
        for (const std::string &name : names)
            texts.push_back(textFromFileName(name));
        return texts;
    }

} // namespace

void writeProvenance(const Origin &origin, const std::vector<std::pair<std::string, std::string>> &outputs)
{
    if (origin.source.empty())
        return;
    const std::vector<std::string> inputs = filesBehind({origin.source.front()});
    if (!std::all_of(inputs.begin(), inputs.end(), [](const std::string &input) { return fs::is_regular_file(input); }))
        return;
    std::vector<std::string> arguments{"detect"};
    arguments.insert(arguments.end(), origin.source.begin(), origin.source.end());
    const std::vector<std::string> assignments = assignmentsOf(origin.settings);
    arguments.insert(arguments.end(), assignments.begin(), assignments.end());
    std::vector<std::string> written;
    for (const auto &[option, path] : outputs)
        if (!path.empty()) {
            written.push_back(fs::absolute(path).lexically_normal().string());
            arguments.insert(arguments.end(), {option, written.back()});
        }
    Json json = {{"faintline", FAINTLINE_VERSION},
                 {"folder", textFromFileName(fs::current_path().string())},
                 {"arguments", textsFrom(arguments)},
                 {"inputs", Json::array()},
                 {"outputs", textsFrom(written)}};
    for (const std::string &input : inputs)
        json["inputs"].push_back({{"file", textFromFileName(input)}, {"hash", fileHash(input)}});
    for (const std::string &output : written)
        writeTextFile(output + ".provenance.json", json.dump(2) + "\n");
}

} // namespace faintline::python
