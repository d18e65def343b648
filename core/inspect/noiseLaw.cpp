#include "inspect/noiseLaw.h"

#include "base/Random.h"
#include "detect/Smd.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>
#include <utility>

namespace faintline {

namespace {

    constexpr Index settlingFrames = 100;
    constexpr Index stretchFrames = 400; ///< including them
    constexpr Index leastCounted = 20;
    constexpr double mostCellFrames = 4e6;
    constexpr double clusterVariance = 16.0; ///< of the fraction, relative to independent states
    constexpr double deviations = 4.0;
    constexpr double tolerance = 0.01;
    constexpr Index widestSkirt = 50; ///< resolution cells
    constexpr double noiseMean = 1.1;
    constexpr double overlap = 1.3; ///< standard deviation of a mean over overlapping frames, relative to independent
                                    ///< ones

    /// Part of a track that lies in a stretch, with the power around it.
    struct Piece {
        std::vector<TrackPoint> points;
        std::vector<double> below; ///< Σ y at 0, 1, 2 … bins below the track
        std::vector<double> above;
        Index lowest = 0; ///< offsets of cells that do not count as noise
        Index highest = 0;
    };

    std::vector<Piece> piecesOf(const std::vector<Track> &tracks, Index first, Index end)
    {
        std::vector<Piece> pieces;
        for (const Track &track : tracks) {
            Piece piece;
            std::copy_if(track.points.begin(), track.points.end(), std::back_inserter(piece.points),
                         [&](const TrackPoint &point) { return point.frame >= first && point.frame < end; });
            if (!piece.points.empty())
                pieces.push_back(std::move(piece));
        }
        return pieces;
    }

    /// The points of all pieces, by frame.
    std::multimap<Index, std::pair<Piece *, Index>> byFrame(std::vector<Piece> &pieces)
    {
        std::multimap<Index, std::pair<Piece *, Index>> points;
        for (Piece &piece : pieces)
            for (const TrackPoint &point : piece.points)
                points.emplace(point.frame, std::pair(&piece, point.cell));
        return points;
    }

    /// Distance from a track at which the power along it falls to the noise.
    Index endOfSkirt(const std::vector<double> &sums, Index least, Index frames)
    {
        const double highest = (noiseMean + 2.0 * overlap / std::sqrt(double(frames))) * double(frames);
        Index end = least;
        while (end + 1 < std::ssize(sums) && (sums[std::size_t(end)] > highest || sums[std::size_t(end + 1)] > highest))
            ++end;
        return end;
    }

    /// The detector on stretches of the recording, signals replaced by simulated noise.
    class NoiseOutsideTracks
    {
    public:
        NoiseOutsideTracks(const Analysis &analysis, const SmdSettings &smd, const RunContext &context)
            : m_analysis(analysis), m_frames(*analysis.frames), m_context(context),
              m_rule(resetRule(smd, analysis.calibration->lnK)), m_y(std::size_t(m_frames.grid().size())),
              m_statistic(m_y.size())
        {
        }

        /// Mean fraction of paths that continue, in evenly spread stretches.
        double continuedFraction(Index length, Index stretches)
        {
            const Index count = m_frames.time().count;
            for (Index i = 0; i < stretches; ++i) {
                const Index first = stretches == 1 ? (count - length) / 2 : i * (count - length) / (stretches - 1);
                lookAt(first, first + length,
                       m_context.part(double(i) / double(stretches), double(i + 1) / double(stretches)));
            }
            return m_counted > 0.0 ? m_sum / m_counted : 0.0;
        }

        double counted() const { return m_counted; }

    private:
        using PointsByFrame = std::multimap<Index, std::pair<Piece *, Index>>;

        void lookAt(Index first, Index end, const RunContext &context)
        {
            std::vector<Piece> pieces = piecesOf(m_analysis.tracks, first, end);
            const PointsByFrame points = byFrame(pieces);
            findSkirts(pieces, points);
            Smd detector(m_analysis.model, m_rule);
            Index seen = 0;
            for (Index frame = first; frame < end; ++frame) {
                context.checkpoint(double(frame - first) / double(end - first), checking);
                m_frames.read(frame, 1, m_y);
                if (std::isnan(m_y.front())) // a gap, in which all cells are unknown
                    continue;
                putNoiseOver(points, frame);
                detector.update(m_y, m_statistic);
                if (++seen <= settlingFrames)
                    continue;
                m_sum += detector.regulation().continuedFraction;
                m_counted += 1.0;
            }
        }

