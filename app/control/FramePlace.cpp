#include "app/control/FramePlace.h"

#include "app/document/Document.h"

namespace faintline {

std::optional<FramePlace> cursorOf(const Viewport &lines)
{
    const auto &cursor = lines.cursor();
    return cursor ? std::optional(FramePlace{cursor->seconds, {cursor->hz}}) : std::nullopt;
}

std::optional<FramePlace> cursorOf(const PingViewports &pings)
{
    const PingViewports::Place &place = pings.place();
    return FramePlace{place.seconds, {place.range, place.bearing}};
}

std::optional<FramePlace> cursorOf(Document &document, const PingViewports &pings)
{
    return document.frameKind().isSeenSingly ? cursorOf(pings) : cursorOf(document.viewport());
}

} // namespace faintline
