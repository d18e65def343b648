#include "calibrate/followTail.h"

#include "base/Random.h"
#include "calibrate/constants.h"
#include "calibrate/measureRareRates.h"
#include "detect/Smd.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    /// The first cells of another stream: a band that paths leave at its ends.
    class BandNoise final : public NoiseStream
    {
    public:
        BandNoise(std::unique_ptr<NoiseStream> wide, Index cells)
            : m_wide(std::move(wide)), m_cells(cells), m_y(std::size_t(m_wide->cells()))
        {
        }
        Index cells() const override { return m_cells; }
        void next(Random &random, std::span<float> y) override
        {
            m_wide->next(random, m_y);
            std::copy_n(m_y.begin(), m_cells, y.begin());
        }
        std::vector<float> state() const override { return m_wide->state(); }
        void setState(std::span<const float> state) override { m_wide->setState(state); }

    private:
        std::unique_ptr<NoiseStream> m_wide;
        Index m_cells;
        std::vector<float> m_y;
    };

    /// Noise of a family's members, on a cyclic band.
    class FamilyNoise final : public NoiseStream
    {
    public:
        FamilyNoise(std::unique_ptr<NoiseStream> lines, FamilyMap map)
            : m_lines(std::move(lines)), m_map(std::move(map)), m_y(std::size_t(m_lines->cells()))
        {
        }
        Index cells() const override { return m_map.frequency().count; }
        void next(Random &random, std::span<float> y) override
        {
            m_lines->next(random, m_y);
            m_map.apply(m_y, y);
        }
        std::vector<float> state() const override { return m_lines->state(); }
        void setState(std::span<const float> state) override { m_lines->setState(state); }

    private:
        std::unique_ptr<NoiseStream> m_lines;
        FamilyMap m_map;
        std::vector<float> m_y;
    };

    /// Noise of the frames, with windows of `windowSamples` samples, or more if a family's members need room.
    std::unique_ptr<NoiseStream> noiseOf(const AnalysisSettings &settings, int windowSamples)
    {
        const FamilySettings &family = settings.family;
        const int channels = channelCount(settings.selection);
        if (!family.isSum(channels))
            return spectralNoise(settings.spectrogram, windowSamples);
        const int room = int(std::ceil(ringBands(family, channels)));
        auto lines = spectralNoise(settings.spectrogram, room * windowSamples);
        const Index bins = lines->cells();
        return std::make_unique<FamilyNoise>(
            std::move(lines),
            FamilyMap::onRing(family, bins,
                              settings.spectrogram.windowSeconds * double(settings.spectrogram.binsPerCell), channels));
    }

    /// What splitting needs to know of noise, detector and model.
    struct Excursions {
        const DetectorSettings &detector;
        const MarkovModel &model;
        const Grid &grid;
        FrameGeometry geometry;
        double lnK = 0.0;
        std::function<std::unique_ptr<NoiseStream>()> makeNoise;
    };

    RareRates ratesOf(const Excursions &of, const SplittingSettings &splitting, const RunContext &context)
    {
        if (const Index frames = framesPerDecision(of.detector, of.geometry); frames > 1)
            return measureBlockRates([&] { return std::make_unique<Smd>(of.model, ResetRule{ResetLaw::None}); },
                                     of.makeNoise, frames, splitting, context);
        const auto *smd = std::get_if<SmdSettings>(&of.detector);
        const ResetRule rule = smd ? resetRule(*smd, of.lnK) : ResetRule{};
        return measureRareRates([&] { return makeDetector(of.detector, of.model, of.grid, of.geometry, rule); },
                                of.makeNoise, splitting, context);
    }

} // namespace

RareRates followTail(const AnalysisPlan &plan, const CalibrationEffort &effort, const RunContext &context)
{
    const MarkovModel &model = plan.model;
    const AnalysisSettings &settings = plan.settings;
    if (model.space.axes().size() > 1 || !model.space.axes().front().transition.empty())
        return {};
    KinematicAxis axis = model.space.axes().front();
    const bool isSpectral = plan.frames->geometry().isOfSpectra();
    const Index independentCells = std::max<Index>(narrowCells, 8 * axis.largestDisplacement() + 1);
    const std::function<std::unique_ptr<NoiseStream>()> makeNoise = [&] {
        return isSpectral ? noiseOf(settings, effort.splittingWindowSamples) : independentNoise(independentCells);
    };
    axis.cells = makeNoise()->cells();
    axis.cyclic = true;
    if (axis.cells <= 4 * axis.largestDisplacement())
        return {};
    const MarkovModel narrow{StateSpace({axis}), model.likelihood, model.transitionScale};
    const Grid grid{{{axis.name, "", 0.0, 1.0, axis.cells, true}}};
    const FrameGeometry geometry = isSpectral ? frameGeometry(settings.spectrogram) : FrameGeometry{};
    return ratesOf({settings.detector, narrow, grid, geometry, plan.calibration->lnK, makeNoise}, effort.splitting,
                   context);
}

RareRates followBand(const AnalysisSettings &bare, double lnK, Index bins, const SplittingSettings &splitting,
                     const RunContext &context)
{
    int samples = narrowestBandSamples;
    while (samples < bins) // at least twice as many bins, so that the ends do not meet
        samples *= 2;
    const auto makeNoise = [&] { return std::make_unique<BandNoise>(noiseOf(bare, samples), bins); };
    const Grid grid{{{"frequency", "Hz", 0.0, 1.0, bins, false}}};
    const MarkovModel model = makeModel(bare.model, grid);
    return ratesOf({bare.detector, model, grid, frameGeometry(bare.spectrogram), lnK, makeNoise}, splitting, context);
}

} // namespace faintline
