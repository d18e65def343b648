#include "noise/NoiseBackground.h"

#include "base/memoryShares.h"
#include "noise/addStretch.h"
#include "noise/averageWhileSteady.h"
#include "noise/bandLevels.h"
#include "noise/blockBackground.h"
#include "noise/coarseFrames.h"
#include "noise/constants.h"
#include "noise/edgeCorrection.h"
#include "noise/stopBands.h"
#include "noise/unevenness.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace faintline {

namespace {

    constexpr int framesPerBlock = 512;              // longer blocks are subsampled
    constexpr Index valuesPerBlock = Index(1) << 22; // as are blocks of many cells
    constexpr Index fewestFramesPerBlock = 64;
    constexpr int sketchFrames = 64;
    constexpr Index largestBlockCount = 1024;
    /// Nine hours at 48 kHz; beyond that, blocks are longer.
    constexpr Index largestValueCount = memoryShares::background / sizeof(float);

    /// The detector's frames between two windows, up to three: spectra of windows that each begin a hop later.
    std::vector<Spectrogram> betweenWindows(const Spectrogram &detector, const Spectrogram &windows)
    {
        std::vector<Spectrogram> result;
        const Index steps = std::min<Index>(detector.settings().stepsPerWindow, levelFramesPerWindow);
        const double rate = detector.recording().info().sampleRateHz;
        for (Index shift = 1; shift < steps; ++shift) {
            SelectionSettings later = windows.selection();
            later.fromSeconds += std::round(double(shift * windows.windowSamples()) / double(steps)) / rate;
            if (detector.time().count <= detector.settings().stepsPerWindow)
                return {}; // hardly longer than a window
            result.emplace_back(windows.recordingPointer(), windows.settings(), later);
        }
        return result;
    }

    /// Frames for estimating a background, in blocks.
    struct BlockedFrames {
        const Spectrogram &frames;
        const std::vector<Spectrogram> &shifted;
        Index steps;
        double blockFrames;

        Index blockBegin(Index block) const
        {
            return std::min(frames.time().count, Index(std::floor(double(block) * blockFrames)));
        }
    };

    /// Decomposes stretches of a dozen blocks whose colour changes into sources.
    void addStretches(NoiseBackground &background, const BlockedFrames &blocked, const std::vector<Unevenness> &changes,
                      Index half, double likeness, std::vector<float> &levels)
    {
        const Index blockCount = std::ssize(changes);
        const double expected = Unevenness::ofNoise(likeness);
        const Index together = std::clamp<Index>(
            Index(double(valuesPerBlock / background.frequency.count) / blocked.blockFrames), 1, 2 * steadyBlocks + 1);
        for (Index block = 0; block < blockCount; block += together) {
            const Index next = std::min(blockCount, block + together);
            Unevenness change;
            for (Index each = block; each < next; ++each) {
                change.sum += changes[std::size_t(each)].sum;
                change.freedom += changes[std::size_t(each)].freedom;
            }
            const Index first = blocked.blockBegin(block);
            const Index end = next < blockCount ? blocked.blockBegin(next) : blocked.frames.time().count;
            if (change.variance() > noticeableVarianceRatio * expected)
                addStretch(background, {first, end - first, blocked.steps, blocked.frames, blocked.shifted}, half,
                           likeness, levels);
        }
    }

    /// One estimate, block by block.
    class Estimate
    {
    public:
        Estimate(const Spectrogram &spectrogram, const NormaliserSettings &settings, BackgroundDepth depth)
            : m_spectrogram(spectrogram), m_settings(settings), m_isSketch(depth == BackgroundDepth::Sketch),
              m_frames(coarseFrames(spectrogram, settings, 1)),
              m_window(sampleWindow(m_frames.settings().window, m_frames.windowSamples())),
              m_likeness(cellLikeness(m_window)), m_cells(m_frames.frequency().count),
              m_background(std::make_shared<NoiseBackground>())
        {
            layOutBlocks();
            layOutLevels();
        }

        std::shared_ptr<const NoiseBackground> run(const RunContext &context)
        {
            for (Index block = 0; block < m_blockCount; ++block) {
                context.checkpoint(double(block) / double(m_blockCount), "noise background");
                addBlock(block);
            }
            finish();
            return m_background;
        }

