#pragma once

#include "app/document/Document.h"
#include "widgets/pings/PingViewports.h"

#include <optional>

namespace faintline {

/// The strongest of the events shown.
std::optional<Event> strongestEvent(const Document &document);

/// The middle of the strongest track of the document's pings, where most is visible; empty if there is no track.
std::optional<PingViewports::Place> strongestPlace(const Document &document);

} // namespace faintline
