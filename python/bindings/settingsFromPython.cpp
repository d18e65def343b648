#include "bindings/settingsFromPython.h"

#include "base/json.h"
#include "base/oneLine.h"
#include "bindings/jsonFromPython.h"
#include "plan/firstSettings.h"

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

namespace faintline::python {

namespace py = pybind11;

namespace {

    using Assignments = std::vector<std::pair<std::string, Json>>;

    std::string ownName(const std::string &fullName)
    {
        return fullName.substr(fullName.rfind('.') + 1);
    }

    /// Accepts an integer as a float, and a single number as a list of one.
    FieldValue valueOf(const FieldInfo &info, Json value)
    {
        if (info.kind == FieldKind::Numbers && value.is_number())
            value = Json::array({value});
        return fieldValueFromJson(value, info);
    }

    void assign(AnalysisSettings &settings, const std::string &name, const Json &value)
    {
        setSetting(settings, name, formatFieldValue(valueOf(settingField(name), value)));
    }

    Assignments assignmentsOf(const AskedSettings &asked)
    {
        Assignments all;
        if (!asked.settings.is_none()) {
            const Json json = jsonFromPython(asked.settings, "settings");
            if (!json.is_object())
                throw Error("settings",
                            "must be a dict of values by full names, such as {'spectrogram.windowSeconds': 0.5}");
            for (const auto &[name, value] : json.items())
                all.emplace_back(name, value);
        }
        for (const auto &[key, value] : asked.keywords) {
            const auto keyword = py::cast<std::string>(key);
            all.emplace_back(settingOfKeyword(keyword), jsonFromPython(value, keyword));
        }
        return all;
    }

    AnalysisSettings presetOr(const AskedSettings &asked, const AnalysisSettings &otherwise)
    {
        return asked.preset.is_none() ? otherwise : preset(py::cast<std::string>(py::str(asked.preset))).settings;
    }

    AnalysisSettings changed(AnalysisSettings settings, const AskedSettings &asked)
    {
        Assignments all = assignmentsOf(asked);
        std::stable_partition(all.begin(), all.end(), [](const auto &one) { return one.first == "detector.kind"; });
        for (const auto &[name, value] : all)
            assign(settings, name, value);
        return settings;
    }

} // namespace

std::string snakeCase(const std::string &name)
{
    const auto isCapital = [&](std::size_t i) { return std::isupper(static_cast<unsigned char>(name[i])) != 0; };
    std::string result;
    for (std::size_t i = 0; i < name.size(); ++i) {
        if (i > 0 && isCapital(i) && !isCapital(i - 1))
            result += '_';
        result += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
    }
    return result;
}

std::string settingOfKeyword(const std::string &keyword)
{
    std::vector<std::string> found;
    for (const FieldInfo &field : AnalysisSettings::fields())
        if (snakeCase(ownName(field.name)) == keyword)
            found.push_back(field.name);
    if (found.size() == 1)
        return found.front();
    if (found.empty())
        throw Error(
            keyword,
            "unknown setting; faintline.describe() lists all, by full names for settings={...} and by keywords");
    throw Error(keyword, "is the name of several settings: " + listed(found) + "; give the full one, settings={'"
                             + found.front() + "': ...}");
}

AnalysisSettings settingsFromPython(const AskedSettings &asked, const AnalysisSettings &otherwise)
{
    return changed(presetOr(asked, otherwise), asked);
}

AnalysisSettings settingsFromPython(const AskedSettings &asked, const RecordingInfo &recording)
{
    return changed(withFittedOrder(presetOr(asked, {}), recording), asked);
}

} // namespace faintline::python
