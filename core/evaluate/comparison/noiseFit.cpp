#include "evaluate/comparison/noiseFit.h"

#include "base/Random.h"
#include "calibrate/fitReset.h"
#include "plan/Calibration.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace faintline {

// ---- the law --------------------------------------------------------------------------------------------------------

NoiseLaw::NoiseLaw() : m_counts(std::size_t(stepsPerUnit) * largest + 1, 0) {}

void NoiseLaw::add(std::span<const float> y)
{
    const auto last = float(m_counts.size() - 1);
    for (const float value : y) {
        if (std::isnan(value)) // not observed
            continue;
        ++m_count;
        ++m_counts[std::size_t(std::clamp(value * float(stepsPerUnit), 0.0f, last))];
        m_sum += double(value);
    }
}

void NoiseLaw::add(const NoiseLaw &other)
{
    for (std::size_t i = 0; i < m_counts.size(); ++i)
        m_counts[i] += other.m_counts[i];
    m_count += other.m_count;
    m_sum += other.m_sum;
}

double NoiseLaw::exceedance(double t) const
{
    if (m_count == 0 || t <= 0.0)
        return 1.0;
    const double position = std::min(t * stepsPerUnit, double(m_counts.size() - 1));
    const auto step = std::size_t(position);
    std::int64_t above = 0;
    for (std::size_t i = step + 1; i < m_counts.size(); ++i)
        above += m_counts[i];
    const double within = (1.0 - (position - double(step))) * double(m_counts[step]);
    return (double(above) + within) / double(m_count);
}

double NoiseLaw::quantile(double probability) const
{
    const double wanted = probability * double(m_count);
    double above = 0.0;
    for (std::size_t i = m_counts.size(); i-- > 0;) {
        const auto here = double(m_counts[i]);
        if (here > 0.0 && above + here >= wanted)
            return (double(i) + 1.0 - (wanted - above) / here) / stepsPerUnit;
        above += here;
    }
    return 0.0;
}

double NoiseLaw::distance() const
{
    if (m_count == 0)
        return 0.0;
    double worst = 0.0;
    std::int64_t below = 0;
    for (std::size_t i = 0; i + 1 < m_counts.size(); ++i) {
        below += m_counts[i];
        const double law = -std::expm1(-double(i + 1) / stepsPerUnit);
        worst = std::max(worst, std::abs(double(below) / double(m_count) - law));
    }
    return worst;
}

double NoiseLaw::distanceLimit(double independent)
{
    return independent > 0.0 ? 1.358 / std::sqrt(independent) : 1.0;
}

// ---- of frames ------------------------------------------------------------------------------------------------------

std::vector<FittedBand> fitNoise(const NormalisedFrames &frames, const NoiseSample &sample,
                                 const FrameGeometry &geometry, const RunContext &context)
{
    const Axis &axis = frames.grid().axes.back();
    const Index size = frames.grid().size();
    const Index frameCount = frames.time().count;
    const Index beyond = std::clamp<Index>(sample.leftOut, 0, (axis.count - 1) / 2);
    const Index looked = axis.count - 2 * beyond;
    const Index wanted = std::clamp<Index>(sample.bands, 1, looked);
    std::vector<FittedBand> result(static_cast<std::size_t>(wanted));
    const auto edge = [&](Index band) { return beyond + band * looked / wanted; };
    for (Index band = 0; band < wanted; ++band) {
        result[std::size_t(band)].low = axis.value(double(edge(band)));
        result[std::size_t(band)].high = axis.value(double(edge(band + 1)));
    }
    const Index stride = std::max<Index>(1, frameCount * size / std::max<std::int64_t>(sample.cells, 1));
    std::vector<float> y(static_cast<std::size_t>(size));
    for (Index frame = 0; frame < frameCount; frame += stride) {
        context.checkpoint(double(frame) / double(frameCount), "measuring noise");
        frames.read(frame, 1, y);
        for (Index row = 0; row < size; row += axis.count)
            for (Index band = 0; band < wanted; ++band)
                result[std::size_t(band)].law.add(std::span<const float>(y).subspan(
                    std::size_t(row + edge(band)), std::size_t(edge(band + 1) - edge(band))));
    }
    std::erase_if(result, [](const FittedBand &band) { return band.law.count() == 0; });
    const double overlap =
        std::max(1.0, geometry.framesPerWindow / double(stride)) * std::max(1.0, geometry.binsPerCell);
    for (FittedBand &band : result)
        band.independent = double(band.law.count()) / overlap;
    return result;
}

// ---- false alarms ---------------------------------------------------------------------------------------------------

namespace {

    constexpr Index bins = 256;
    constexpr Index frames = 6000;
    constexpr Index settling = 300;
    constexpr double wellCounted = 3e-5;
    constexpr double tailBegin = 1e-3; ///< one and a half decades before

