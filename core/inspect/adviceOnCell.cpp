#include "base/driftWords.h"
#include "base/numberText.h"
#include "inspect/advice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>

namespace faintline {

namespace {

    constexpr std::array<Index, 3> stretchFrames{8, 16, 32}; ///< before the cell, behind it, or both
    constexpr double slopeRatio = 1.06; ///< of neighbouring slopes, which part by less than they smear a line
    constexpr double mostSlope = 64.0;  ///< bins per frame
    constexpr double mostPower = 5.0;   ///< of a cell, so that a few strong ones are no line
    constexpr Index reachCells = 4096;  ///< about the cell; the steepest lines and what lies beside them take 2300

    /// Sums of clipped powers.
    struct ClippedSum {
        double power = 0.0;
        double cells = 0.0;

        void add(const ClippedSum &other)
        {
            power += other.power;
            cells += other.cells;
        }
        double mean() const { return cells > 0.0 ? power / cells : 0.0; }
    };

    /// The cells around one, with each frame's running sums of clipped powers.
    class Surroundings
    {
    public:
        Surroundings(const Analysis &analysis, Index frame, Index cell, const RunContext &context)
            : m_frame(frame), m_firstCell(std::max<Index>(cell - reachCells, 0)), m_cell(cell - m_firstCell),
              m_cells(std::min(cell + reachCells + 1, analysis.grid().size()) - m_firstCell)
        {
            m_first = std::max<Index>(frame - stretchFrames.back(), 0);
            const Index end = std::min(frame + stretchFrames.back() + 1, analysis.time().count);
            std::vector<float> y(std::size_t(analysis.grid().size()));
            for (Index t = m_first; t < end; ++t) {
                context.checkpoint(double(t - m_first) / double(end - m_first), "looking for faster lines");
                analysis.frames->read(t, 1, y);
                std::vector<ClippedSum> sums(1);
                for (const float power : std::span(y).subspan(std::size_t(m_firstCell), std::size_t(m_cells))) {
                    sums.push_back(sums.back());
                    if (std::isfinite(power))
                        sums.back().add({std::min(double(power), mostPower), 1.0});
                }
                m_sums.push_back(std::move(sums));
            }
        }

        /// The cells `width` wide about a line of that slope through the cell, moved sideways by `shift` cells.
        ClippedSum along(double slope, double width, double shift, Index before, Index behind) const
        {
            ClippedSum sum;
            for (Index t = std::max(m_frame - before, m_first);
                 t <= m_frame + behind && t - m_first < std::ssize(m_sums); ++t) {
                const double middle = double(m_cell) + slope * double(t - m_frame) + shift;
                const auto at = [&](double place) { return std::clamp<Index>(std::lround(place), 0, m_cells); };
                const auto &sums = m_sums[std::size_t(t - m_first)];
                const ClippedSum &to = sums[std::size_t(at(middle + 0.5 * width + 0.5))];
                const ClippedSum &from = sums[std::size_t(at(middle - 0.5 * width + 0.5))];
                sum.add({to.power - from.power, to.cells - from.cells});
            }
            return sum;
        }

    private:
        Index m_frame;
        Index m_firstCell;
        Index m_cell; ///< counted from the first, as all cells here
        Index m_cells;
        Index m_first = 0;
        std::vector<std::vector<ClippedSum>> m_sums;
    };

    struct FastLine {
        double slope = 0.0; ///< bins per frame
        double evidence = 0.0;
    };

    /// How much likelier the cells of a line are with a level of their own than with that beside them.
    double evidenceOf(const Surroundings &around, double slope, Index before, Index behind)
    {
        const double width = std::abs(slope);
        const ClippedSum on = around.along(slope, width, 0.0, before, behind);
        ClippedSum beside;
        for (const double shift : {-3.0, -2.0, 2.0, 3.0})
            beside.add(around.along(slope, width, shift * width, before, behind));
        const double noise = std::max(1.0 - std::exp(-mostPower), beside.mean());
        const double ratio = on.mean() / noise;
        return ratio > 1.0 ? on.cells * (ratio - 1.0 - std::log(ratio)) : 0.0;
    }

