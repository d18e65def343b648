#pragma once

#include "analysis/events.h"

#include <vector>

namespace faintline {

class Document;
class EventTable;

/// The events that are asked about: those selected, or without a selection the strongest one shown. In the order of
/// time; none where nothing is shown.
std::vector<Event> chosenEvents(const Document &document, const EventTable &table);

} // namespace faintline
