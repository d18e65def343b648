#include "app/document/scenarios.h"

#include <QCoreApplication>

namespace faintline {

const std::vector<Scenario> &scenarios()
{
    const auto tr = [](const char *text) { return QCoreApplication::translate("scenarios", text); };
    static const std::vector<Scenario> list{
        {tr("A drifting line too faint to see"),
         tr("At −1 dB in a quarter of a second the input shows nothing; evidence gathered along the path shows it "
            "all."),
         QStringLiteral(":/scenarios/faint-drifting-line.json"), true},
        {tr("Sonar targets that cross"),
         tr("Sixty pings of an active sonar, range against time: five targets of 7 and 8 dB, two of which cross. None stands out in a single ping."),
         QStringLiteral(":/scenarios/sonar-crossing-targets.json"), true},
        {tr("A wandering line that fades"),
         tr("It strays by 70 Hz and drops out for seconds; each time it comes back, it is found again."),
         QStringLiteral(":/scenarios/wandering-fading-line.json")},
        {tr("Lines on coloured noise"),
         tr("Noise that rises by 6 dB an octave is flattened first; one threshold then serves all frequencies."),
         QStringLiteral(":/scenarios/lines-on-coloured-noise.json")},
    };
    return list;
}

} // namespace faintline