        /// Determines how far the tracks' power reaches on either side.
        void findSkirts(std::vector<Piece> &pieces, const PointsByFrame &points)
        {
            const int binsPerCell = m_analysis.settings.spectrogram.binsPerCell;
            const auto least = Index(std::ceil(m_analysis.settings.decide.inhibitCells.front() * binsPerCell));
            const auto widest = std::max(least + 1, widestSkirt * binsPerCell);
            const Index cells = std::ssize(m_y);
            for (Piece &piece : pieces) {
                piece.below.resize(std::size_t(widest));
                piece.above.resize(std::size_t(widest));
            }
            for (auto it = points.begin(); it != points.end();) {
                m_context.checkpoint(0.0, checking);
                const Index frame = it->first;
                m_frames.read(frame, 1, m_y);
                std::replace_if(
                    m_y.begin(), m_y.end(), [](float y) { return y != y; }, 0.0f);
                for (; it != points.end() && it->first == frame; ++it) {
                    auto &[piece, cell] = it->second;
                    for (Index offset = 0; offset < widest; ++offset) {
                        const auto at = std::size_t(offset);
                        piece->below[at] += double(m_y[std::size_t(std::max<Index>(0, cell - offset))]);
                        piece->above[at] += double(m_y[std::size_t(std::min(cells - 1, cell + offset))]);
                    }
                }
            }
            for (Piece &piece : pieces) {
                piece.lowest = -endOfSkirt(piece.below, least, std::ssize(piece.points));
                piece.highest = endOfSkirt(piece.above, least, std::ssize(piece.points));
            }
        }

        void putNoiseOver(const PointsByFrame &points, Index frame)
        {
            const auto [from, to] = points.equal_range(frame);
            for (auto it = from; it != to; ++it) {
                const auto &[piece, centre] = it->second;
                const Index last = std::min(std::ssize(m_y) - 1, centre + piece->highest);
                for (Index cell = std::max<Index>(0, centre + piece->lowest); cell <= last; ++cell)
                    m_y[std::size_t(cell)] = float(m_random.exponential());
            }
        }

        static constexpr const char *checking = "checking the noise outside tracks";
        const Analysis &m_analysis;
        const NormalisedFrames &m_frames;
        const RunContext &m_context;
        ResetRule m_rule;
        Random m_random{7000, 0};
        std::vector<float> m_y;
        std::vector<float> m_statistic;
        double m_sum = 0.0;
        double m_counted = 0.0;
    };

} // namespace

std::string NoiseLawCheck::warning() const
{
    if (isFollowed())
        return {};
    char text[200];
    std::snprintf(text, sizeof text,
                  "the noise outside tracks differs from that of the calibration: %.1f %% of paths continue, %.1f … "
                  "%.1f %% are expected; expect %s false alarms than specified",
                  100.0 * found, 100.0 * band.low, 100.0 * band.high, isMore() ? "more" : "fewer");
    return text;
}

std::optional<NoiseLawCheck> checkNoiseLaw(const Analysis &analysis, const RunContext &context)
{
    const auto *smd = std::get_if<SmdSettings>(&analysis.settings.detector);
    const bool isFixed =
        smd && (smd->reset == SmdSettings::Reset::Calibrated || smd->reset == SmdSettings::Reset::Fixed);
    const Index count = analysis.time().count;
    const Index cells = analysis.grid().size();
    if (!isFixed || !analysis.recording || !analysis.calibration || count < settlingFrames + leastCounted)
        return {};
    const Index length = std::min(stretchFrames, count);
    const auto stretches = std::clamp<Index>(Index(mostCellFrames / double(length * cells)), 1, count / length);
    NoiseOutsideTracks noise(analysis, *smd, context);
    NoiseLawCheck law;
    law.expected = analysis.calibration->continuedFraction;
    law.found = noise.continuedFraction(length, stretches);
    if (noise.counted() < double(leastCounted))
        return {};
    const double sigma =
        std::sqrt(clusterVariance * law.expected * (1.0 - law.expected) / (noise.counted() * double(cells)));
    const double half = deviations * sigma + tolerance + 1.0 / double(cells);
    law.band = {law.expected - half, law.expected + half};
    return law;
}

} // namespace faintline
