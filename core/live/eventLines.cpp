#include "live/listen.h"

#include "analyse/columns.h"
#include "base/utc.h"

#include <array>
#include <string_view>

namespace faintline {

namespace {

    constexpr std::array<std::string_view, 4> stateNames{"provisional", "confirmed", "updated", "final"};
    constexpr std::array<std::string_view, 10> noticeNames{
        "started", "lost", "overflow", "gone", "back", "drift", "diskSpace", "recordingFailed", "refused", "stopped"};

} // namespace

std::string eventLine(const EventChange &change, const AnalysisPlan &plan, std::optional<double> startUnixSeconds)
{
    Json line;
    line["event"] = change.event.id;
    line["state"] = stateNames[std::size_t(change.state)];
    if (change.partOf)
        line["part_of"] = *change.partOf;
    if (change.isWithdrawn) {
        line["withdrawn"] = true;
        return line.dump();
    }
    Json event = eventJson(change.event, plan);
    event.erase("event");
    if (change.event.isOpen && change.state != EventChange::State::Final)
        event.erase("drift_hz_per_s");
    line.update(event);
    if (startUnixSeconds)
        line["utc"] = formatUtc(*startUnixSeconds + change.event.detectSeconds);
    return line.dump();
}

std::string noticeLine(const ListenNotice &notice, const StreamFormat &format)
{
    Json line;
    line["notice"] = noticeNames[std::size_t(notice.kind)];
    line["t"] = double(notice.sample) / format.sampleRateHz;
    line["sample"] = notice.sample;
    line["samples"] = notice.sampleCount;
    line["message"] = notice.words;
    return line.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace faintline
