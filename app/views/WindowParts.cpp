#include "app/views/WindowParts.h"

#include "app/document/scanScenario.h"
#include "app/features/inspect/ChannelsPanel.h"
#include "app/features/pictures/PingBench.h"
#include "app/features/pictures/Workbench.h"
#include "widgets/events/EventTable.h"

namespace faintline {

WindowParts::WindowParts() : m_controller(m_document), m_comparer(m_document), m_check(m_document) {}

WindowParts::~WindowParts() = default;

void WindowParts::openScansOf(const QString &path)
{
    const ScanTest test = readScanTest(path);
    if (m_sequentialTests.isEmpty() || m_sequentialTests.test() != test)
        openScans(test);
}

QWidget *WindowParts::docked(const QString &dock) const
{
    return std::ranges::find(m_docked, dock, &std::pair<QString, QWidget *>::first)->second;
}

ViewState WindowParts::viewState() const
{
    ViewState view = bench().viewState();
    view.firstChannel = panel<ChannelsPanel>().firstChannel();
    view.selectedEvent = m_events->selectedEvent();
    return view;
}

void WindowParts::restore(const ViewState &view)
{
    if (m_document.track(view.selectedEvent)) // other settings may find other events
        goTo(view.selectedEvent);             // what was seen of it follows
    bench().restore(view);
    panel<ChannelsPanel>().setFirstChannel(view.firstChannel);
}

Bench &WindowParts::bench() const
{
    return m_pings->isInUse() ? static_cast<Bench &>(*m_pings) : *m_workbench;
}

} // namespace faintline
