#include "app/features/events/chosenEvents.h"

#include "app/document/Document.h"
#include "widgets/events/EventTable.h"

#include <algorithm>

namespace faintline {

std::vector<Event> chosenEvents(const Document &document, const EventTable &table)
{
    const std::vector<Event> shown = document.shownEvents();
    const std::vector<int> ids = table.selectedEvents();
    std::vector<Event> chosen;
    for (const Event &event : shown)
        if (std::find(ids.begin(), ids.end(), event.id) != ids.end())
            chosen.push_back(event);
    if (chosen.empty() && !shown.empty())
        chosen.push_back(*std::max_element(shown.begin(), shown.end(),
                                           [](const Event &a, const Event &b) { return a.statistic < b.statistic; }));
    return chosen;
}

} // namespace faintline
