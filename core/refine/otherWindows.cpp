#include "refine/otherWindows.h"

#include "frames/Window.h"
#include "plan/Analysis.h"
#include "refine/TrackCurve.h"
#include "refine/constants.h"
#include "refine/levelBeside.h"
#include "refine/numberByDetection.h"
#include "refine/ownNoiseLaw.h"
#include "refine/pathStrips.h"
#include "refine/signalKind.h"
#include "refine/trimEnds.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <set>
#include <utility>

namespace faintline {

namespace {

    constexpr std::size_t windowStripsBytes = std::size_t(64) << 20; ///< read at a time

    const Axis &frequencyOf(const Analysis &analysis)
    {
        return analysis.grid().axes.back();
    }

    double windowOf(const Analysis &analysis)
    {
        return analysis.frames->geometry().windowSeconds;
    }

    /// The one in which a track was found.
    double windowOf(const Track &track, const Analysis &analysis)
    {
        return track.windowSeconds > 0.0 ? track.windowSeconds : windowOf(analysis);
    }

    struct Band {
        double low = std::numeric_limits<double>::infinity();
        double high = -std::numeric_limits<double>::infinity();

        bool isEmpty() const { return low > high; }
    };

    /// A track of an analysis, with the bands in which it may be.
    class Curve : public TrackCurve
    {
    public:
        Curve(const Track &track, const Analysis &analysis)
            : TrackCurve(track, analysis.time(), frequencyOf(analysis)), m_windowHalf(0.5 * windowOf(track, analysis))
        {
            const Axis &axis = frequencyOf(analysis);
            for (std::size_t i = 0; i < track.points.size(); ++i) {
                const SmoothedPoint &point = track.smoothed[i];
                const bool isThere = // what was not observed is no pause
                    track.isPresent(i) || !analysis.frames->isObserved(track.points[i].frame);
                m_bands.push_back(isThere ? Band{std::min(hzAt(i), axis.value(double(point.low))),
                                                 std::max(hzAt(i), axis.value(double(point.high)))}
                                          : Band{});
            }
        }

        double heardFrom() const { return start() - m_windowHalf; } ///< of the window of its first frame
        double heardUntil() const { return end() + m_windowHalf; }
        double duration() const { return end() - start() + step(); }
        bool isPresent(std::size_t i) const { return !m_bands[i].isEmpty(); }

        /// Where it may be between two times, at the points nearest to these at least.
        Band between(double from, double to) const
        {
            Band band;
            if (to < heardFrom() || from > heardUntil())
                return band;
            const auto most = double(count() - 1);
            const double first = std::clamp(std::ceil((from - start()) / step() - 0.5), 0.0, most);
            const double last = std::clamp(std::floor((to - start()) / step() + 0.5), 0.0, most);
            for (double i = first; i <= last; i += 1.0) {
                const Band &one = m_bands[std::size_t(i)];
                band = {std::min(band.low, one.low), std::max(band.high, one.high)};
            }
            return band;
        }

    private:
        double m_windowHalf;
        std::vector<Band> m_bands; ///< 5-95 %; empty where absent
    };

    /// How well a window sees a signal, relative: the energy in a cell of one frame, over that of the noise, times the
    /// root of the number of frames. A signal that moves by m cells within a window has 1/m of its energy in each.
    double visibility(double window, double cells)
    {
        return std::sqrt(window) / std::max(1.0, cells);
    }

    bool isBetterIn(const Curve &x, double window, double than)
    {
        return visibility(window, std::sqrt(x.movement2(window, 1)))
               > visibility(than, std::sqrt(x.movement2(than, 2)));
    }

