#pragma once

#include "live/listen.h"

#include <optional>
#include <string>

namespace faintline {

// What a listener tells, one JSON object a line.

/// {"event": 7, "state": "provisional", "t": …, …}: the event's number, which stays; its state (provisional, confirmed,
/// updated, final); then the members of `eventJson`, in s from the first sample and Hz, of a track in progress without
/// its drift, t_end the present; "utc" of t_detect where `startUnixSeconds` is known. A final one that is no event of
/// its own has "part_of", the number it goes on as, or "withdrawn".
std::string eventLine(const EventChange &change, const Grid &grid, std::optional<double> startUnixSeconds);

/// {"notice": "lost", "t": …, "sample": …, "samples": …, "message": "…"}.
std::string noticeLine(const ListenNotice &notice, const StreamFormat &format);

} // namespace faintline
