#include "app/document/scenarios.h"

#include <QCoreApplication>

namespace faintline {

const std::vector<Scenario> &scenarios()
{
    const auto tr = [](const char *text) { return QCoreApplication::translate("scenarios", text); };
    static const std::vector<Scenario> list{
        {tr("A drifting line too faint to see"),
         tr("At −1 dB in a quarter of a second, the line is invisible in the input. Evidence summed along its path "
            "reveals it."),
         QStringLiteral(":/scenarios/faint-drifting-line.json"), true},
        {tr("Sonar targets that cross"),
         tr("Sixty pings of an active sonar, range against time: five targets of 7 and 8 dB, two of which cross. None "
            "stands out in a single ping."),
         QStringLiteral(":/scenarios/sonar-crossing-targets.json"), true},
        {tr("A wandering line that fades"),
         tr("The line wanders by 70 Hz and fades for seconds. It is detected again each time it returns."),
         QStringLiteral(":/scenarios/wandering-fading-line.json")},
        {tr("Lines on coloured noise"),
         tr("Normalisation flattens noise that rises by 6 dB per octave, so one threshold serves all frequencies."),
         QStringLiteral(":/scenarios/lines-on-coloured-noise.json")},
    };
    return list;
}

QString openSeaPath()
{
    return QStringLiteral(":/scenarios/open-sea.json");
}

} // namespace faintline