    /// A track of another window in the frames of this one: interpolated between its points, or where several of these lie
    /// in the time from frame to frame, their means, over equal times before and after the frame.
    Track inFramesOf(const Analysis &own, const Analysis &other, const Track &track)
    {
        const double shift = own.threshold - other.threshold;
        const Axis &axis = frequencyOf(own);
        const auto frameOf = [&](Index frame) { return own.time().nearest(other.time().value(double(frame))); };
        const auto here = [&](double position) { return axis.position(frequencyOf(other).value(position)); };
        Track result = track.withoutPoints();
        result.isSubtracted = false; // refers to the other window, but the display shows this one
        result.windowSeconds = windowOf(other);
        result.onsetFrame = frameOf(track.onsetFrame);
        result.detectFrame = frameOf(track.detectFrame);
        result.endFrame = frameOf(track.endFrame);
        result.confirmFrame = track.confirmFrame < 0 ? -1 : frameOf(track.confirmFrame);
        result.peakStatistic += shift;
        result.detectStatistic += shift;
        const double half = 0.5 * own.time().step / other.time().step; // of the time to the next frame, in points
        for (Index frame = result.onsetFrame; frame <= result.endFrame; ++frame) {
            const double place = other.time().position(own.time().value(double(frame)));
            const double at =
                std::clamp(place - double(track.points.front().frame), 0.0, double(track.points.size() - 1));
            const auto i = std::size_t(at);
            const std::size_t next = std::min(i + 1, track.points.size() - 1);
            const auto mix = [&](double a, double b) { return std::lerp(a, b, at - double(i)); };
            const double reach = std::min({half, at, double(track.points.size() - 1) - at});
            const auto first = track.smoothed.begin() + Index(std::ceil(at - reach));
            const auto end = track.smoothed.begin() + Index(std::floor(at + reach)) + 1;
            const auto between = [&](auto value) {
                if (end - first < 2)
                    return mix(double(track.smoothed[i].*value), double(track.smoothed[next].*value));
                return std::accumulate(
                           first, end, 0.0,
                           [&](double sum, const SmoothedPoint &point) { return sum + double(point.*value); })
                       / double(end - first);
            };
            const double position = std::clamp(here(between(&SmoothedPoint::position)), 0.0, double(axis.count - 1));
            const double statistic = mix(track.points[i].statistic, track.points[next].statistic);
            result.points.push_back(
                {frame, Index(std::lround(position)), own.model.space.planeCount() / 2, statistic + shift});
            result.smoothed.push_back({position, float(here(between(&SmoothedPoint::low))),
                                       float(here(between(&SmoothedPoint::high))),
                                       float(between(&SmoothedPoint::presence)),
                                       float(between(&SmoothedPoint::level) * windowOf(own) / windowOf(other))});
        }
        return result;
    }

    PathStrip partOf(const PathStrip &strip, std::size_t from, std::size_t to)
    {
        PathStrip part{strip.firstFrame + Index(from), strip.halfWidth, {}, {}, {}};
        part.centres.assign(strip.centres.begin() + Index(from), strip.centres.begin() + Index(to));
        part.y.assign(strip.y.begin() + Index(from) * strip.width(), strip.y.begin() + Index(to) * strip.width());
        part.floor.assign(strip.floor.begin() + Index(from), strip.floor.begin() + Index(to));
        return part;
    }

    /// The points `from` … `to` - 1 of a track, with evidence of their own.
    Track partOf(const Track &track, std::size_t from, std::size_t to, double statistic)
    {
        Track part = track;
        part.keepPoints(from, to);
        part.keepDecisionsIn(part.onsetFrame, part.endFrame);
        part.peakStatistic = statistic;
        for (TrackPoint &point : part.points)
            point.statistic = std::min(point.statistic, statistic);
        return part;
    }

    /// A part of a track.
    struct PathPart {
        Track track;
        double absence; ///< most that the path lost at a stretch since the part before, nat
    };

    /// Two parts between which the path of their track loses less than the threshold.
    struct Join {
        std::size_t before; ///< numbers of their signals
        std::size_t after;
        std::shared_ptr<const Track> whole; ///< the track, in the base's frames
    };

    /// Continues a signal to the ends of a part of a track, along that. All are in the same frames.
    void prolong(Track &own, const Track &part, const Track &whole)
    {
        const auto at = [&](const auto &values, Index frame) { return values.begin() + (frame - whole.onsetFrame); };
        const auto take = [&](auto &values, const auto &from) {
            if (part.endFrame > own.endFrame)
                values.insert(values.end(), at(from, own.endFrame + 1), at(from, part.endFrame + 1));
            if (part.onsetFrame < own.onsetFrame)
                values.insert(values.begin(), at(from, part.onsetFrame), at(from, own.onsetFrame));
        };
        take(own.points, whole.points);
        take(own.smoothed, whole.smoothed);
        own.isOpen = part.endFrame > own.endFrame ? part.isOpen : own.isOpen;
        own.takeEndsOfPoints();
        own.detectFrame = std::clamp(part.detectFrame, own.onsetFrame, own.detectFrame);
        if (part.peakStatistic > own.peakStatistic) {
            own.peakStatistic = part.peakStatistic;
            own.windowSeconds = part.windowSeconds;
        }
        for (TrackPoint &point : own.points)
            point.statistic = std::min(point.statistic, own.peakStatistic);
    }

    /// Cells of the base's frames, in each of them from the lowest to the highest one.
    struct BaseCells {
        PathStrip strip;
        std::vector<Index> lowest;
        std::vector<Index> highest;

