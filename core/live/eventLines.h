#pragma once

#include "live/listen.h"

#include <optional>
#include <string>

namespace faintline {

// Output of `listen`: one JSON object per line.

/// {"event": 7, "state": "provisional", "t": …, …}: the event's number, which never changes; its state (provisional,
/// confirmed, updated, final); then the members of `eventJson`, in s from the first sample and Hz. For a track in
/// progress the drift is omitted and t_end is the present. "utc" of t_detect is given if `startUnixSeconds` is known. A
/// final event that is not an event of its own has "part_of", the number that it continues as, or "withdrawn".
std::string eventLine(const EventChange &change, const AnalysisPlan &plan, std::optional<double> startUnixSeconds);

/// {"notice": "lost", "t": …, "sample": …, "samples": …, "message": "…"}.
std::string noticeLine(const ListenNotice &notice, const StreamFormat &format);

} // namespace faintline
