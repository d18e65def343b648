#include "bindings/bind.h"

#include "base/json.h"
#include "bindings/jsonFromPython.h"
#include "bindings/settingsFromPython.h"
#include "plan/AnalysisSettings.h"

namespace faintline::python {

namespace py = pybind11;

namespace {

    /// The keyword that names a setting; None where several would be meant.
    py::object keywordOf(const std::string &fullName)
    {
        const std::string keyword = snakeCase(fullName.substr(fullName.rfind('.') + 1));
        try {
            settingOfKeyword(keyword);
        } catch (const Error &) {
            return py::none();
        }
        return py::str(keyword);
    }

    py::list describe(const std::string &beginning)
    {
        py::list list;
        for (const auto &field : AnalysisSettings::fields()) {
            if (!field.name.starts_with(beginning))
                continue;
            py::dict row;
            row["name"] = field.name;
            row["keyword"] = keywordOf(field.name);
            row["unit"] = field.unit;
            row["default"] = pythonFromJson(jsonFromFieldValue(defaultValue(field)));
            row["minimum"] = field.maximum > field.minimum ? py::object(py::float_(field.minimum)) : py::none();
            row["maximum"] = field.maximum > field.minimum ? py::object(py::float_(field.maximum)) : py::none();
            row["choices"] = pythonFromJson(Json(field.choices));
            row["label"] = labelOf(field);
            row["meaning"] = field.sentence;
            row["advice"] = field.advice;
            list.append(row);
        }
        if (list.empty())
            settingField(beginning); // says which is the nearest
        return list;
    }

    py::dict presetSentences()
    {
        py::dict all;
        for (const Preset &preset : presets())
            all[py::str(preset.name)] = preset.sentence;
        return all;
    }

} // namespace

void bindSettings(py::module_ &module)
{
    module.def("describe", &describe, py::arg("beginning") = "",
               R"(All settings whose full name has this prefix.

Returns a list of dicts with name, keyword (None if only the full name is unambiguous), unit, default, minimum, maximum,
choices, label, meaning and advice. Raises Error, with the nearest names, if there is none.)");
    module.def("presets", &presetSentences, "The presets: a dict of names and descriptions.");
}

} // namespace faintline::python