    private:
        bool hasLevels() const { return m_background->bandCount > 0; }
        Index columns() const { return m_background->bandCount + 1; }
        BlockedFrames blocked() const { return {m_frames, m_shifted, m_steps, m_blockFrames}; }

        void layOutBlocks()
        {
            const Index frameCount = m_frames.time().count;
            const Index perFrame = std::max<Index>(1, m_cells);
            const Index mostBlocks = std::clamp<Index>(largestValueCount / perFrame, 1, largestBlockCount);
            const Index framesWanted =
                std::max(Index(std::llround(m_settings.blockWindows)), (frameCount + mostBlocks - 1) / mostBlocks);
            m_blockCount = m_isSketch ? 1 : std::max<Index>(1, frameCount / framesWanted);
            m_blockFrames = double(frameCount) / double(m_blockCount);
            const Axis &time = m_frames.time();
            m_background->time = {
                "time",       "s",  time.first + 0.5 * (m_blockFrames - 1.0) * time.step, m_blockFrames * time.step,
                m_blockCount, false};
            m_background->frequency = m_frames.frequency();
            m_background->lnUnit = 2.0 * std::numbers::ln2 * m_frames.scaleExponent();
            // Selected frames lie on one even raster over all blocks; every frame is used if there are not too many.
            m_mostUsed =
                double(m_isSketch ? sketchFrames
                                  : std::clamp<Index>(valuesPerBlock / perFrame, fewestFramesPerBlock, framesPerBlock));
            m_stride = Index(std::ceil(m_blockFrames / m_mostUsed));
            m_rows.lnPower.reserve(std::size_t(m_blockCount * m_cells));
            m_background->lnPower.reserve(std::size_t(m_blockCount * m_cells));
        }

        /// Levels are computed for the detector's own, overlapping frames, because a sudden change between windows
        /// could only be guessed.
        void layOutLevels()
        {
            m_background->bandCount =
                m_settings.followLevel && !m_isSketch ? NoiseBackground::subBandCount(double(m_cells)) : 0;
            if (m_stride == 1 && hasLevels())
                m_shifted = betweenWindows(m_spectrogram, m_frames);
            m_steps = std::ssize(m_shifted) + 1;
            const Axis &time = m_frames.time();
            m_background->levelTime = {"time",
                                       "s",
                                       time.first,
                                       double(m_stride) * time.step / double(m_steps),
                                       (time.count + m_stride - 1) / m_stride * m_steps,
                                       false};
            m_levels.resize(hasLevels() ? std::size_t(m_background->levelTime.count * columns()) : 0, levelNotKnown);
            m_blockOfLevel.resize(std::size_t(m_background->levelTime.count), m_blockCount - 1);
        }

        void addBlock(Index block)
        {
            const Index first = blocked().blockBegin(block);
            const Index end = blocked().blockBegin(block + 1);
            const Index firstUsed = (first + m_stride - 1) / m_stride * m_stride;
            const Index used = (end - firstUsed + m_stride - 1) / m_stride;
            m_block.resize(std::size_t(used * m_cells));
            for (Index i = 0; i < (m_stride > 1 ? used : 1); ++i) {
                const Index together = m_stride > 1 ? 1 : used;
                m_frames.read(firstUsed + i * m_stride, together,
                              std::span(m_block).subspan(std::size_t(i * m_cells), std::size_t(together * m_cells)));
            }
            BlockMedians typical(m_block, m_cells);
            const std::vector<float> taken =
                hasLevels() ? flatten(m_block, m_cells, typical) : std::vector<float>(std::size_t(used), 0.0f);
            const BlockBackground own = blockBackground(typical, m_settings.halfWidthCells);
            std::vector<float> &medians = m_background->lnPower;
            medians.insert(medians.end(), own.medians.begin(), own.medians.end());
            m_rows.lnPower.insert(m_rows.lnPower.end(), own.lnPower.begin(), own.lnPower.end());
            m_rows.isNoise.insert(m_rows.isNoise.end(), own.isNoise.begin(), own.isNoise.end());
            if (!hasLevels())
                return;
            const Index row = firstUsed / m_stride;
            std::fill_n(m_blockOfLevel.begin() + row * m_steps, used * m_steps, block);
            addLevels(own, row, taken);
            addLevelsBetween(own, first, used);
        }