        double energyIn(Index at) const
        {
            double energy = 0.0;
            for (Index cell = lowest[std::size_t(at)]; cell <= highest[std::size_t(at)]; ++cell)
                if (const float power = strip.valueAt(at, cell); !std::isnan(power))
                    energy += double(power) - 1.0;
            return energy;
        }
    };

    /// All signals that are known, and how the tracks of other windows change them.
    class KnownSignals
    {
    public:
        explicit KnownSignals(const Analysis &base) : m_base(base), m_tracks(base.tracks)
        {
            for (const Track &track : m_tracks)
                m_curves.emplace_back(track, base);
        }

        void ask(const Analysis &other, const RunContext &context)
        {
            setOther(other);
            if (windowOf(other) < m_shortest) {
                m_shortest = windowOf(other);
                m_isTooLong = false;
            }
            std::vector<Track> signals = withEndsTrimmed(other.tracks);
            const auto unknown = std::ranges::stable_partition(
                signals, [this](const Track &track) { return isKnown(Curve(track, *m_other)); });
            const std::vector<Track> tracks = tracksToAsk({unknown.begin(), unknown.end()});
            if (tracks.empty() || other.time().count < OwnNoiseLaw::fewestFrames)
                return;
            signals.erase(unknown.begin(), unknown.end());
            signals.insert(signals.end(), tracks.begin(), tracks.end());
            m_noise = std::make_unique<OwnNoiseLaw>(ownNoiseLaw(other, signals, context.part(0.0, 0.5)));
            const Index halfWidth = m_halfWidth + levelBesideHalfWidth(m_model.binsPerCell);
            for (std::size_t first = 0; first < tracks.size();) {
                std::vector<PathStrip> strips;
                for (std::size_t bytes = 0; first + strips.size() < tracks.size() && bytes < windowStripsBytes;) {
                    strips.push_back(stripAlong(tracks[first + strips.size()], halfWidth));
                    bytes += sizeof(float) * std::size_t(strips.back().frameCount() * strips.back().width());
                }
                const auto share = [&](std::size_t i) { return 0.5 + 0.5 * double(i) / double(tracks.size()); };
                readStrips(other, strips, context.part(share(first), share(first + strips.size())),
                           "comparing windows");
                std::vector<BaseCells> cells(strips.size());
                std::vector<PathStrip *> ofBase;
                for (std::size_t i = 0; i < strips.size(); ++i)
                    if (tracks[first + i].peakStatistic * evidenceLeft(strips[i], *m_noise) < other.threshold)
                        strips[i] = {};
                    else if (isShorter()) {
                        cells[i] = cellsOf(Curve(tracks[first + i], other));
                        ofBase.push_back(&cells[i].strip);
                    }
                readStrips(m_base, std::move(ofBase), {}, "comparing windows");
                for (std::size_t i = 0; i < strips.size(); ++i)
                    if (strips[i].frameCount() > 0)
                        ask(tracks[first + i], strips[i], cells[i]);
                first += strips.size();
            }
        }

        /// Asks those tracks of the base that are left again, over the floor of stronger signals of other windows.
        void askBaseAgain(const RunContext &context)
        {
            setOther(m_base);
            for (std::size_t s = 0; s < m_tracks.size();) {
                std::vector<std::size_t> asked;
                std::vector<std::vector<std::size_t>> others;
                std::vector<PathStrip> strips;
                for (std::size_t bytes = 0; s < m_tracks.size() && bytes < windowStripsBytes; ++s)
                    if (std::vector<std::size_t> stronger = strongerOnes(s); !stronger.empty()) {
                        asked.push_back(s);
                        others.push_back(std::move(stronger));
                        strips.push_back(stripAlong(m_tracks[s], m_halfWidth));
                        bytes += sizeof(float) * std::size_t(strips.back().frameCount() * strips.back().width());
                    }
                readStrips(m_base, strips, context, "comparing windows");
                for (std::size_t i = 0; i < asked.size(); ++i)
                    keepUnexplained(asked[i], strips[i], others[i]);
            }
        }

        AskedWindows take()
        {
            joinParts();
            std::erase_if(m_tracks, [](const Track &track) { return track.points.empty(); });
            numberByDetection(m_tracks);
            return {std::move(m_tracks), m_isTooLong, knowsBetter()};
        }

    private:
        void setOther(const Analysis &other)
        {
            m_other = &other;
            m_model = bothWaysModel(other);
            m_likeness = other.frames->geometry().likeness();
            m_halfWidth = bothWaysHalfWidth(m_model.binsPerCell);
        }

