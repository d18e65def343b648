#include "evaluate/comparison/settingDifferences.h"

namespace faintline {

namespace {

    std::string textOf(const Field<AnalysisSettings> &field, const AnalysisSettings &settings)
    {
        const std::optional<FieldValue> value = field.get(settings);
        return value ? formatFieldValue(field, *value) : std::string();
    }

    /// Whether a field is a way to specify the threshold that is not in use.
    bool isIdle(const std::string &name, const DecideSettings &decide)
    {
        for (std::size_t i = 0; i < DecideSettings::byNames.size(); ++i)
            if (name == "decide." + std::string(DecideSettings::byNames[i]))
                return i != std::size_t(decide.by);
        return false;
    }

    /// Whether only one side has the field, at its default: the choice of the detector implies it.
    bool goesWithoutSaying(const SettingDifference &difference)
    {
        const std::string &held = difference.a.empty() ? difference.b : difference.a;
        return (difference.a.empty() || difference.b.empty())
               && held == formatFieldValue(difference.field, defaultValue(settingField(difference.field.name)));
    }

} // namespace

std::vector<SettingDifference> settingDifferences(const AnalysisSettings &a, const AnalysisSettings &b)
{
    std::vector<SettingDifference> differences;
    for (const Field<AnalysisSettings> &field : AnalysisSettings::fields()) {
        if (isIdle(field.name, a.decide) && isIdle(field.name, b.decide))
            continue;
        SettingDifference difference{field, textOf(field, a), textOf(field, b)};
        if (difference.a != difference.b && !goesWithoutSaying(difference))
            differences.push_back(std::move(difference));
    }
    return differences;
}

} // namespace faintline
