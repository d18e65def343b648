#include "app/features/pictures/bottomBars.h"

#include "app/document/Document.h"
#include "app/document/statisticUnit.h"
#include "app/features/pictures/Workbench.h"
#include "widgets/base/ReadOut.h"
#include "widgets/base/familyWords.h"
#include "widgets/pings/PingMarks.h"
#include "widgets/waterfall/OverviewStrip.h"

namespace faintline {

void connectOverview(OverviewStrip &strip, Document &document)
{
    strip.setViewport(&document.viewport());
    const auto shown = std::make_shared<Index>(0); // live frames
    QObject::connect(&document, &Document::opened, &strip, [&strip, shown] {
        *shown = 0;
        strip.setPicture(nullptr, {});
    });
    QObject::connect(&document, &Document::picturesGrew, &strip, [&strip](const PicturesSoFar &pictures) {
        strip.setPicture(pictures.quickLook ? pictures.quickLook : pictures.input, pictures.frequency);
    });
    QObject::connect(&document, &Document::analysisChanged, &strip, [&strip, &document] {
        strip.setPicture(document.analysis()->inputAlong.front(), document.analysis()->grid().axes.front());
    });
    QObject::connect(&document, &Document::liveChanged, &strip, [&strip, &document, shown] {
        const LiveView &view = document.live();
        if (*shown > 0 && view.time.count < *shown + *shown / 64 + 1) // it shows all, which is costly
            return;
        *shown = view.time.count;
        strip.setPicture(view.input, view.plan->grid().axes.back());
    });
    QObject::connect(&document, &Document::shownEventsChanged, &strip,
                     [&strip, &document] { strip.setEvents(eventsAlong(document.shownEvents(), 0)); });
    QObject::connect(&document.display(), &PictureDisplay::coloursChanged, &strip,
                     [&strip, &document] { strip.setColourMap(document.display().colourMap()); });
}

void connectReadOut(ReadOut &readOut, Document &document, Workbench &bench)
{
    QObject::connect(&document, &Document::opened, &readOut, [&readOut, &document] {
        if (!document.recording())
            return;
        readOut.setStartUnixSeconds(document.recording()->info().startUnixSeconds);
        readOut.setCentreHz(document.recording()->info().centreHz);
    });
    for (const auto changed : {&Document::analysisChanged, &Document::livePlanChanged})
        QObject::connect(&document, changed, &readOut, [&readOut, &document] {
            const AnalysisPlan &plan = *document.plan();
            const Axis &frequency = plan.grid().axes.front(); // for pings: the range
            readOut.setResolution(plan.time().step, frequency.step, plan.time().last());
            readOut.setFrequencyName(frequencyName(plan.settings.family));
            readOut.setStatisticUnit(statisticUnit(plan.settings));
        });
    QObject::connect(&bench, &Workbench::readingChanged, &readOut, &ReadOut::setReading);
}

} // namespace faintline