        /// The signals of other windows that have more evidence than a track of the base and are, at some time, where
        /// it is.
        std::vector<std::size_t> strongerOnes(std::size_t s) const
        {
            const Curve &own = m_curves[s];
            const auto meets = [&](const Curve &other) {
                if (own.end() < other.heardFrom() - windowHalf() || own.start() > other.heardUntil() + windowHalf())
                    return false;
                for (std::size_t i = 0; i < own.count(); ++i) {
                    const double t = own.secondsAt(i);
                    const Band band = other.between(t - windowHalf(), t + windowHalf());
                    if (band.low - ownPowerCells * cellHz() <= own.hzAt(i)
                        && own.hzAt(i) <= band.high + ownPowerCells * cellHz())
                        return true;
                }
                return false;
            };
            std::vector<std::size_t> result;
            if (own.count() == 0 || m_tracks[s].windowSeconds > 0.0)
                return result;
            for (std::size_t other = 0; other < m_tracks.size(); ++other)
                if (m_tracks[other].windowSeconds > 0.0 && m_curves[other].count() > 0
                    && m_tracks[other].peakStatistic > m_tracks[s].peakStatistic && meets(m_curves[other]))
                    result.push_back(other);
            return result;
        }

        /// Keeps of a track of the base what stronger signals do not explain, from where it is first present to where it
        /// is last.
        void keepUnexplained(std::size_t s, PathStrip &strip, const std::vector<std::size_t> &stronger)
        {
            divideBySignals(strip,
                            [&](std::size_t other) { return std::ranges::find(stronger, other) != stronger.end(); });
            Track rest = m_tracks[s].withoutPoints();
            const double gain = gainOf(strip);
            if (gain >= m_base.threshold) {
                m_model.ends = {.absentBefore = true, .absentAfter = true};
                const std::vector<float> endsBy = lookBothWays(strip, m_model).endsBy;
                const auto isPresent = [](float probability) { return probability > 0.5f; };
                const auto first = std::ranges::find_if(endsBy, isPresent);
                const auto last = std::find_if(endsBy.rbegin(), endsBy.rend(), isPresent);
                if (first != endsBy.end())
                    rest = partOf(m_tracks[s], std::size_t(first - endsBy.begin()), std::size_t(endsBy.rend() - last),
                                  std::min(gain, m_tracks[s].peakStatistic));
            }
            if (rest.points.size() == m_tracks[s].points.size())
                return;
            m_tracks[s] = std::move(rest);
            m_curves[s] = Curve(m_tracks[s], m_base);
        }

        /// Joins those parts that no other window has replaced, to the first one of each path.
        void joinParts()
        {
            std::vector<std::size_t> firsts(m_tracks.size());
            std::iota(firsts.begin(), firsts.end(), std::size_t(0));
            for (const auto &[before, after, whole] : m_joins) {
                Track &own = m_tracks[firsts[before]];
                if (own.points.empty() || m_tracks[after].points.empty())
                    continue;
                prolong(own, m_tracks[after], *whole);
                m_tracks[after] = {};
                firsts[after] = firsts[before];
            }
        }

        bool knowsBetter() const
        {
            double window = std::numeric_limits<double>::infinity();
            for (const Track &track : m_base.tracks)
                if (track.windowSeconds > 0.0)
                    window = std::min(window, track.windowSeconds);
            int count = 0;
            int better = 0;
            for (std::size_t s = 0; s < m_base.tracks.size(); ++s)
                if (m_base.tracks[s].windowSeconds == window) {
                    ++count;
                    better += m_betterKnown.contains(s) ? 1 : 0;
                }
            return 2 * better > count;
        }

        /// Those tracks of the other window, the strongest first.
        std::vector<Track> tracksToAsk(std::vector<Track> tracks) const
        {
            std::erase_if(tracks, [this](const Track &track) {
                const Curve curve(track, *m_other);
                return track.peakStatistic < m_other->sureStatistic() || track.points.size() < 2
                       || kindOf(track, *m_other) == SignalKind::Spread
                       || !(isShorter() || isSeenBetter(curve) || followersOf(curve).size() > 1);
            });
            std::ranges::stable_sort(tracks, std::greater<>(), &Track::peakStatistic);
            return tracks;
        }

        bool isShorter() const { return windowOf(*m_other) < windowOf(m_base); }

