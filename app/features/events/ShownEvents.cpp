#include "app/features/events/ShownEvents.h"

#include "analyse/events.h"
#include "app/document/Document.h"
#include "app/document/statisticUnit.h"
#include "widgets/events/EventModel.h"
#include "widgets/events/EventTable.h"

#include <QLineEdit>

namespace faintline {

ShownEvents::ShownEvents(Document &document, EventTable &table, QObject *parent)
    : QObject(parent), m_document(document), m_table(table)
{
    connect(&document, &Document::opened, this, [this] {
        m_table.setEvents({});
        m_table.filter()->clear();
    });
    connect(&document, &Document::analysisChanged, this, &ShownEvents::showPlan);
    connect(&document, &Document::livePlanChanged, this, &ShownEvents::showPlan);
    connect(&document, &Document::shownEventsChanged, this, &ShownEvents::showEvents);
    for (const auto changed :
         {&Document::opened, &Document::settingsChanged, &Document::analysisChanged, &Document::shownThresholdChanged})
        connect(&document, changed, this, &ShownEvents::showState);
}

void ShownEvents::setSnrBandwidth(double hz)
{
    m_snrBandwidthHz = hz;
    if (!m_document.isEmpty())
        showEvents();
}

void ShownEvents::showPlan()
{
    const AnalysisPlan &plan = *m_document.plan();
    const RecordingInfo info = m_document.recording() ? m_document.recording()->info() : RecordingInfo();
    m_table.setScales({plan.grid().axes, statisticUnit(plan.settings), info.startUnixSeconds, info.centreHz});
}

void ShownEvents::showEvents()
{
    std::vector<Event> events = m_document.shownEvents();
    const auto *plan = m_document.plan();
    const bool isConverted = m_snrBandwidthHz > 0.0 && m_document.recording() && plan && plan->frames;
    m_table.setSnrUnit(isConverted ? tr("dB in %1 Hz").arg(m_snrBandwidthHz) : tr("dB"));
    if (isConverted)
        for (Event &event : events)
            event.snrDb += snrChangeDb(m_snrBandwidthHz, plan->frames->geometry());
    m_table.setEvents(events);
}

void ShownEvents::showState()
{
    m_table.setPreview(m_document.isPreview());
    m_table.setEmptySentence(m_document.analysis() ? tr("No event at this threshold.")
                                                   : tr("Events follow when the detector has run."));
}

} // namespace faintline