    /// Quantiles of a law as a table, fine enough for plots. Where fewer than thirty cells support it, the law is
    /// continued linearly.
    class Quantiles
    {
    public:
        explicit Quantiles(const NoiseLaw &law)
        {
            // Equal steps of -ln P, in which an exponential law is linear.
            const double vouched = std::log(std::max<double>(double(law.count()), 100.0) / 30.0);
            const double slope =
                (law.quantile(std::exp(-vouched)) - law.quantile(std::exp(-0.5 * vouched))) / (0.5 * vouched);
            for (int i = 0; i <= int(fittedRangeNats * stepsPerNat); ++i) {
                const double x = double(i) / stepsPerNat;
                m_values.push_back(law.quantile(std::exp(-std::min(x, vouched))) + slope * std::max(0.0, x - vouched));
            }
        }

        float at(double minusLnProbability) const
        {
            const double position = std::min(minusLnProbability * stepsPerNat, double(m_values.size() - 1) - 1e-9);
            const auto i = std::size_t(position);
            const double share = position - double(i);
            return float(m_values[i] + share * (m_values[i + 1] - m_values[i]));
        }

    private:
        static constexpr double stepsPerNat = 32.0;
        static constexpr double fittedRangeNats = 24.0;
        std::vector<double> m_values;
    };

    /// P(D > threshold) from all values of D, continued with the slope of their tail.
    double exceedanceOf(std::vector<float> &statistic, double threshold)
    {
        std::sort(statistic.begin(), statistic.end(), std::greater<>());
        const auto n = double(statistic.size());
        const auto above = double(std::lower_bound(statistic.begin(), statistic.end(), threshold,
                                                   [](float value, double t) { return double(value) > t; })
                                  - statistic.begin());
        if (above >= wellCounted * n)
            return above / n;
        const auto level = [&](double p) { return double(statistic[std::size_t(p * n)]); };
        const double slope = std::log(tailBegin / wellCounted) / std::max(level(wellCounted) - level(tailBegin), 1e-6);
        return wellCounted * std::exp(-slope * (threshold - level(wellCounted)));
    }

    /// Threshold for P(D > T) = pfa, with the tail continued in the same way.
    double thresholdOf(std::vector<float> &statistic, double pfa)
    {
        std::sort(statistic.begin(), statistic.end(), std::greater<>());
        const auto level = [&](double p) {
            const auto index = std::size_t(p * double(statistic.size()));
            return double(statistic[std::min(index, statistic.size() - 1)]);
        };
        if (pfa >= wellCounted)
            return level(pfa);
        const double slope = std::log(tailBegin / wellCounted) / std::max(level(wellCounted) - level(tailBegin), 1e-6);
        return level(wellCounted) + std::log(wellCounted / pfa) / slope;
    }

    Grid gridOfBins()
    {
        return {{Axis{"frequency", "Hz", 0.0, 1.0, bins, false}}};
    }

    /// K for uncorrelated cells: the value for the recording's overlapping frames would let the statistic grow without
    /// bound.
    ResetRule ruleOf(const AnalysisSettings &settings)
    {
        const auto *smd = std::get_if<SmdSettings>(&settings.detector);
        if (!smd)
            return {};
        constexpr Index fitFrames = 1500;
        Random random(1, 1);
        std::vector<float> y(std::size_t(bins * fitFrames));
        for (float &value : y)
            value = float(random.exponential());
        const auto field =
            std::make_shared<FrameArray>(Axis{"time", "s", 0.0, 1.0, fitFrames, false}, gridOfBins(), std::move(y));
        return resetRule(*smd, fitReset({field}, makeModel(settings.model, gridOfBins()), *smd).lnK);
    }

    std::vector<float> statisticOn(const AnalysisSettings &settings, const ResetRule &rule, const RunContext &context,
                                   const Quantiles *law)
    {
        const Grid grid = gridOfBins();
        const auto detector = makeDetector(settings.detector, makeModel(settings.model, grid), grid,
                                           frameGeometry(settings.spectrogram), rule);
        Random random(1, 0);
        std::vector<float> y(static_cast<std::size_t>(bins));
        std::vector<float> row(y.size());
        std::vector<float> all;
        all.reserve(std::size_t(bins * frames));
        for (Index frame = 0; frame < frames + settling; ++frame) {
            context.checkpoint(double(frame) / double(frames + settling), "false alarms of this noise");
            for (float &value : y) {
                const double drawn = random.exponential();
                value = law ? law->at(drawn) : float(drawn);
            }
            detector->update(y, row);
            if (frame >= settling)
                all.insert(all.end(), row.begin(), row.end());
        }
        return all;
    }

} // namespace

std::vector<MisfitPfa> misfitPfa(std::span<const FittedBand> bands, const AnalysisSettings &settings, double pfa,
                                 const RunContext &context)
{
    const double passes = double(bands.size()) + 1.0;
    const auto statistic = [&, rule = ruleOf(settings)](double pass, const Quantiles *law) {
        return statisticOn(settings, rule, context.part(pass / passes, (pass + 1.0) / passes), law);
    };
    std::vector<float> nominal = statistic(0.0, nullptr);
    const double threshold = thresholdOf(nominal, pfa);
    std::vector<MisfitPfa> result;
    for (const FittedBand &band : bands) {
        const Quantiles law(band.law);
        std::vector<float> actual = statistic(double(result.size()) + 1.0, &law);
        result.push_back({pfa, exceedanceOf(actual, threshold)});
    }
    return result;
}

} // namespace faintline