        /// The cells of the base's frames within one of where x is during their windows.
        BaseCells cellsOf(const Curve &x) const
        {
            const FrameGeometry geometry = m_base.frames->geometry();
            const Axis &time = m_base.time();
            const Axis &axis = frequencyOf(m_base);
            const double half = 0.5 * geometry.windowSeconds;
            BaseCells cells;
            PathStrip &strip = cells.strip;
            strip.firstFrame = std::max<Index>(0, Index(std::floor(time.position(x.start()))));
            const Index last = std::min(time.count - 1, Index(std::ceil(time.position(x.end()))));
            for (Index frame = strip.firstFrame; frame <= last; ++frame) {
                const double t = time.value(double(frame));
                const Band band = x.between(t - half, t + half);
                const double low = band.isEmpty() ? x.at(t) : band.low;
                const double high = band.isEmpty() ? x.at(t) : band.high;
                const auto lowest = Index(std::floor(axis.position(low) - geometry.binsPerCell));
                const auto highest = Index(std::ceil(axis.position(high) + geometry.binsPerCell));
                cells.lowest.push_back(lowest);
                cells.highest.push_back(highest);
                strip.centres.push_back((lowest + highest) / 2);
                strip.halfWidth = std::max(strip.halfWidth, highest - strip.centres.back());
            }
            return cells;
        }

        /// Whether the base's frames hold the power of a part of a track of a shorter window, rather than none of it,
        /// where it moves while a window of the base lasts: a line has the same energy in both. Without it, the base
        /// counts that power as noise.
        bool hasItsEnergyInBase(const Curve &part, const Track &track, const BaseCells &cells) const
        {
            const FrameGeometry geometry = m_base.frames->geometry();
            const auto place = [&](double seconds) {
                return m_base.time().position(seconds) - double(cells.strip.firstFrame);
            };
            const auto first = std::max<Index>(0, Index(std::floor(place(part.start()))));
            const auto last = std::min(cells.strip.frameCount() - 1, Index(std::ceil(place(part.end()))));
            double energy = 0.0;
            for (Index at = first; at <= last; ++at)
                energy += cells.energyIn(at);
            double bins = 0.0; // that a line fills, at its largest power
            const double lobe = std::ceil(mainLobeHalfWidth(geometry.window) * geometry.binsPerCell);
            for (double bin = -lobe; bin <= lobe; bin += 1.0)
                bins += leakageAt(geometry.window, std::abs(bin) / geometry.binsPerCell);
            double own = 0.0;
            for (std::size_t i = 0; i < track.points.size(); ++i)
                own += track.isPresent(i) ? double(track.smoothed[i].level) : 0.0;
            return energy / bins > 0.5 * own;
        }

        bool isSeenBetter(const Curve &x) const { return isBetterIn(x, windowOf(*m_other), windowOf(m_base)); }

        double cellHz() const { return 1.0 / std::min(windowOf(m_base), windowOf(*m_other)); } ///< of the coarser one
        double windowHalf() const { return 0.5 * windowOf(*m_other); }

        /// Whether a signal explains all of the track, without any question to the frames.
        bool isKnown(const Curve &x) const
        {
            return std::ranges::any_of(m_curves, [&](const Curve &curve) {
                bool isIn = curve.count() > 0;
                for (std::size_t i = 0; isIn && i < x.count(); ++i) {
                    const double t = x.secondsAt(i);
                    const Band band = curve.between(t - windowHalf(), t + windowHalf());
                    isIn = band.low - ownPowerCells * cellHz() <= x.hzAt(i)
                           && x.hzAt(i) <= band.high + ownPowerCells * cellHz();
                }
                return isIn;
            });
        }

        /// The known signals that lie where x is in four of five of their frames.
        std::vector<std::size_t> followersOf(const Curve &x) const
        {
            std::vector<std::size_t> result;
            for (std::size_t s = 0; s < m_curves.size(); ++s) {
                const Curve &curve = m_curves[s];
                if (curve.count() == 0 || curve.start() > x.end() + windowHalf()
                    || curve.end() < x.start() - windowHalf())
                    continue;
                double near = 0.0;
                double count = 0.0;
                for (std::size_t i = 0; i < curve.count(); ++i) {
                    if (!curve.isPresent(i))
                        continue;
                    count += 1.0;
                    const double t = curve.secondsAt(i);
                    if (t < x.start() - windowHalf() || t > x.end() + windowHalf())
                        continue;
                    const auto [low, high] =
                        std::minmax({x.at(t), x.at(t - 0.5 * windowOf(m_base)), x.at(t + 0.5 * windowOf(m_base))});
                    near += low - cellHz() <= curve.hzAt(i) && curve.hzAt(i) <= high + cellHz() ? 1.0 : 0.0;
                }
                if (count > 0.0 && near >= followedShare * count)
                    result.push_back(s);
            }
            return result;
        }

