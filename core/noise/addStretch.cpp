#include "noise/addStretch.h"

#include "noise/bandLevels.h"
#include "noise/between.h"
#include "noise/blockBackground.h"
#include "noise/constants.h"
#include "noise/unevenness.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    /// frames ← frames·e^(-ln)
    void divide(std::span<float> frame, std::span<const float> ln)
    {
        for (std::size_t cell = 0; cell < frame.size(); ++cell)
            frame[cell] *= std::exp(-ln[cell]);
    }

    /// A stretch of time to be decomposed into sources.
    class StretchFit
    {
    public:
        StretchFit(const NoiseBackground &background, const StretchFrames &stretchFrames, Index half)
            : m_background(background), m_stretchFrames(stretchFrames), m_half(half),
              m_cells(background.frequency.count), m_ln(std::size_t(m_cells)), m_frames(stretchFrames.read(0, m_cells)),
              m_each(std::size_t(stretchFrames.count), 1.0f), m_asTheyAre(std::size_t(m_cells), 1.0f)
        {
        }

        /// Divides the frames by the level below all sources; returns false in silence.
        bool begin()
        {
            const float strongest = *std::max_element(m_frames.begin(), m_frames.end());
            const Index middle = (m_stretchFrames.first + m_stretchFrames.count / 2) * m_stretchFrames.steps;
            const Between t = between(m_background.time, m_background.levelTime.value(double(middle)));
            const auto row = m_background.lnPower.begin() + t.lower * m_cells;
            if (!(strongest > 0.0f) || *row <= NoiseBackground::silence)
                return false;
            m_stretch.firstLevel = m_stretchFrames.first * m_stretchFrames.steps;
            m_stretch.lnPower.assign(row, row + m_cells);
            m_stretch.floor = std::log(strongest) + float(std::log(roundingFloor));
            std::vector<float> before = m_frames;
            for (Index frame = 0; frame < m_stretchFrames.count; ++frame) {
                const Index level = (m_stretchFrames.first + frame) * m_stretchFrames.steps;
                m_background.readLnPower(m_background.levelTime.value(double(level)), m_ln);
                divide(frameOf(before, frame), m_ln);
                divide(frameOf(m_frames, frame), m_stretch.lnPower);
            }
            m_before = unevenness(before, m_asTheyAre, m_each);
            return true;
        }

        /// Returns false if there are none.
        bool findSources()
        {
            m_stretch.sources = fitSources(m_frames, m_cells, m_cells < threeSourcesFromCells ? 2 : 3, m_half);
            const Index sources = m_stretch.sources.count();
            m_stretch.sourceLevels.assign(std::size_t(m_stretchFrames.count * m_stretchFrames.steps * sources), 0.0f);
            return sources > 0;
        }

        /// Whether sources explain more than the background, leaving only chance.
        bool isBetter(double likeness)
        {
            divideByNoise(0);
            m_rest = blockBackground({m_frames, m_cells}, m_half);
            for (Index frame = 0; frame < m_stretchFrames.count; ++frame)
                divide(frameOf(m_frames, frame), m_rest.lnPower);
            // Signals also change with time but are not sources of noise, so that nothing but chance may remain.
            const Unevenness after = unevenness(m_frames, m_asTheyAre, m_each);
            const bool isLess = m_before.variance() > improvedVarianceRatio * after.variance()
                                || m_before.varianceOfMeans() > improvedVarianceRatio * after.varianceOfMeans();
            return isLess && !(after.variance() > remainingVarianceRatio * Unevenness::ofNoise(likeness));
        }

        /// Replaces the levels of the stretch by levels relative to its noise.
        NoiseStretch finish(double likeness, std::vector<float> &levels)
        {
            for (std::size_t cell = 0; cell < m_stretch.lnPower.size(); ++cell)
                m_stretch.lnPower[cell] += m_rest.lnPower[cell];
            std::fill(m_rest.lnPower.begin(), m_rest.lnPower.end(), 0.0f);
            const Index columns = m_background.bandCount + 1;
            std::vector<float> offsets;
            for (Index shift = 0; shift < m_stretchFrames.steps; ++shift) {
                if (shift > 0) {
                    m_frames = m_stretchFrames.read(shift, m_cells);
                    for (Index frame = 0; frame < std::ssize(m_frames) / m_cells; ++frame)
                        divide(frameOf(m_frames, frame), m_stretch.lnPower);
                    divideByNoise(shift);
                }
                const std::vector<float> own = levelsOf(m_frames, m_rest, m_background.bandCount, likeness);
                if (shift == 0)
                    offsets = mediansOf(own, columns);
                for (Index i = 0; i < std::ssize(own); ++i) {
                    const Index place = (m_stretchFrames.first + i / columns) * m_stretchFrames.steps + shift;
                    const float level = own[std::size_t(i)];
                    levels[std::size_t(place * columns + i % columns)] =
                        level < levelNotKnown ? level - shareOfLines(offsets[std::size_t(i % columns)]) : levelNotKnown;
                }
            }
            return std::move(m_stretch);
        }

    private:
        std::span<float> frameOf(std::vector<float> &all, Index frame) const
        {
            return std::span(all).subspan(std::size_t(frame * m_cells), std::size_t(m_cells));
        }

        /// Applies to frames that are already divided by lnPower.
        void divideByNoise(Index shift)
        {
            const Index sources = m_stretch.sources.count();
            for (Index frame = 0; frame < std::ssize(m_frames) / m_cells; ++frame) {
                const auto values = frameOf(m_frames, frame);
                const std::vector<float> own = m_stretch.sources.levelsIn(values);
                std::copy(own.begin(), own.end(),
                          m_stretch.sourceLevels.begin() + (frame * m_stretchFrames.steps + shift) * sources);
                readStretch(m_stretch, own, m_ln);
                for (std::size_t cell = 0; cell < m_ln.size(); ++cell)
                    values[cell] *= std::exp(m_stretch.lnPower[cell] - m_ln[cell]);
            }
        }

        const NoiseBackground &m_background;
        const StretchFrames &m_stretchFrames;
        Index m_half;
        Index m_cells;
        std::vector<float> m_ln;
        std::vector<float> m_frames;
        std::vector<float> m_each;
        std::vector<float> m_asTheyAre;
        Unevenness m_before;
        BlockBackground m_rest;
        NoiseStretch m_stretch;
    };

} // namespace

void addStretch(NoiseBackground &background, const StretchFrames &stretchFrames, Index half, double likeness,
                std::vector<float> &levels)
{
    StretchFit fit(background, stretchFrames, half);
    if (fit.begin() && fit.findSources() && fit.isBetter(likeness))
        background.stretches.push_back(fit.finish(likeness, levels));
}

} // namespace faintline
