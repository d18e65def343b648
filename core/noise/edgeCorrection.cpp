#include "noise/edgeCorrection.h"

#include "noise/FrameNormaliser.h"
#include "noise/constants.h"
#include "noise/levels.h"
#include "noise/medians.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>

namespace faintline {

namespace {

    constexpr Index edgeValues = Index(1) << 26; ///< frames × bins that are read

    /// Counts how often each cell's background changes steeply to the next cell.
    void countSteep(std::span<const float> ln, std::vector<Index> &counts)
    {
        for (std::size_t cell = 0; cell + 1 < ln.size(); ++cell)
            counts[cell] += std::abs(ln[cell + 1] - ln[cell]) > steepLnPerCell ? 1 : 0;
    }

    /// Cells near one that is steep in half of the frames.
    std::vector<bool> nearEdges(const std::vector<Index> &counts, Index frames)
    {
        const Index cells = std::ssize(counts);
        std::vector<bool> isNear(counts.size(), false);
        for (Index cell = 0; cell < cells; ++cell)
            if (2 * counts[std::size_t(cell)] >= frames)
                std::fill(isNear.begin() + std::max<Index>(0, cell - edgeReachCells),
                          isNear.begin() + std::min(cells, cell + edgeReachCells + 2), true);
        return isNear;
    }

    /// ln; compensates for the error of a bin's level, and for frames of which only one in `alike` is independent.
    double marginOf(double alike, double error)
    {
        return 0.5 * alarmsPerExcess * error * error + alarmEvidenceNats / alarmsPerRareExcess * (1.0 - 1.0 / alike);
    }

    /// Sums over frames of a recording over its background, bin by bin.
    class BinRatios
    {
    public:
        BinRatios(const Spectrogram &spectrogram, const NoiseBackground &background)
            : m_spectrogram(spectrogram), m_background(background), m_normaliser(spectrogram, false),
              m_lags(std::size_t(edgeWindowsApart * spectrogram.settings().stepsPerWindow)),
              m_below(std::size_t(spectrogram.frequency().count), 0), m_sum(m_below.size(), 0.0),
              m_squares(m_below.size(), 0.0), m_products(m_below.size(), 0.0),
              m_steep(std::size_t(background.frequency.count), 0), m_ln(m_steep.size())
        {
        }

        void addRun(Index first, Index end)
        {
            m_before.clear();
            for (Index frame = first; frame < end; ++frame)
                add(frame);
        }

        Index frames() const { return m_frames; }
        std::vector<bool> nearSteepPlaces() const { return nearEdges(m_steep, m_frames); }

        /// ln of the mean of exponential values of which as many lie below ln 2, for each bin.
        std::vector<float> lnMeans() const
        {
            std::vector<float> result;
            for (const Index below : m_below) {
                const double share = std::clamp(double(below), 0.5, double(m_frames) - 0.5) / double(m_frames);
                result.push_back(float(std::log(-std::numbers::ln2 / std::log1p(-share))));
            }
            return result;
        }

        /// Number of frames that count as one, 1 + 2 Σ ρ over the lags, relative to that of most bins.
        std::vector<double> framesAlike() const
        {
            std::vector<double> result;
            std::vector<float> sorted;
            for (std::size_t bin = 0; bin < m_sum.size(); ++bin) {
                const double mean = m_sum[bin] / double(m_frames);
                const double variance = m_squares[bin] / double(m_frames) - mean * mean;
                const double shared =
                    m_pairs > 0 ? double(m_lags) * (m_products[bin] / double(m_pairs) - mean * mean) : 0.0;
                result.push_back(std::max(1.0, 1.0 + 2.0 * shared / std::max(1e-9, variance)));
                sorted.push_back(float(result.back()));
            }
            const auto usual = double(medianOf(sorted));
            for (double &each : result)
                each = std::max(1.0, each / usual);
            return result;
        }