        /// Whether these signals are pieces of x: each lasts less than half as long, or they follow one after the other.
        bool areOnePath(const std::vector<std::size_t> &pieces, const Curve &x) const
        {
            double longest = 0.0;
            std::vector<std::pair<double, double>> times;
            for (const std::size_t s : pieces) {
                longest = std::max(longest, m_curves[s].duration());
                times.emplace_back(m_curves[s].start(), m_curves[s].end());
            }
            if (!pieces.empty() && 2.0 * longest < x.duration())
                return true;
            std::ranges::sort(times);
            for (std::size_t i = 1; i < times.size(); ++i)
                if (times[i].first < times[i - 1].second - windowOf(m_base))
                    return false;
            return times.size() > 1;
        }

        bool isBetterKnown(const Track &x, const std::vector<std::size_t> &pieces) const
        {
            return std::ranges::all_of(pieces, [&](std::size_t s) {
                return m_tracks[s].peakStatistic - m_base.threshold < x.peakStatistic - m_other->threshold;
            });
        }

        void ask(const Track &x, const PathStrip &strip, const BaseCells &cells)
        {
            const Curve curve(x, *m_other);
            const std::vector<std::size_t> pieces = followersOf(curve);
            const bool isBetter = isSeenBetter(curve);
            for (const std::size_t s : pieces)
                if (isBetterKnown(x, {s}))
                    m_betterKnown.insert(s);
            if ((isBetter || pieces.size() > 1) && areOnePath(pieces, curve))
                if (const std::vector<PathPart> parts = partsOf(x, strip, pieces); !parts.empty()) {
                    const Index first = x.points.front().frame;
                    const auto statistic = [](const PathPart &part) { return part.track.peakStatistic; };
                    const Track whole = partOf(x, std::size_t(parts.front().track.onsetFrame - first),
                                               std::size_t(parts.back().track.endFrame + 1 - first),
                                               statistic(std::ranges::max(parts, {}, statistic)));
                    const Curve path(whole, *m_other);
                    const std::vector<std::size_t> own = followersOf(path);
                    if (areOnePath(own, path) && isBetterKnown(whole, own)) {
                        noteMovement(path);
                        return replace(inFramesOf(m_base, *m_other, whole), own);
                    }
                }
            if (!isBetter && !isShorter())
                return;
            constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
            std::size_t last = none; // the signal that was added for the part before
            const auto whole = std::make_shared<const Track>(inFramesOf(m_base, *m_other, x));
            for (const auto &[part, absence] : partsOf(x, strip, {})) {
                const std::size_t before = std::exchange(last, none);
                const Curve alone(part, *m_other);
                const bool isInPiece = std::ranges::any_of(pieces, [&](std::size_t s) {
                    return alone.start() >= m_curves[s].heardFrom() && alone.end() <= m_curves[s].heardUntil();
                });
                if (isInPiece
                    || !((isBetter && isSeenBetter(alone)) || (isShorter() && hasItsEnergyInBase(alone, part, cells))))
                    continue;
                noteMovement(alone);
                Track known = inFramesOf(m_base, *m_other, part);
                const auto piece = std::ranges::find_if(
                    pieces, [&](std::size_t s) { return areConnected(m_tracks[s], known, *whole, x); });
                if (piece != pieces.end()) {
                    prolong(m_tracks[*piece], known, *whole);
                    m_curves[*piece] = Curve(m_tracks[*piece], m_base);
                    continue;
                }
                last = m_tracks.size();
                if (before != none && absence < m_other->threshold)
                    m_joins.push_back({before, last, whole});
                add(std::move(known));
            }
        }

        /// The parts of a track in which it is present over the floor of all signals but some, and that have sufficient
        /// evidence alone, which is their statistic.
        std::vector<PathPart> partsOf(const Track &x, PathStrip strip, const std::vector<std::size_t> &leftOut)
        {
            divideBySignals(strip, [&](std::size_t s) { return std::ranges::find(leftOut, s) == leftOut.end(); });
            divideByAreas(strip);
            divideBySurroundings(strip, x);
            std::vector<PathPart> result;
            if (gainOf(strip) < m_other->sureStatistic())
                return result;
            m_model.ends = {.absentBefore = true, .absentAfter = true};
            const BothWays seen = lookBothWays(strip, m_model);
            const auto isPresent = [&](std::size_t i) { return seen.endsBy[i] > 0.5f; };
            double loss = 0.0;
            double absence = 0.0;
            for (std::size_t from = 0, to = 0; from < seen.endsBy.size(); from = to) {
                const double before = absence;
                for (; to < seen.endsBy.size() && isPresent(to) == isPresent(from); ++to) {
                    loss = std::max(0.0, loss - seen.gains[to]);
                    absence = std::max(absence, loss);
                }
                if (!isPresent(from) || to - from < 2)
                    continue;
                const PathStrip part = partOf(strip, from, to);
                const double gain = gainOf(part);
                if (gain * evidenceLeft(part, *m_noise) < m_other->sureStatistic())
                    continue;
                result.push_back({partOf(x, from, to, gain), before});
                loss = absence = 0.0;
            }
            return result;
        }