    /// The best of the lines through a cell with a slope above `steepest`, if it stands out.
    std::optional<FastLine> fastLineThrough(const Analysis &analysis, Index frame, Index cell, double steepest,
                                            const RunContext &context)
    {
        const FrameGeometry geometry = analysis.frames->geometry();
        const Surroundings around(analysis, frame, cell, context);
        const double dependence = geometry.framesPerWindow * geometry.binsPerCell;
        FastLine best;
        int tried = 0;
        for (double slope = std::max(steepest, 1.0) * slopeRatio; slope <= mostSlope; slope *= slopeRatio)
            for (const double sign : {-1.0, 1.0})
                for (const Index frames : stretchFrames)
                    for (const auto &[before, behind] :
                         {std::pair(frames, Index(0)), std::pair(Index(0), frames), std::pair(frames, frames)}) {
                        ++tried;
                        const double evidence = evidenceOf(around, sign * slope, before, behind) / dependence;
                        if (evidence > best.evidence)
                            best = {sign * slope, evidence};
                    }
        const bool standsOut = best.evidence > analysis.threshold + std::log(std::max(tried, 1));
        return standsOut ? std::optional(best) : std::nullopt;
    }

    double hzPerSecondOfASlope(const Analysis &analysis)
    {
        return analysis.grid().axes.back().step / analysis.time().step;
    }

    std::optional<Advice> adviceOnFastLine(const Analysis &analysis, const Explanation &explanation,
                                           const RunContext &context)
    {
        double limit = 0.0; // Hz/s
        for (const auto &other : analysis.others)
            limit = std::max(limit, steepestSlope(other->model.space) * hzPerSecondOfASlope(*other));
        const double unit = hzPerSecondOfASlope(analysis);
        const double own = steepestSlope(analysis.model.space);
        if (own == 0.0)
            return {};
        limit = std::max(limit, own * unit);
        const Index cell = analysis.grid().axes.back().nearest(explanation.position.back());
        const auto line =
            fastLineThrough(analysis, analysis.time().nearest(explanation.seconds), cell, limit / unit, context);
        if (!line)
            return {};
        const double drift = line->slope * unit;
        Advice advice{"fastLine",
                      "a line that drifts by " + driftWords(drift) + " runs through here; this model ends at ±"
                          + driftWords(limit),
                      {},
                      analysis.settings};
        // In a window half as long the same drift is a quarter of the slope in bins per frame.
        const double halvings = std::ceil(0.5 * std::log2(std::abs(line->slope) / own));
        setWindow(advice, analysis.frames->geometry().windowSeconds * std::exp2(-halvings));
        return advice;
    }

    std::optional<Advice> adviceOnThreshold(const Analysis &analysis, const Explanation &explanation)
    {
        constexpr double nearShare = 0.5;    ///< of the threshold
        constexpr double mostAlarms = 100.0; ///< of the requested ones
        const double statistic = explanation.displayed;
        if (!analysis.calibration || statistic < nearShare * analysis.threshold)
            return {};
        const auto alarms = [&](double nats) {
            return analysis.calibration->eventRateAt(nats) * analysis.cellFramesPerHour;
        };
        // Rounded up to two digits, so that the threshold lies below.
        const double wanted = alarms(statistic);
        const double decade = std::pow(10.0, std::floor(std::log10(wanted)) - 1.0);
        const double allowed = std::ceil(1.001 * wanted / decade) * decade;
        if (!(allowed <= mostAlarms * alarms(analysis.threshold)))
            return {};
        char text[40];
        std::snprintf(text, sizeof text, "%.2g", allowed);
        Advice advice{"threshold",
                      "this cell would be part of an event with " + std::string(text) + " false alarms per hour",
                      "allow " + std::string(text) + " false alarms per hour", analysis.settings};
        advice.settings.decide.falseAlarmsPerHour = *parseNumber(text);
        advice.settings.decide.by = DecideSettings::By::FalseAlarmsPerHour;
        return advice;
    }

} // namespace

std::optional<Advice> adviceOnCell(const Analysis &analysis, const Explanation &explanation, const RunContext &context)
{
    const bool isFound =
        explanation.isTracked || explanation.displayed >= explanation.threshold || explanation.otherWindowTrack;
    if (isFound || explanation.inhibitedFor || explanation.isExplainedByNoise
        || !analysis.frames->geometry().isOfSpectra() || !analysis.settings.family.isNone())
        return {};
    if (auto fast = adviceOnFastLine(analysis, explanation, context))
        return fast;
    return adviceOnThreshold(analysis, explanation);
}

} // namespace faintline
