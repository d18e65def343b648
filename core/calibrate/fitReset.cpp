#include "calibrate/fitReset.h"

#include "base/Error.h"
#include "base/Field.h"
#include "calibrate/constants.h"
#include "plan/Calibration.h"

#include <cmath>
#include <limits>

namespace faintline {

namespace {

    /// Fraction of states continued, and mean ln K, on one noise field.
    ResetFit measureReset(const NormalisedFrames &noise, const MarkovModel &model, const ResetRule &rule)
    {
        Smd detector(model, rule);
        const auto cells = std::size_t(noise.grid().size());
        const Index frames = noise.time().count;
        std::vector<float> y(cells);
        std::vector<float> statistic(cells);
        double sum = 0.0;
        double sumLnK = 0.0;
        double counted = 0.0;
        for (Index frame = 0; frame < frames; ++frame) {
            noise.read(frame, 1, y);
            detector.update(y, statistic);
            if (frame < settlingFrames)
                continue;
            sum += detector.regulation().continuedFraction;
            sumLnK += detector.regulation().lnK;
            counted += 1.0;
        }
        return {sumLnK / counted, sum / counted};
    }

    ResetFit measureReset(const std::vector<NormalisedFramesPointer> &noise, const MarkovModel &model,
                          const ResetRule &rule)
    {
        ResetFit mean;
        for (const NormalisedFramesPointer &field : noise) {
            const ResetFit fit = measureReset(*field, model, rule);
            mean.lnK += fit.lnK / double(noise.size());
            mean.continuedFraction += fit.continuedFraction / double(noise.size());
        }
        return mean;
    }

    /// Whether more than half of the states continue, at any ln K. On given noise every score rises with K, and so does
    /// that fraction: what lies beyond an ln K that was tried is known.
    class HalfSearch
    {
    public:
        HalfSearch(const std::vector<NormalisedFramesPointer> &noise, const MarkovModel &model)
            : m_noise(noise), m_model(model)
        {
        }

        double fractionAt(double lnK) const
        {
            return measureReset(m_noise, m_model, {ResetLaw::Fixed, lnK}).continuedFraction;
        }

        bool isAbove(double lnK)
        {
            if (lnK <= m_below || lnK >= m_above)
                return lnK >= m_above;
            const double fraction = fractionAt(lnK);
            if (fraction > 0.5) {
                m_above = lnK;
                m_fractionAbove = fraction;
                return true;
            }
            m_below = lnK;
            m_fractionBelow = fraction;
            return false;
        }

        /// Encloses the answer closely, as a rule: around where regulation settles, then around the secant's root.
        void encloseClosely()
        {
            const double settled = measureReset(m_noise, m_model, {ResetLaw::Half, 0.0}).lnK;
            if (std::isfinite(settled) && !isAbove(settled - lnKBracketNats) && isAbove(settled + lnKBracketNats)) {
                const double root =
                    m_below + (m_above - m_below) * (0.5 - m_fractionBelow) / (m_fractionAbove - m_fractionBelow);
                isAbove(root - lnKSecantToleranceNats);
                isAbove(root + lnKSecantToleranceNats);
            }
        }

    private:
        const std::vector<NormalisedFramesPointer> &m_noise;
        const MarkovModel &m_model;
        double m_below = -std::numeric_limits<double>::infinity();
        double m_above = std::numeric_limits<double>::infinity();
        double m_fractionBelow = 0.0;
        double m_fractionAbove = 1.0;
    };

    /// ln K at which half of the states continue, by bisection.
    double lnKForHalf(const std::vector<NormalisedFramesPointer> &noise, const MarkovModel &model)
    {
        double low = -lnKLimitNats;
        double high = lnKLimitNats;
        HalfSearch search(noise, model);
        search.encloseClosely(); // most of the steps below are then known
        while (high - low > lnKToleranceNats) {
            const double middle = 0.5 * (low + high);
            (search.isAbove(middle) ? high : low) = middle;
        }
        const double end = low > -lnKLimitNats ? lnKLimitNats : -lnKLimitNats;
        const bool isInside = low > -lnKLimitNats && high < lnKLimitNats;
        const double percent = isInside ? 50.0 : 100.0 * search.fractionAt(end);
        if (isInside || std::isnan(percent)) // nothing can be measured on a few frames
            return 0.5 * (low + high);
        throw fieldError("model.snr", formatNumber(model.likelihood.snr()),
                         "permits no ln K at which half of the states continue on noise: at " + formatNumber(end)
                             + " nat " + formatNumber(std::round(10.0 * percent) / 10.0) + " % do; choose a "
                             + (end > 0.0 ? "lower" : "higher") + " one");
    }

} // namespace

ResetFit fitReset(const std::vector<NormalisedFramesPointer> &noise, const MarkovModel &model, const SmdSettings &smd)
{
    const bool isFound = smd.reset == SmdSettings::Reset::Calibrated || smd.reset == SmdSettings::Reset::Half;
    const double lnK = isFound ? lnKForHalf(noise, model) : smd.lnK;
    const ResetFit measured = measureReset(noise, model, resetRule(smd, lnK));
    return {smd.reset == SmdSettings::Reset::Mean ? measured.lnK : lnK, measured.continuedFraction};
}

} // namespace faintline
