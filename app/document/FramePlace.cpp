#include "app/document/FramePlace.h"

#include "app/document/Document.h"

namespace faintline {

std::optional<FramePlace> cursorOf(const Viewport &lines)
{
    const auto &cursor = lines.cursor();
    return cursor ? std::optional(FramePlace{cursor->seconds, {cursor->hz}}) : std::nullopt;
}

std::optional<FramePlace> cursorOf(const PingViewports &pings)
{
    return FramePlace{pings.place().seconds, pings.place().position};
}

std::optional<FramePlace> cursorOf(Document &document, const PingViewports &pings)
{
    if (!document.frameKind().isSeenSingly)
        return cursorOf(document.viewport());
    const bool isOfThese = document.frames() && document.frames()->grid().fits(pings.place().position);
    return isOfThese ? cursorOf(pings) : std::nullopt; // otherwise of frames that were open before
}

} // namespace faintline
