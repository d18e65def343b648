#include "widgets/forms/settingApplies.h"

#include "refine/secondLook.h"

#include <algorithm>
#include <array>

namespace faintline {

namespace {

    using Settings = const AnalysisSettings &;

    struct Condition {
        std::string_view name;
        bool (*holds)(Settings);
    };

    bool hasFamily(Settings settings)
    {
        return !settings.family.isNone();
    }

    bool hasSlopes(Settings settings)
    {
        return settings.model.motion == Motion::Slopes;
    }

    bool canTurn(Settings settings)
    {
        return settings.model.motion == Motion::Manoeuvring || settings.model.motion == Motion::Bank;
    }

    bool hasFixedReset(Settings settings)
    {
        const auto *smd = std::get_if<SmdSettings>(&settings.detector);
        return smd && smd->reset == SmdSettings::Reset::Fixed;
    }

    /// The half width of inhibition is also that of forgetting if that has none of its own.
    bool usesInhibitCells(Settings settings)
    {
        return settings.decide.inhibits || (settings.decide.resets && settings.decide.forgetCells.empty());
    }

    constexpr std::array conditions{
        Condition{"selection.channel", [](Settings s) { return s.selection.channels.empty(); }},
        Condition{"family.members", hasFamily},
        Condition{"family.present", hasFamily},
        Condition{"model.slopeUnit", hasSlopes},
        Condition{"model.lowestSlope", hasSlopes},
        Condition{"model.highestSlope", hasSlopes},
        Condition{"model.slopesPerBin", hasSlopes},
        Condition{"model.slopeChange", hasSlopes},
        Condition{"model.rounding", hasSlopes},
        Condition{"model.rangeRateChange", canTurn},
        Condition{"model.bearingRateChange", canTurn},
        Condition{"smd.lnK", hasFixedReset},
        Condition{"decide.inhibitCells", usesInhibitCells},
        Condition{"decide.forgetCells", [](Settings s) { return s.decide.resets; }},
        Condition{"track.bothWays", canLookTwice},
        Condition{"subtract.leastDb", [](Settings s) { return s.subtract.lines; }},
    };

} // namespace

bool settingApplies(std::string_view name, const AnalysisSettings &settings)
{
    if (!settingField(name).get(settings))
        return false;
    const auto found = std::find_if(conditions.begin(), conditions.end(),
                                    [name](const Condition &condition) { return condition.name == name; });
    return found == conditions.end() || found->holds(settings);
}

} // namespace faintline
