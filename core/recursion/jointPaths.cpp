#include "recursion/jointPaths.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace faintline {

namespace {

    constexpr Index ratesPerCell = 8;
    constexpr Index rateCount = 9; ///< -1/2 … 1/2 cell per frame
    constexpr Index blockFrames = 512;
    constexpr Index lagFrames = 128;
    constexpr float impossible = -1e30f;

    /// Where a pair of paths is.
    struct Pair {
        Index p, r, q, s;
    };

    class JointViterbi
    {
    public:
        JointViterbi(PathStrip strip, const Likelihood &likelihood, Index apart)
            : m_strip(std::move(strip)), m_width(m_strip.width()), m_one(m_width * rateCount), m_apart(apart),
              m_lambda(m_strip.y.size()), m_score(std::size_t(m_one * m_one), 0.0f), m_moved(m_score.size())
        {
            likelihood.apply(m_strip.y, m_lambda);
        }

        std::array<std::vector<Index>, 2> run(const RunContext &context)
        {
            const Index frames = m_strip.frameCount();
            std::array<std::vector<Index>, 2> paths{std::vector<Index>(std::size_t(frames)),
                                                    std::vector<Index>(std::size_t(frames))};
            for (Index first = 0; first < frames; first += blockFrames) {
                context.checkpoint(double(first) / double(frames), "deciding between close signals");
                const Index end = std::min(frames, first + blockFrames);
                const Index seen = std::min(frames, end + lagFrames);
                m_changes.clear();
                for (Index at = first; at < seen; ++at) {
                    if (at > 0)
                        move(at);
                    else
                        m_changes.emplace_back();
                    addEvidence(at);
                }
                const Pair last = traceBack(first, seen, end, paths);
                if (end < frames)
                    startFrom(last);
            }
            return paths;
        }

    private:
        struct Changes {
            std::vector<std::int8_t> first, second; ///< of the rates, for each state
        };

        std::size_t indexOf(const Pair &at) const
        {
            return std::size_t((at.p * rateCount + at.r) * m_one + at.q * rateCount + at.s);
        }

        /// Cells by which a rate moves into frame `at`.
        static Index displacement(Index rate, Index at)
        {
            const auto rounded = [rate](Index step) {
                return Index(std::floor(double(rate - rateCount / 2) * double(step) / ratesPerCell + 0.5));
            };
            return rounded(at) - rounded(at - 1);
        }

        /// The best of a rate and its two neighbours, each value `stride` apart.
        static void take(const float *from, Index rate, Index stride, float &best, std::int8_t &change)
        {
            static const float stays = std::log(0.9f);
            static const float changes = std::log(0.05f);
            best = from[0] + stays;
            change = 0;
            if (rate > 0 && from[-stride] + changes > best) {
                best = from[-stride] + changes;
                change = 1;
            }
            if (rate + 1 < rateCount && from[stride] + changes > best) {
                best = from[stride] + changes;
                change = -1;
            }
        }

        void move(Index at)
        {
            Changes changes{std::vector<std::int8_t>(m_score.size()), std::vector<std::int8_t>(m_score.size())};
            for (Index p = 0; p < m_width; ++p)
                for (Index r = 0; r < rateCount; ++r) {
                    const Index source = p - displacement(r, at);
                    const auto to = std::size_t((p * rateCount + r) * m_one);
                    for (Index k = 0; k < m_one; ++k) {
                        const auto i = to + std::size_t(k);
                        m_moved[i] = impossible;
                        if (source >= 0 && source < m_width)
                            take(&m_score[std::size_t((source * rateCount + r) * m_one + k)], r, m_one, m_moved[i],
                                 changes.first[i]);
                    }
                }
            for (Index one = 0; one < m_one; ++one)
                for (Index q = 0; q < m_width; ++q)
                    for (Index s = 0; s < rateCount; ++s) {
                        const Index source = q - displacement(s, at);
                        const auto i = std::size_t(one * m_one + q * rateCount + s);
                        m_score[i] = impossible;
                        if (source >= 0 && source < m_width)
                            take(&m_moved[std::size_t(one * m_one + source * rateCount + s)], s, 1, m_score[i],
                                 changes.second[i]);
                    }
            m_changes.push_back(std::move(changes));
        }

        void addEvidence(Index at)
        {
            const float *lambda = m_lambda.data() + at * m_width;
            for (Index p = 0; p < m_width; ++p)
                for (Index q = 0; q < m_width; ++q) {
                    const float evidence =
                        std::abs(p - q) >= m_apart ? lambda[p] + lambda[q] : std::max(lambda[p], lambda[q]);
                    for (Index r = 0; r < rateCount; ++r)
                        for (Index s = 0; s < rateCount; ++s)
                            m_score[indexOf({p, r, q, s})] += evidence;
                }
        }

        Pair best() const
        {
            const Index i = std::max_element(m_score.begin(), m_score.end()) - m_score.begin();
            const Index one = i / m_one;
            const Index other = i % m_one;
            return {one / rateCount, one % rateCount, other / rateCount, other % rateCount};
        }

        /// Sets the paths of frames `first` to `end`, from the best state of the last frame seen; returns the state of
        /// the last frame set.
        Pair traceBack(Index first, Index seen, Index end, std::array<std::vector<Index>, 2> &paths) const
        {
            Pair at = best();
            Pair last = at;
            for (Index frame = seen; frame-- > first;) {
                if (frame < end) {
                    paths[0][std::size_t(frame)] = m_strip.firstCell(frame) + at.p;
                    paths[1][std::size_t(frame)] = m_strip.firstCell(frame) + at.q;
                }
                if (frame == end - 1)
                    last = at;
                if (frame == first)
                    break;
                const Changes &changes = m_changes[std::size_t(frame - first)];
                const Index s = at.s - changes.second[indexOf(at)];
                at = {at.p, at.r, at.q - displacement(at.s, frame), s};
                const Index r = at.r - changes.first[indexOf(at)];
                at = {at.p - displacement(at.r, frame), r, at.q, s};
            }
            return last;
        }

        void startFrom(const Pair &at)
        {
            std::fill(m_score.begin(), m_score.end(), impossible);
            m_score[indexOf(at)] = 0.0f;
        }

        PathStrip m_strip;
        Index m_width;
        Index m_one; ///< states of one path
        Index m_apart;
        std::vector<float> m_lambda;
        std::vector<float> m_score;
        std::vector<float> m_moved;     ///< after the first path's move
        std::vector<Changes> m_changes; ///< of the frames of a block
    };

} // namespace

std::array<std::vector<Index>, 2> jointPaths(PathStrip strip, const Likelihood &likelihood, Index apart,
                                             const RunContext &context)
{
    return JointViterbi(std::move(strip), likelihood, apart).run(context);
}

} // namespace faintline