        double gainOf(const PathStrip &strip)
        {
            setLnK(m_model, *m_other, strip);
            return strongestIn(strip, m_model);
        }

        WindowShape shape() const { return m_other->frames->geometry().window; }

        /// Divides y by the floor of some known signals.
        template <class IsTaken>
        void divideBySignals(PathStrip &strip, IsTaken isTaken) const
        {
            std::vector<float> floor(strip.y.size(), 1.0f);
            const double first = m_other->time().value(double(strip.firstFrame));
            const double last = m_other->time().value(double(strip.firstFrame + strip.frameCount() - 1));
            for (std::size_t s = 0; s < m_curves.size(); ++s)
                if (m_curves[s].count() > 0 && isTaken(s) && m_curves[s].heardFrom() - windowHalf() <= last
                    && m_curves[s].heardUntil() + windowHalf() >= first)
                    raise(floor, strip, s);
            divide(strip, floor);
        }

        static void divide(PathStrip &strip, const std::vector<float> &floor)
        {
            strip.floor.resize(std::size_t(strip.frameCount()), 1.0f);
            for (std::size_t i = 0; i < strip.y.size(); ++i)
                strip.y[i] /= floor[i];
            for (Index at = 0; at < strip.frameCount(); ++at)
                strip.floor[std::size_t(at)] *= floor[std::size_t(at * strip.width() + strip.halfWidth)];
        }

        /// Raises the floor by a known signal, whose power is the largest in its band.
        void raise(std::vector<float> &floor, const PathStrip &strip, std::size_t s) const
        {
            const Axis &axis = frequencyOf(*m_other);
            const Curve &signal = m_curves[s];
            const double coarser =
                std::max(1.0, windowOf(*m_other) / windowOf(m_tracks[s], m_base)) * m_model.binsPerCell; // bins
            for (Index at = 0; at < strip.frameCount(); ++at) {
                const double t = m_other->time().value(double(strip.firstFrame + at));
                const Band band = signal.between(t - windowHalf(), t + windowHalf());
                if (band.isEmpty())
                    continue;
                const double low = axis.position(band.low);
                const double high = axis.position(band.high);
                const Index from = std::max(strip.firstCell(at), Index(std::ceil(low - ownPowerCells * coarser)));
                const Index to = std::min(strip.firstCell(at) + strip.width() - 1,
                                          Index(std::floor(high + ownPowerCells * coarser)));
                float power = 1.0f;
                for (Index cell = from; cell <= to; ++cell)
                    power = std::fmax(power, strip.valueAt(at, cell));
                for (Index i = 0; power > 1.0f && i < strip.width(); ++i) {
                    const auto cell = double(strip.firstCell(at) + i);
                    const double distance = std::max({0.0, low - cell, cell - high}) / coarser;
                    floor[std::size_t(at * strip.width() + i)] *=
                        float(1.0 + explainedPowerFactor * double(power - 1.0f) * leakageBound(shape(), distance));
                }
            }
        }

        /// Divides y by the level of the base's areas.
        void divideByAreas(PathStrip &strip) const
        {
            std::vector<float> levels(strip.y.size(), 1.0f);
            for (const Area &area : m_base.areas) {
                const Axis &own = frequencyOf(m_base);
                const auto frame = [&](Index of, double shift) {
                    return m_other->time().position(m_base.time().value(double(of)) + shift) - double(strip.firstFrame);
                };
                const auto cell = [&](Index of) { return frequencyOf(*m_other).position(own.value(double(of))); };
                const auto first = std::max<Index>(0, Index(std::ceil(frame(area.firstFrame, -windowHalf()))));
                const auto last =
                    std::min(strip.frameCount() - 1, Index(std::floor(frame(area.lastFrame, windowHalf()))));
                for (Index at = first; at <= last; ++at)
                    for (Index i = 0; i < strip.width(); ++i)
                        if (const auto here = double(strip.firstCell(at) + i);
                            cell(area.firstCell) <= here && here <= cell(area.lastCell)) {
                            float &level = levels[std::size_t(at * strip.width() + i)];
                            level = std::max(level, float(area.level));
                        }
            }
            divide(strip, levels);
        }

