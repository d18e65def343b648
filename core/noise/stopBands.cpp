#include "noise/stopBands.h"

#include "base/logmath.h"
#include "frames/observed.h"
#include "noise/levels.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

namespace faintline {

namespace {

    constexpr double leastDepth = 2.0 * std::numbers::ln10; ///< 20 dB, ln
    constexpr double evenShare = 0.25; ///< of the step's fall, over as many cells before and behind it
    constexpr Index fewestCellsOfBand = 24;
    constexpr Index leastPassShare = 16; ///< one in so many cells
    constexpr Index widestStep = 8;      ///< the same
    constexpr Index fewestPairs = 128;   ///< of windows
    constexpr Index mostPairs = 512;
    constexpr double agreement = 2.0 / 3.0;
    constexpr Index mostRows = 64; ///< of the background

    /// Cells of a step, counted from the other end of the spectrum.
    struct BandStep {
        Index pass; ///< last cell of the pass band
        Index stop; ///< first of those that are all lower by the least depth
    };

    /// ln of the median over time of each cell's noise.
    std::vector<float> usualLevels(const NoiseBackground &background)
    {
        const Index cells = background.frequency.count;
        const Index rows = background.time.count;
        const Index stride = std::max<Index>(1, (rows + mostRows - 1) / mostRows);
        std::vector<float> levels;
        std::vector<float> values;
        for (Index cell = 0; cell < cells; ++cell) {
            values.clear();
            for (Index row = 0; row < rows; row += stride)
                if (const float ln = background.lnPower[std::size_t(row * cells + cell)];
                    ln > 0.5f * NoiseBackground::silence)
                    values.push_back(ln);
            levels.push_back(values.empty() ? NoiseBackground::silence : medianOf(values));
        }
        return levels;
    }

    /// The narrowest step to a band that reaches to the last cell.
    std::optional<BandStep> stepAtEnd(std::span<const float> ln)
    {
        const Index cells = std::ssize(ln);
        const auto at = [&](Index cell) { return double(ln[std::size_t(cell)]); };
        std::vector<double> highestFrom(ln.begin(), ln.end());
        for (Index cell = cells - 2; cell >= 0; --cell)
            highestFrom[std::size_t(cell)] =
                std::max(highestFrom[std::size_t(cell)], highestFrom[std::size_t(cell + 1)]);
        for (Index width = 1; width <= cells / widestStep; width *= 2) {
            const Index last = cells - width - std::max(width, fewestCellsOfBand);
            for (Index pass = std::max({width, cells / leastPassShare, fewestCellsOfBand}); pass <= last; ++pass) {
                const double lowEnough = at(pass) - leastDepth;
                if (highestFrom[std::size_t(pass + width)] > lowEnough)
                    continue;
                const double even = evenShare * (at(pass) - at(pass + width));
                const double before = at(pass - width) - at(pass);
                const double behind = at(pass + width) - at(std::min(pass + 2 * width, cells - 1));
                if (std::abs(before) > even || std::abs(behind) > even)
                    continue;
                Index stop = pass + 1;
                while (highestFrom[std::size_t(stop)] > lowEnough)
                    ++stop;
                return BandStep{pass, stop};
            }
        }
        return std::nullopt;
    }

    /// Neighbouring cells on either side of a step, as many of each.
    struct CellsBeside {
        Index firstOfPass, firstOfStop, count;
    };

    /// There may be nothing but digital silence behind a step.
    bool isHeard(const std::vector<float> &usual, const CellsBeside &cells)
    {
        const auto first = usual.begin() + cells.firstOfStop;
        return *std::min_element(first, first + cells.count) > 0.5f * NoiseBackground::silence;
    }

    /// Whether the level of a stop band follows that of the pass band from window to window.
    class LevelsBeside
    {
    public:
        LevelsBeside(const Spectrogram &frames, const std::vector<float> &usual, const CellsBeside &cells)
            : m_frames(frames), m_usual(usual), m_cells(cells), m_power(std::size_t(frames.frequency().count))
        {
        }

        bool follow()
        {
            const Index all = m_frames.time().count / 2;
            const Index pairs = std::min(all, mostPairs);
            Index seen = 0;
            Index together = 0;
            for (Index pair = 0; pair < pairs; ++pair) {
                const Index frame = 2 * (pair * all / pairs);
                const auto first = levelsIn(frame);
                const auto second = first ? levelsIn(frame + 1) : std::nullopt;
                if (!second)
                    continue;
                ++seen;
                together += (second->pass > first->pass) == (second->stop > first->stop) ? 1 : 0;
            }
            return seen >= fewestPairs && double(together) >= agreement * double(seen);
        }

    private:
        struct Both {
            float pass, stop;
        };

        /// Medians over the cells, relative to what is usual; nothing if the window was not observed, or is silent.
        std::optional<Both> levelsIn(Index frame)
        {
            if (!isObserved(m_frames, frame))
                return std::nullopt;
            m_frames.read(frame, 1, m_power);
            const Both both{levelFrom(m_cells.firstOfPass), levelFrom(m_cells.firstOfStop)};
            return both.pass > 0.0f ? std::optional(both) : std::nullopt;
        }

        float levelFrom(Index first)
        {
            m_values.clear();
            for (Index cell = first; cell < first + m_cells.count; ++cell)
                m_values.push_back(m_power[std::size_t(cell)] * std::exp(-m_usual[std::size_t(cell)]));
            return medianOf(m_values);
        }

        const Spectrogram &m_frames;
        const std::vector<float> &m_usual;
        CellsBeside m_cells;
        std::vector<float> m_power;
        std::vector<float> m_values;
    };

    double depthDbOf(const std::vector<float> &usual, const CellsBeside &cells)
    {
        const auto levelFrom = [&](Index first) {
            std::vector<float> values(usual.begin() + first, usual.begin() + first + cells.count);
            return double(medianOf(values));
        };
        return dbFromRatio(std::exp(levelFrom(cells.firstOfPass) - levelFrom(cells.firstOfStop)));
    }

} // namespace

std::vector<StopBand> findStopBands(const Spectrogram &frames, const NoiseBackground &background)
{
    const Axis &axis = background.frequency;
    if (!isWholeBand(frames.selection()) || frames.time().count < 2 * fewestPairs || axis != frames.frequency())
        return {};
    const std::vector<float> usual = usualLevels(background);
    const Index cells = axis.count;
    std::vector<StopBand> bands;
    const auto addIfFollowing = [&](const CellsBeside &beside, Index first, Index end) {
        if (isHeard(usual, beside) && LevelsBeside(frames, usual, beside).follow())
            bands.push_back({axis.value(double(first) - 0.5), axis.value(double(end) - 0.5), depthDbOf(usual, beside)});
    };
    if (const auto step = stepAtEnd(std::vector<float>(usual.rbegin(), usual.rend()))) {
        const Index end = cells - step->stop;
        const Index count = std::min(end, step->pass + 1);
        addIfFollowing({cells - 1 - step->pass, end - count, count}, 0, end);
    }
    if (const auto step = stepAtEnd(usual)) {
        const Index count = std::min(cells - step->stop, step->pass + 1);
        addIfFollowing({step->pass + 1 - count, step->stop, count}, step->stop, cells);
    }
    return bands;
}

} // namespace faintline