    private:
        void add(Index frame)
        {
            const double seconds = m_spectrogram.time().value(double(frame));
            if (!m_spectrogram.isObserved(frame))
                return m_before.clear();
            m_background.readLnPower(seconds, m_ln);
            if (*std::max_element(m_ln.begin(), m_ln.end()) <= NoiseBackground::silence)
                return m_before.clear();
            countSteep(m_ln, m_steep);
            std::vector<float> y(m_below.size());
            m_spectrogram.read(frame, 1, y);
            m_normaliser.normalise(y, m_background, seconds);
            for (std::size_t bin = 0; bin < y.size(); ++bin) {
                m_below[bin] += y[bin] < std::numbers::ln2_v<float> ? 1 : 0;
                y[bin] = std::min(y[bin], lineLimit);
                m_sum[bin] += double(y[bin]);
                m_squares[bin] += double(y[bin] * y[bin]);
            }
            ++m_frames;
            addProducts(y);
            m_before.push_back(std::move(y));
            if (m_before.size() > m_lags)
                m_before.pop_front();
        }

        /// With each of the frames before, if all of them are known.
        void addProducts(const std::vector<float> &y)
        {
            if (m_before.size() < m_lags)
                return;
            for (const std::vector<float> &earlier : m_before)
                for (std::size_t bin = 0; bin < y.size(); ++bin)
                    m_products[bin] += double(y[bin] * earlier[bin]);
            m_pairs += std::ssize(m_before);
        }

        const Spectrogram &m_spectrogram;
        const NoiseBackground &m_background;
        FrameNormaliser m_normaliser;
        std::size_t m_lags;
        std::deque<std::vector<float>> m_before; ///< y of the preceding frames of a run
        std::vector<Index> m_below;              ///< frames in which a bin lies below the median of noise
        std::vector<double> m_sum;
        std::vector<double> m_squares;
        std::vector<double> m_products;
        std::vector<Index> m_steep;
        std::vector<float> m_ln;
        Index m_frames = 0; ///< outside gaps and digital silence
        Index m_pairs = 0;
    };

    /// Adds some thousand frames, in runs that are evenly spaced.
    void addRuns(BinRatios &ratios, Index frameCount, Index wanted, Index run)
    {
        const Index runs = std::max<Index>(1, std::min(wanted, frameCount) / run);
        for (Index i = 0; i < runs; ++i) {
            const Index first = i * frameCount / runs;
            ratios.addRun(first, wanted < frameCount ? first + run : (i + 1) * frameCount / runs);
        }
    }

} // namespace

std::vector<float> edgeCorrection(const Spectrogram &spectrogram, const NoiseBackground &background)
{
    const Index bins = spectrogram.frequency().count;
    const Index frameCount = spectrogram.time().count;
    const Index steps = spectrogram.settings().stepsPerWindow;
    const Index wanted = std::min(edgeFrames, edgeValues / std::max<Index>(1, bins));
    if (frameCount < fewestEdgeWindows * steps || wanted < fewestEdgeWindows)
        return {};
    BinRatios ratios(spectrogram, background);
    addRuns(ratios, frameCount, wanted, edgeWindowsTogether * steps);
    if (ratios.frames() < fewestEdgeWindows / 2)
        return {};

    const std::vector<float> lnMeans = ratios.lnMeans();
    const double binsPerCell = spectrogram.binsPerCell();
    const std::vector<float> smooth =
        runningMedian(lnMeans, Index(std::lround(double(smoothHalfWidthCells) * binsPerCell)));
    const std::vector<bool> isNear = ratios.nearSteepPlaces();
    const std::vector<double> alike = ratios.framesAlike();
    const double independent = double(ratios.frames()) * std::min(1.0, 2.0 / double(steps));
    const double error = inverseLn2 / std::sqrt(independent);
    const double smoothError =
        medianErrorRatio * error * medianScatter(2.0 * double(smoothHalfWidthCells) + 1.0) / inverseLn2;
    std::vector<float> correction(std::size_t(bins), 0.0f);
    for (Index bin = 0; bin < bins; ++bin) {
        const auto i = std::size_t(bin);
        if (isNear[std::size_t(background.frequency.nearest(spectrogram.frequency().value(double(bin))))])
            correction[i] =
                std::clamp(lnMeans[i], -correctionLimitLn, correctionLimitLn) + float(marginOf(alike[i], error));
        else if (std::abs(smooth[i]) > float(significantDeviations * smoothError)
                 && std::abs(smooth[i]) < correctionLimitLn)
            correction[i] = smooth[i];
    }
    return correction;
}

} // namespace faintline
