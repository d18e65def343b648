#include "evaluate/comparison/compareAnalyses.h"

#include "base/Error.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace faintline {

namespace {

    constexpr double mostTimes = 1000.0;

    /// A track as a position over time, with the box it fills.
    class Path
    {
    public:
        Path(const Track &track, const Axis &time, const Grid &grid) : m_track(&track), m_time(&time), m_grid(&grid)
        {
            for (const TrackPoint &point : track.points) {
                const std::vector<double> at = positionOf(point);
                if (m_low.empty())
                    m_low = m_high = at;
                for (std::size_t axis = 0; axis < at.size(); ++axis) {
                    m_low[axis] = std::min(m_low[axis], at[axis]);
                    m_high[axis] = std::max(m_high[axis], at[axis]);
                }
            }
        }

        bool isEmpty() const { return m_track->points.empty(); }
        double start() const { return m_time->value(double(m_track->points.front().frame)); }
        double end() const { return m_time->value(double(m_track->points.back().frame)); }
        const std::vector<double> &low() const { return m_low; }
        const std::vector<double> &high() const { return m_high; }

        std::vector<double> at(double seconds) const
        {
            const auto last = double(m_track->points.size() - 1);
            const double index = std::round(m_time->position(seconds)) - double(m_track->points.front().frame);
            return positionOf(m_track->points[std::size_t(std::clamp(index, 0.0, last))]);
        }

    private:
        std::vector<double> positionOf(const TrackPoint &point) const
        {
            std::vector<double> position;
            const std::vector<Index> coordinates = m_grid->coordinates(point.cell);
            for (std::size_t axis = 0; axis < coordinates.size(); ++axis)
                position.push_back(m_grid->axes[axis].value(double(coordinates[axis])));
            return position;
        }

        const Track *m_track;
        const Axis *m_time;
        const Grid *m_grid;
        std::vector<double> m_low, m_high;
    };

    std::vector<Path> pathsOf(const Analysis &analysis)
    {
        std::vector<Path> paths;
        for (const Track &track : analysis.tracks)
            paths.emplace_back(track, analysis.time(), analysis.grid());
        return paths;
    }

    /// The tolerance in seconds and in the units of the axes.
    class Gate
    {
    public:
        Gate(const Analysis &a, const Analysis &b, const CompareTolerance &tolerance)
            : m_stepSeconds(std::max(a.time().step, b.time().step)), m_seconds(tolerance.frames * m_stepSeconds)
        {
            for (auto other = b.grid().axes.begin(); const Axis &own : a.grid().axes) {
                m_reach.push_back((tolerance.cells + 1e-6) * std::max(std::abs(own.step), std::abs((other++)->step)));
                m_turn.push_back(own.cyclic ? std::abs(own.step) * double(own.count) : 0.0);
            }
        }

        /// How long both follow one signal; empty if they are two signals.
        std::optional<double> sharedSeconds(const Path &a, const Path &b) const
        {
            const double from = std::max(a.start(), b.start()) - m_seconds;
            const double to = std::min(a.end(), b.end()) + m_seconds;
            if (to < from || !boxesTouch(a, b))
                return {};
            const double step = std::max(m_stepSeconds, (to - from) / mostTimes);
            int times = 0;
            int near = 0;
            for (double t = from; t <= to + 0.5 * step; t += step) {
                ++times;
                near += areNear(a.at(t), b.at(t)) ? 1 : 0;
            }
            return 2 * near >= times ? std::optional(near * step) : std::nullopt;
        }

    private:
        bool boxesTouch(const Path &a, const Path &b) const
        {
            for (std::size_t axis = 0; axis < m_reach.size(); ++axis)
                if (m_turn[axis] == 0.0
                    && (a.low()[axis] > b.high()[axis] + m_reach[axis]
                        || b.low()[axis] > a.high()[axis] + m_reach[axis]))
                    return false;
            return true;
        }