        /// Adds the levels of the block's frames; `taken`: ln of the factor by which each was divided (flatten).
        void addLevels(const BlockBackground &own, Index row, const std::vector<float> &taken)
        {
            const std::vector<float> measured = levelsOf(m_block, own, m_background->bandCount, m_likeness);
            m_offsets.emplace_back(measured, columns());
            if (m_stride == 1)
                m_changes.push_back(changesOf(m_block, own, measured, m_background->bandCount));
            for (Index i = 0; i < std::ssize(taken); ++i)
                putLevels(measured, i, (row + i) * m_steps, taken[std::size_t(i)]);
        }

        /// Adds the levels of the detector's frames between those of the block.
        void addLevelsBetween(const BlockBackground &own, Index first, Index used)
        {
            for (Index shift = 1; shift < m_steps; ++shift) {
                const Spectrogram &other = m_shifted[std::size_t(shift - 1)];
                const Index there = std::min(used, other.time().count - first);
                if (there <= 0)
                    continue;
                const auto values = std::span(m_block).first(std::size_t(there * m_cells));
                other.read(first, there, values);
                const std::vector<float> measured = levelsOf(values, own, m_background->bandCount, m_likeness);
                for (Index i = 0; i < there; ++i)
                    putLevels(measured, i, (first + i) * m_steps + shift, 0.0f);
            }
        }

        void putLevels(const std::vector<float> &measured, Index row, Index place, float more)
        {
            for (Index column = 0; column < columns(); ++column)
                if (const float level = measured[std::size_t(row * columns() + column)]; level < levelNotKnown)
                    m_levels[std::size_t(place * columns() + column)] = level + more;
        }

        void finish()
        {
            averageWhileSteady(m_background->lnPower, m_rows.lnPower, m_cells, m_settings.halfWidthCells,
                               std::min(m_mostUsed, m_blockFrames));
            if (hasLevels()) {
                removeOffsets(m_levels, m_offsets, m_blockOfLevel);
                moveToBackground(m_levels, m_rows, *m_background, m_blockOfLevel);
            }
            const double overlap = overlapFactor(m_window, int(m_steps));
            m_background->lnLevel = finishLevels(m_levels, *m_background, overlap, m_likeness);
            if (hasLevels() && m_stride == 1) {
                addStretches(*m_background, blocked(), m_changes, m_settings.halfWidthCells, m_likeness, m_levels);
                if (!m_background->stretches.empty())
                    m_background->lnLevel = finishLevels(m_levels, *m_background, overlap, m_likeness);
            }
            if (!m_isSketch) {
                m_background->bins = m_spectrogram.frequency();
                m_background->lnAtEdges = edgeCorrection(m_spectrogram, *m_background);
                m_background->stopBands = stopBands(m_spectrogram);
            }
        }

        const Spectrogram &m_spectrogram;
        const NormaliserSettings &m_settings;
        bool m_isSketch;
        Spectrogram m_frames; ///< of windows side by side
        std::vector<float> m_window;
        double m_likeness;
        Index m_cells;
        std::shared_ptr<NoiseBackground> m_background;

        Index m_blockCount = 1;
        double m_blockFrames = 1.0;
        double m_mostUsed = 1.0;
        Index m_stride = 1; ///< between frames that are used

        std::vector<Spectrogram> m_shifted; ///< the detector's frames between those
        Index m_steps = 1;
        std::vector<float> m_levels;
        std::vector<Index> m_blockOfLevel;

        std::vector<float> m_block; ///< frames of the present one
        BlockRows m_rows;
        std::vector<Unevenness> m_changes; ///< of each block
        std::vector<LevelOffsets> m_offsets;
    };

} // namespace

std::shared_ptr<const NoiseBackground> estimateBackground(const Spectrogram &spectrogram,
                                                          const NormaliserSettings &settings, const RunContext &context,
                                                          BackgroundDepth depth)
{
    return Estimate(spectrogram, settings, depth).run(context);
}

} // namespace faintline
