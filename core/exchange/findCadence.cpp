#include "exchange/findCadence.h"

#include "base/Error.h"
#include "base/Field.h"
#include "base/oneLine.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    /// The strongest hit of `other` that is the same signal as one of `first`; null where there is none.
    const TopHit *sameSignal(const TopHit &hit, const TopHits &first, const TopHits &other, double slackHz)
    {
        const double seconds = *other.startUnixSeconds - *first.startUnixSeconds;
        const double expected = hit.startHz + hit.driftHzPerSecond * seconds;
        const double step = std::max(first.driftStep(), other.driftStep());
        const double reach =
            slackHz + 2.0 * std::max(first.channelHz, other.channelHz) + 0.5 * step * std::abs(seconds);
        const TopHit *best = nullptr;
        for (const TopHit &each : other.hits)
            if (std::abs(each.startHz - expected) <= reach
                && std::abs(each.driftHzPerSecond - hit.driftHzPerSecond) <= 2.0 * step
                && (!best || each.snr > best->snr))
                best = &each;
        return best;
    }

} // namespace

std::vector<CadenceEvent> findCadence(const std::vector<TopHits> &observations, double slackHz,
                                      const RunContext &context)
{
    if (observations.size() < 2)
        throw Error("a cadence", "needs at least two observations, alternately on and off target");
    for (const TopHits &each : observations)
        if (!each.startUnixSeconds)
            throw Error(oneLine(each.source), "does not give its start time (MJD), which a cadence requires");
    const TopHits &first = observations.front();
    std::vector<CadenceEvent> events;
    for (const TopHit &hit : first.hits) {
        context.checkpoint(double(&hit - first.hits.data()) / double(first.hits.size()), "comparing observations");
        CadenceEvent event{{hit}};
        bool isOnTargetOnly = true;
        for (std::size_t i = 1; i < observations.size() && isOnTargetOnly; ++i) {
            const TopHit *same = sameSignal(hit, first, observations[i], slackHz);
            const bool isOn = i % 2 == 0;
            isOnTargetOnly = isOn == (same != nullptr);
            if (same && isOn)
                event.hits.push_back(*same);
        }
        if (isOnTargetOnly)
            events.push_back(std::move(event));
    }
    context.checkpoint(1.0, "comparing observations");
    return events;
}

std::string cadenceCsv(const std::vector<CadenceEvent> &events)
{
    std::string text = "event,observation,frequency_hz,drift_hz_per_s,snr\n";
    for (std::size_t number = 0; number < events.size(); ++number)
        for (std::size_t i = 0; i < events[number].hits.size(); ++i) {
            const TopHit &hit = events[number].hits[i];
            text += std::to_string(number + 1) + "," + std::to_string(2 * i + 1) + "," + formatNumber(hit.startHz) + ","
                    + formatNumber(hit.driftHzPerSecond) + "," + formatNumber(hit.snr) + "\n";
        }
    return text;
}

} // namespace faintline
