#include "inspect/noiseLaw.h"

#include "base/Random.h"
#include "frames/Spectrogram.h"
#include "noise/noiseStreams.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace faintline {

namespace {

    constexpr Index settlingFrames = 100;
    constexpr Index stretchFrames = 400; ///< including them
    constexpr Index leastCounted = 20;
    constexpr double mostCellFrames = 4e6;
    constexpr double blockCellFrames = 3e5; ///< of simulated noise
    constexpr int referenceBlocks = 12;
    constexpr double clusterVariance = 16.0; ///< of the fraction, relative to independent states
    constexpr Index tileCells = 16;
    constexpr Index tileFrames = 50;
    constexpr double rareExceedanceProbability = 1e-4; ///< fraction of cells and frames of noise
    constexpr double quietShare = 0.25;                ///< of the tiles
    constexpr double deviations = 4.0;
    constexpr double normaliserErrorShare = 0.01;
    constexpr Index skirtLimitCells = 50; ///< resolution cells
    constexpr double noiseMean = 1.1;
    constexpr double overlap = 1.3; ///< standard deviation of a mean over overlapping frames, relative to independent
                                    ///< ones

    /// Part of a track that lies in a stretch, with the power around it.
    struct TrackInStretch {
        std::vector<TrackPoint> points;
        std::vector<double> below; ///< Σ y at 0, 1, 2 … bins below the track
        std::vector<double> above;
        Index lowest = 0; ///< offsets of cells that do not count as noise
        Index highest = 0;
    };

    std::vector<TrackInStretch> piecesOf(const std::vector<Track> &tracks, Index first, Index end)
    {
        std::vector<TrackInStretch> pieces;
        for (const Track &track : tracks) {
            TrackInStretch piece;
            std::copy_if(track.points.begin(), track.points.end(), std::back_inserter(piece.points),
                         [&](const TrackPoint &point) { return point.frame >= first && point.frame < end; });
            if (!piece.points.empty())
                pieces.push_back(std::move(piece));
        }
        return pieces;
    }