        /// Divides y by the raised level of the surroundings of x, measured without its own leakage.
        void divideBySurroundings(PathStrip &strip, const Track &x) const
        {
            std::vector<double> positions;
            std::vector<double> own;
            for (const SmoothedPoint &point : x.smoothed) {
                positions.push_back(point.position);
                own.push_back(double(point.level));
            }
            const PathStrip beside = withoutLine(strip, positions, own, shape(), m_model.binsPerCell);
            const std::vector<double> levels = areaLevels(beside, positions, m_model.binsPerCell, m_likeness);
            for (Index at = 0; at < strip.frameCount(); ++at) {
                for (float &y : std::span(strip.row(at), std::size_t(strip.width())))
                    y /= float(levels[std::size_t(at)]);
                strip.floor[std::size_t(at)] *= float(levels[std::size_t(at)]);
            }
        }

        void noteMovement(const Curve &known)
        {
            const double window = windowOf(*m_other);
            m_isTooLong =
                m_isTooLong || (isShorter() && window == m_shortest && isBetterIn(known, 0.25 * window, window));
        }

        /// Whether the track x of the other window, in the base's frames `whole`, is present all the way between two tracks
        /// of these frames.
        bool areConnected(const Track &a, const Track &b, const Track &whole, const Track &x) const
        {
            if (a.endFrame + 1 < whole.onsetFrame || a.onsetFrame > whole.endFrame + 1)
                return false;
            const double from = m_base.time().value(double(std::min(a.endFrame, b.endFrame)));
            const double to = m_base.time().value(double(std::max(a.onsetFrame, b.onsetFrame)));
            for (std::size_t i = 0; i < x.points.size(); ++i)
                if (const double t = m_other->time().value(double(x.points[i].frame));
                    from < t && t < to && !x.isPresent(i))
                    return false;
            return true;
        }

        void add(Track track)
        {
            m_curves.emplace_back(track, m_base);
            m_tracks.push_back(std::move(track));
        }

        void replace(Track track, const std::vector<std::size_t> &pieces)
        {
            for (const std::size_t s : pieces) {
                track.isSubtracted = track.isSubtracted || m_tracks[s].isSubtracted;
                track.detectFrame = std::clamp(m_tracks[s].detectFrame, track.onsetFrame, track.detectFrame);
                m_tracks[s] = m_tracks[s].withoutPoints();
                m_curves[s] = Curve(m_tracks[s], m_base);
            }
            add(std::move(track));
        }

        const Analysis &m_base;
        std::vector<Track> m_tracks; ///< without points: replaced
        std::vector<Curve> m_curves; ///< of these
        std::vector<Join> m_joins;   ///< in the order in which the parts were added
        const Analysis *m_other = nullptr;
        double m_shortest = std::numeric_limits<double>::infinity(); ///< window of those asked, s
        bool m_isTooLong = false;                                    ///< see AskedWindows, as the next
        std::set<std::size_t> m_betterKnown;
        BothWaysModel m_model;   ///< of the other window
        double m_likeness = 1.0; ///< of its cells
        Index m_halfWidth = 0;   ///< bins beside a path in which it is looked at
        std::unique_ptr<OwnNoiseLaw> m_noise;
    };

} // namespace

AskedWindows withOtherWindows(const Analysis &base, std::span<const std::shared_ptr<const Analysis>> others,
                              const RunContext &context)
{
    KnownSignals signals(base);
    const auto mostEvidence = [](const std::shared_ptr<const Analysis> &other) {
        double most = 0.0;
        for (const Track &track : other->tracks)
            most = std::max(most, track.peakStatistic - other->threshold);
        return most;
    };
    std::vector<std::shared_ptr<const Analysis>> byEvidence(others.begin(), others.end());
    std::ranges::stable_sort(byEvidence, std::greater<>(), mostEvidence);
    const auto count = double(byEvidence.size());
    for (std::size_t i = 0; i < byEvidence.size(); ++i) {
        signals.ask(*byEvidence[i], context.part(double(i) / count, double(i + 1) / count));
        signals.askBaseAgain(context.part(double(i + 1) / count, double(i + 1) / count));
    }
    return signals.take();
}

} // namespace faintline
