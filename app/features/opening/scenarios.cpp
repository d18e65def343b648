#include "app/features/opening/scenarios.h"

#include "app/document/scanScenario.h"

#include <QCoreApplication>
#include <QDir>

namespace faintline {

namespace {

    QString words(const char *text)
    {
        return QCoreApplication::translate("scenarios", text);
    }

} // namespace

const std::vector<Scenario> &scenarios()
{
    static const std::vector<Scenario> list{
        {words("A drifting line too faint to see"),
         words("At 1 dB in a quarter of a second, nothing is to be seen. Evidence added up along the path finds the "
               "line whole."),
         QStringLiteral(":/scenarios/faint-drifting-line.json"), QStringLiteral(":/pictures/start/faint-line.png")},
        {words("Sonar targets that cross"),
         words("Sixty pings, range against time: five targets, two of which cross. None stands out in a single ping."),
         QStringLiteral(":/scenarios/sonar-crossing-targets.json"), QStringLiteral(":/pictures/start/sonar.png")},
        {words("A radar that looks until it can decide"),
         words("One scan, and the evidence scan by scan. The test leaves an empty sector as soon as it can decide."),
         radarScenarioPath(), QStringLiteral(":/pictures/start/radar.png")},
        {words("A wandering line that fades"),
         words("The line wanders by 70 Hz and fades for seconds. It is detected again each time it returns."),
         QStringLiteral(":/scenarios/wandering-fading-line.json")},
        {words("Lines on coloured noise"),
         words("Normalisation flattens noise that rises by 6 dB per octave, so one threshold serves all frequencies."),
         QStringLiteral(":/scenarios/lines-on-coloured-noise.json")},
        {words("Figure 1 of Billon 2005"),
         words("One line at -1 dB that wanders by three cells, and the statistic along it, at one false alarm a "
               "picture."),
         QStringLiteral(":/scenarios/billon-figure-1.faintline")},
    };
    return list;
}

const std::vector<Scenario> &exampleRecordings()
{
    static const std::vector<Scenario> list = [] {
        const QDir folder(
            QDir::cleanPath(QCoreApplication::applicationDirPath() + QStringLiteral("/../share/faintline/recordings")));
        std::vector<Scenario> all{
            {words("Song of a humpback whale"),
             words("Half a minute in Glacier Bay: units of the song with their overtones, and their echoes."),
             folder.filePath(QStringLiteral("humpback.flac")), QStringLiteral(":/pictures/start/humpback.png"),
             words("C. Gabriele, US National Park Service; public domain")},
            {words("Calls of a deer mouse pup"),
             words("Ultrasound: four calls of about 30 kHz with overtones to 118 kHz, in a second."),
             folder.filePath(QStringLiteral("deer-mouse.flac")), QStringLiteral(":/pictures/start/deer-mouse.png"),
             words("N. Jourjine et al. 2023, Dryad; CC0")},
            {words("Tremor before an explosion"),
             words("A quarter of an hour at the volcano Redoubt: lines glide from 5 to 24 Hz, then it explodes."),
             folder.filePath(QStringLiteral("redoubt-tremor.flac")),
             QStringLiteral(":/pictures/start/redoubt-tremor.png"),
             words("Alaska Volcano Observatory, USGS; public domain")},
        };
        std::erase_if(all, [](const Scenario &one) { return !QFile::exists(one.path); });
        return all;
    }();
    return list;
}

QString openSeaPath()
{
    return QStringLiteral(":/scenarios/open-sea.json");
}

} // namespace faintline