        bool areNear(const std::vector<double> &a, const std::vector<double> &b) const
        {
            for (std::size_t axis = 0; axis < m_reach.size(); ++axis) {
                double offset = b[axis] - a[axis];
                if (m_turn[axis] > 0.0)
                    offset -= m_turn[axis] * std::round(offset / m_turn[axis]);
                if (std::abs(offset) > m_reach[axis])
                    return false;
            }
            return true;
        }

        double m_stepSeconds;
        double m_seconds;
        std::vector<double> m_reach;
        std::vector<double> m_turn; ///< of a cyclic axis, else 0
    };

    struct EventPair {
        std::size_t a = 0;
        std::size_t b = 0;
        double sharedSeconds = 0.0;
    };

    std::vector<EventPair> pairsOf(const Analysis &a, const Analysis &b, const Gate &gate)
    {
        const std::vector<Path> ofA = pathsOf(a);
        const std::vector<Path> ofB = pathsOf(b);
        std::vector<EventPair> pairs;
        for (std::size_t i = 0; i < ofA.size(); ++i)
            for (std::size_t j = 0; j < ofB.size(); ++j)
                if (!ofA[i].isEmpty() && !ofB[j].isEmpty())
                    if (const std::optional<double> shared = gate.sharedSeconds(ofA[i], ofB[j]))
                        pairs.push_back({i, j, *shared});
        std::stable_sort(pairs.begin(), pairs.end(),
                         [](const EventPair &x, const EventPair &y) { return x.sharedSeconds > y.sharedSeconds; });
        std::vector<bool> isTakenA(ofA.size()), isTakenB(ofB.size());
        std::erase_if(pairs, [&](const EventPair &pair) {
            if (isTakenA[pair.a] || isTakenB[pair.b])
                return true;
            isTakenA[pair.a] = isTakenB[pair.b] = true;
            return false;
        });
        return pairs;
    }

    void checkAxes(const Analysis &a, const Analysis &b)
    {
        const auto &own = a.grid().axes;
        const auto &other = b.grid().axes;
        const auto measureTheSame = [](const Axis &x, const Axis &y) { return x.name == y.name && x.unit == y.unit; };
        const bool areAlike = std::equal(own.begin(), own.end(), other.begin(), other.end(), measureTheSame);
        if (!areAlike)
            throw Error("compare", "the axes of the two analyses have different quantities; both must be of the same "
                                   "recording");
    }

} // namespace

std::ptrdiff_t Comparison::count(ComparedEvent::In in) const
{
    return std::count_if(events.begin(), events.end(), [in](const ComparedEvent &event) { return event.in() == in; });
}

Comparison compareAnalyses(const Analysis &a, const Analysis &b, const CompareTolerance &tolerance)
{
    checkAxes(a, b);
    std::map<int, std::pair<int, double>> partnerOfA; // track id → that of B, shared seconds
    std::map<int, int> partnerOfB;
    for (const EventPair &pair : pairsOf(a, b, Gate(a, b, tolerance))) {
        partnerOfA[a.tracks[pair.a].id] = {b.tracks[pair.b].id, pair.sharedSeconds};
        partnerOfB[b.tracks[pair.b].id] = a.tracks[pair.a].id;
    }
    std::map<int, Event> eventsOfB;
    Comparison comparison;
    for (Event &event : events(b)) {
        if (partnerOfB.contains(event.id))
            eventsOfB.emplace(event.id, std::move(event));
        else
            comparison.events.push_back({{}, std::move(event), 0.0});
    }
    for (Event &event : events(a)) {
        const auto partner = partnerOfA.find(event.id);
        if (partner == partnerOfA.end())
            comparison.events.push_back({std::move(event), {}, 0.0});
        else
            comparison.events.push_back(
                {std::move(event), eventsOfB.at(partner->second.first), partner->second.second});
    }
    std::stable_sort(
        comparison.events.begin(), comparison.events.end(), [](const ComparedEvent &x, const ComparedEvent &y) {
            const Event &p = x.event();
            const Event &q = y.event();
            return p.onsetSeconds != q.onsetSeconds ? p.onsetSeconds < q.onsetSeconds : p.position < q.position;
        });
    return comparison;
}

} // namespace faintline