    /// The points of all pieces, by frame.
    std::multimap<Index, std::pair<TrackInStretch *, Index>> byFrame(std::vector<TrackInStretch> &pieces)
    {
        std::multimap<Index, std::pair<TrackInStretch *, Index>> points;
        for (TrackInStretch &piece : pieces)
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

    /// Families and several channels have no simulated noise to compare with, so that nothing is left out of theirs.
    bool isPlain(const AnalysisSettings &settings)
    {
        return !settings.family.isSum(channelCount(settings.selection));
    }

    double loudestOf(const AnalysisPlan &plan)
    {
        return isPlain(plan.settings) ? plan.calibration->levelExceededBy(rareExceedanceProbability)
                                      : std::numeric_limits<double>::infinity();
    }

    /// Cells on either side of a track that do not count as noise.
    Index inhibitedBins(const AnalysisSettings &settings)
    {
        return Index(std::ceil(settings.decide.inhibitCells.front() * settings.spectrogram.binsPerCell));
    }

    bool isUnknown(float y)
    {
        return std::isnan(y);
    }

    bool isSilent(float y)
    {
        return !(y > 0.0f); // or unknown
    }

    /// The fraction of states whose path continues, in tiles of cells and frames. Tiles in which the statistic exceeds
    /// what is rare on noise, or cells were not observed, are left out.
    class ContinuedFractions
    {
    public:
        explicit ContinuedFractions(const AnalysisPlan &plan)
            : m_loudest(float(loudestOf(plan))), m_likelihood(plan.model.likelihood),
              m_planes(plan.model.space.planeCount()), m_lambda(std::size_t(plan.model.space.cellCount())),
              m_continued(std::size_t(std::max<Index>(1, plan.model.space.cellCount() / tileCells)), 0.0)
        {
            const auto columns = std::ssize(m_continued);
            for (Index column = 0; column <= columns; ++column)
                m_columnCells.push_back((column * std::ssize(m_lambda) + columns - 1) / columns);
        }

        void add(std::span<const float> y, std::span<const float> statistic, const Smd &detector)
        {
            m_likelihood.apply(y, m_lambda);
            for (std::size_t column = 0; column < m_continued.size(); ++column) {
                const auto first = std::size_t(m_columnCells[column]);
                const std::size_t width = std::size_t(m_columnCells[column + 1]) - first;
                const std::span<const float> own = statistic.subspan(first, width);
                m_isLeftOut[column] = m_isLeftOut[column] || *std::ranges::max_element(own) > m_loudest
                                      || std::ranges::any_of(y.subspan(first, width), isUnknown);
                int continued = 0;
                for (const float *scores = detector.scores().data() + first, *end = scores + m_planes * std::ssize(y);
                     scores < end; scores += y.size())
                    for (std::size_t i = 0; i < width; ++i)
                        continued += scores[i] > m_lambda[first + i] ? 1 : 0;
                m_continued[column] += continued;
            }
            m_frames += 1.0;
            if (++m_tileFrames == tileFrames)
                close();
        }

        /// Ends the tiles, before a stretch that does not continue the last one; short ones count with the next.
        void close()
        {
            if (m_tileFrames == 0 || (2 * m_tileFrames < tileFrames && !m_fractions.empty()))
                return;
            for (std::size_t column = 0; column < m_continued.size(); ++column)
                if (const Index width = m_columnCells[column + 1] - m_columnCells[column]; !m_isLeftOut[column])
                    m_fractions.push_back(m_continued[column] / double(m_planes * width * m_tileFrames));
            std::fill(m_continued.begin(), m_continued.end(), 0.0);
            m_isLeftOut.assign(m_continued.size(), false);
            m_tileFrames = 0;
        }

        double frames() const { return m_frames; }
        bool isEmpty() const { return m_fractions.empty(); }

        double mean() const
        {
            return std::accumulate(m_fractions.begin(), m_fractions.end(), 0.0) / double(m_fractions.size());
        }

        double lowerQuartile() const
        {
            std::vector<double> sorted = m_fractions;
            const auto at = sorted.begin() + Index(quietShare * double(sorted.size()));
            std::nth_element(sorted.begin(), at, sorted.end());
            return *at;
        }

    private:
        float m_loudest;
        Likelihood m_likelihood;
        Index m_planes;
        std::vector<float> m_lambda;
        std::vector<Index> m_columnCells; ///< first cell of each column, and the end
        std::vector<double> m_continued;  ///< states in the current tile of each column of cells
        std::vector<bool> m_isLeftOut = std::vector<bool>(m_continued.size(), false);
        std::vector<double> m_fractions; ///< of all tiles
        Index m_tileFrames = 0;
        double m_frames = 0.0;
    };

    /// The detector on stretches of the recording, signals replaced by simulated noise.
    class NoiseOutsideTracks
    {
    public:
        NoiseOutsideTracks(const Analysis &analysis, const SmdSettings &smd, const RunContext &context)
            : m_analysis(analysis), m_frames(*analysis.frames), m_context(context),
              m_rule(resetRule(smd, analysis.calibration->lnK)), m_y(std::size_t(m_frames.grid().size())),
              m_statistic(m_y.size()), m_fractions(analysis)
        {
        }

        const ResetRule &rule() const { return m_rule; }

        /// The fraction of paths that continue, in evenly spread stretches.
        const ContinuedFractions &continuedFractions(Index length, Index stretches)
        {
            const Index count = m_frames.time().count;
            for (Index i = 0; i < stretches; ++i) {
                const Index first = stretches == 1 ? (count - length) / 2 : i * (count - length) / (stretches - 1);
                examine(first, first + length,
                        m_context.part(double(i) / double(stretches), double(i + 1) / double(stretches)));
            }
            return m_fractions;
        }

    private:
        using PointsByFrame = std::multimap<Index, std::pair<TrackInStretch *, Index>>;

        void examine(Index first, Index end, const RunContext &context)
        {
            std::vector<TrackInStretch> pieces = piecesOf(m_analysis.tracks, first, end);
            const PointsByFrame points = byFrame(pieces);
            findSkirts(pieces, points);
            Smd detector(m_analysis.model, m_rule);
            Index seen = 0;
            for (Index frame = first; frame < end; ++frame) {
                context.checkpoint(double(frame - first) / double(end - first), checking);
                m_frames.read(frame, 1, m_y);
                if (std::ranges::all_of(m_y, isSilent)) // a gap, or no noise at all
                    continue;
                putNoiseOver(points, frame);
                detector.update(m_y, m_statistic);
                if (++seen > settlingFrames)
                    m_fractions.add(m_y, m_statistic, detector);
            }
            m_fractions.close();
        }

        /// Determines how far the tracks' power reaches on either side.
        void findSkirts(std::vector<TrackInStretch> &pieces, const PointsByFrame &points)
        {
            const int binsPerCell = m_analysis.settings.spectrogram.binsPerCell;
            const Index least = inhibitedBins(m_analysis.settings);
            const auto widest = std::max(least + 1, skirtLimitCells * binsPerCell);
            const Index cells = std::ssize(m_y);
            for (TrackInStretch &piece : pieces) {
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
            for (TrackInStretch &piece : pieces) {
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
        ContinuedFractions m_fractions;
    };

    /// The lower quartile on white noise, and its standard deviation, for so many frames.
    struct ExpectedFraction {
        double mean = 0.0;
        double deviation = 0.0;
    };

    /// From simulated noise in blocks: paths that branch freely make the fractions of all tiles rise and fall together.
    ExpectedFraction onWhiteNoise(const AnalysisPlan &plan, const ResetRule &rule, double seenFrames,
                                  const RunContext &context)
    {
        const Index cells = plan.model.space.cellCount();
        const SpectrogramSettings &settings = plan.settings.spectrogram;
        const auto noise = spectralNoise(settings, int((cells + settings.binsPerCell - 1) / settings.binsPerCell));
        const auto frames = Index(std::min(seenFrames, std::max(double(tileFrames), blockCellFrames / double(cells))));
        Random random(7001, 0);
        Smd detector(plan.model, rule);
        std::vector<float> y(static_cast<std::size_t>(cells));
        std::vector<float> statistic(y.size());
        double sum = 0.0;
        double squares = 0.0;
        for (int block = 0; block < referenceBlocks; ++block) {
            ContinuedFractions fractions(plan);
            const Index settling = block == 0 ? settlingFrames : 0;
            for (Index frame = 0; frame < settling + frames; ++frame) {
                context.checkpoint(double(block) / referenceBlocks, "simulating noise for comparison");
                noise->next(random, y);
                detector.update(y, statistic);
                if (frame >= settling)
                    fractions.add(y, statistic, detector);
            }
            fractions.close();
            const double fraction = fractions.lowerQuartile();
            sum += fraction;
            squares += fraction * fraction;
        }
        const double mean = sum / referenceBlocks;
        const double variance = (squares / referenceBlocks - mean * mean) * referenceBlocks / (referenceBlocks - 1);
        return {mean, std::sqrt(std::max(0.0, variance) * (double(frames) / seenFrames + 1.0 / referenceBlocks))};
    }

} // namespace

std::string NoiseLawCheck::warning() const
{
    if (isFollowed())
        return {};
    char text[300];
    std::snprintf(
        text, sizeof text,
        "the noise outside tracks differs from that of the calibration: in its quieter parts %.1f %% of paths "
        "continue, %.1f … %.1f %% are expected; expect %s false alarms than specified",
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
    const RunContext looking = context.part(0.0, 0.5);
    NoiseOutsideTracks outside(analysis, *smd, looking);
    NoiseLawCheck law;
    const ContinuedFractions &found = outside.continuedFractions(length, stretches);
    if (found.frames() < double(leastCounted) || found.isEmpty())
        return {};
    double half = normaliserErrorShare;
    if (isPlain(analysis.settings)) {
        const ExpectedFraction expected =
            onWhiteNoise(analysis, outside.rule(), found.frames(), context.part(0.5, 1.0));
        law.found = found.lowerQuartile();
        law.expected = expected.mean;
        half += deviations * expected.deviation;
    } else {
        const double p = analysis.calibration->continuedFraction;
        law.found = found.mean();
        law.expected = p;
        half += deviations * std::sqrt(clusterVariance * p * (1.0 - p) / (found.frames() * double(cells)))
                + 1.0 / double(cells);
    }
    law.band = {law.expected - half, law.expected + half};
    return law;
}

} // namespace faintline
