#pragma once

#include "analyse/events.h"

#include <vector>

namespace faintline {

class Document;
class EventTable;

/// The selected events or, without a selection, the strongest event shown; in order of time. Empty if no event is
/// shown.
std::vector<Event> chosenEvents(const Document &document, const EventTable &table);

} // namespace faintline
