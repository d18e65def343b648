#include "inspect/judgeByBoxes.h"

#include <algorithm>
#include <set>

namespace faintline {

namespace {

    constexpr double leastShareInBox = 0.5;
    constexpr double toleranceBins = 2.0;

    bool isOf(const Annotation &box, const Event &event, const Analysis &analysis)
    {
        const double from = std::max(box.startSeconds, event.onsetSeconds);
        const double to = std::min(box.endSeconds, event.endSeconds);
        const double shorter = std::min(box.endSeconds - box.startSeconds, event.endSeconds - event.onsetSeconds);
        if (to < from || to - from < leastShareInBox * shorter)
            return false;
        const Track *track = trackOfId(analysis.tracks, event.id);
        if (!track || !box.lowHz)
            return track;
        const Axis &frequency = analysis.grid().axes.front();
        const double margin = toleranceBins * frequency.step;
        const double half = 0.5 * analysis.time().step; // a box shorter than a frame still contains one
        int there = 0;
        int inside = 0;
        for (const TrackPoint &point : track->points) {
            const double seconds = analysis.time().value(double(point.frame));
            if (seconds < from - half || seconds > to + half)
                continue;
            const double hz = frequency.value(double(point.cell));
            ++there;
            inside += hz >= *box.lowHz - margin && hz <= *box.highHz + margin ? 1 : 0;
        }
        return there > 0 && inside >= leastShareInBox * there;
    }

} // namespace

JudgedByBoxes judgeByBoxes(std::vector<Review> reviews, const Analysis &analysis, const std::vector<Event> &events,
                           const std::vector<Annotation> &boxes)
{
    JudgedByBoxes result{std::move(reviews), {}, 0};
    std::set<int> judged;
    for (const Annotation &box : boxes) {
        bool isUsed = false;
        for (const Event &event : events) {
            const bool saysSomething = box.verdict != Verdict::None || !box.note.empty();
            if (!saysSomething || !analysis.grid().isSpectrum() || !isOf(box, event, analysis))
                continue;
            isUsed = true;
            if (!judged.insert(event.id).second)
                continue;
            if (box.verdict != Verdict::None)
                result.reviews = withVerdict(std::move(result.reviews), analysis, events, {event.id}, box.verdict);
            if (!box.note.empty())
                result.reviews = withNote(std::move(result.reviews), analysis, events, event.id, box.note);
        }
        if (!isUsed)
            result.others.push_back(box);
    }
    result.judged = int(judged.size());
    return result;
}

} // namespace faintline
