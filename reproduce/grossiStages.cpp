#include "base/logmath.h"
#include "evaluate/theory/waldTheory.h"
#include "evaluate/theory/walkOnLine.h"
#include "reproduce/grossiParts.h"

namespace faintline {

namespace {

    struct LineReference {
        int cells;
        Index trials; ///< ours
        std::array<PublishedAsn, 5> h0;
        std::array<PublishedAsn, 5> h1;
        double h0Bound;
        double h1Bound;
    };
    const std::array<LineReference, 4> &figure2References()
    {
        static const std::array<LineReference, 4> table{{
            {10,
             40000,
             {{{96.96, .21}, {116.88, .26}, {128.83, .30}, {134.90, .32}, {135.15, .32}}},
             {{{63.08, .21}, {84.09, .27}, {99.44, .31}, {105.26, .32}, {106.23, .32}}},
             132.77,
             97.85},
            {20,
             20000,
             {{{113.77, .24}, {153.49, .34}, {188.38, .44}, {209.20, .50}, {216.76, .52}}},
             {{{68.90, .24}, {103.59, .34}, {141.19, .44}, {167.36, .51}, {174.60, .53}}},
             212.49,
             162.01},
            {50,
             8000,
             {{{120.88, .27}, {193.20, .43}, {280.62, .64}, {373.89, .90}, {417.0, 1.0}}},
             {{{70.87, .26}, {118.46, .42}, {194.75, .64}, {295.13, .91}, {347.2, 1.0}}},
             411.72,
             326.16},
            {100,
             5000,
             {{{121.78, .55}, {203.1, .9}, {342.7, 1.5}, {548.2, 2.6}, {705.8, 3.5}}},
             {{{70.11, .51}, {122.1, .9}, {222.2, 1.5}, {417.2, 2.7}, {603.0, 3.5}}},
             696.52,
             565.52},
        }};
        return table;
    }

    void addKnownTrajectory(Reproduction &made, const SprtSettings &sprt)
    {
        const DeterministicSprt exact = deterministicSprt(sprt, 1.0, 1.0);
        const WaldBounds bounds = waldBounds(sprt, 1.0, 1);
        const std::string h0 = "known trajectory, H0";
        const std::string h1 = "known trajectory, H1";
        made.cells.push_back(exactCell(h0, "0 dB", exact.h0.meanStages, 36.984, 1e-3));
        made.cells.push_back(exactCell(h1, "0 dB", exact.h1.meanStages, 25.728, 1e-3));
        made.cells.push_back(exactCell(h0, "(8) lower", bounds.h0Low, 35.688, 1e-3));
        made.cells.push_back(exactCell(h1, "(8) lower", bounds.h1Low, 22.463, 1e-3));
        made.cells.push_back(exactCell(h0, "deviation", exact.h0.deviationStages, 15.670, 1e-3));
        made.cells.push_back(exactCell(h1, "deviation", exact.h1.deviationStages, 16.120, 1e-3));
        made.cells.push_back(exactCell(h0, "α", exact.h0.acceptH1, 5.001e-4, 1e-7));
        made.cells.push_back(exactCell(h1, "β", exact.h1.acceptH0, 7.947e-4, 1e-7));
        constexpr std::array<std::array<double, 3>, 3> others{
            {{3.0, 16.938, 9.898}, {6.0, 9.304, 4.579}, {10.0, 5.273, 2.222}}};
        for (const auto &[snrDb, asnH0, asnH1] : others) {
            const double snr = ratioFromDb(snrDb);
            const DeterministicSprt at = deterministicSprt(sprt, snr, snr);
            made.cells.push_back(exactCell(h0, formatNumber(snrDb) + " dB", at.h0.meanStages, asnH0, 1e-3));
            made.cells.push_back(exactCell(h1, formatNumber(snrDb) + " dB", at.h1.meanStages, asnH1, 1e-3));
        }
        made.notes.push_back(
            "Known trajectory: Fredholm's integral equation, exact; a test of fixed size with the same errors takes "
            + std::to_string(fixedSampleSize(sprt, 1.0)) + " stages at 0 dB.");
    }

    Curve levelCurve(const std::string &name, double level)
    {
        return {name, Curve::Kind::Theory, {{0.0, level, {}}, {1.0, level, {}}}};
    }

    /// Figure under construction: H0 first, then H1.
    class StagesFigure
    {
    public:
        StagesFigure(const ReproduceOptions &options, const RunContext &context)
            : m_options(options), m_context(context), m_known(deterministicSprt(m_study.sprt, 1.0, 1.0)),
              m_charts{{{"ASN on noise, H0", "entropy rate / ln M", "stages", false, true, {}},
                        {"ASN with a target, H1", "entropy rate / ln M", "stages", false, true, {}}}}
        {
            m_made.name = "grossi:figure2";
            m_made.title = "ASN under both hypotheses against what is known of the trajectory (Grossi and Lops 2006, "
                           "Figure 2): 0 dB, α = β = 1e-3";
            m_made.quantity = "ASN (stages)";
            addKnownTrajectory(m_made, m_study.sprt);
        }

        Reproduction make()
        {
            for (const LineReference &reference : figure2References())
                for (const bool isTarget : {false, true})
                    addLine(reference, isTarget);
            addBounds();
            return std::move(m_made);
        }

    private:
        void addLine(const LineReference &reference, bool isTarget)
        {
            const std::string lineName = "M = " + std::to_string(reference.cells);
            const std::string row = lineName + (isTarget ? ", H1" : ", H0");
            Curve curve{
                lineName, Curve::Kind::Measured, {{0.0, isTarget ? m_known.h1.meanStages : m_known.h0.meanStages, {}}}};
            m_study.actualSnr = isTarget ? std::optional(1.0) : std::nullopt;
            m_study.trials = reducedTrials(reference.trials, m_options);
            for (std::size_t i = 0; i < walkDeviations.size(); ++i) {
                const double deviation = walkDeviations[i];
                m_study.model = walkOnLine(reference.cells, deviation, 1.0);
                m_study.seed = m_options.seed * 1000 + std::uint64_t(reference.cells * 10 + (isTarget ? 5 : 0)) + i;
                const SequentialOutcome outcome = simulate(m_study, m_context.part(m_done, m_done + 0.025));
                m_done += 0.025;
                const PublishedAsn &asn = isTarget ? reference.h1[i] : reference.h0[i];
                const double rounding = reference.cells == 100 || asn.error >= 0.95 ? 0.1 : 0.01;
                m_made.cells.push_back(
                    measuredCell(row, deviationName(deviation), outcome.stages, {asn.value, asn.error, rounding}));
                curve.points.push_back(
                    {relativeEntropyRate(reference.cells, deviation), outcome.stages.value, outcome.stages.interval()});
                if (reference.cells == 10 && deviation == 1.0)
                    addErrors(row + ", σ = 1", isTarget, outcome);
            }
            const WaldBounds bounds = waldBounds(m_study.sprt, 1.0, reference.cells);
            const double bound = isTarget ? bounds.h1High : bounds.h0High;
            m_made.cells.push_back(
                exactCell(row, "(8) upper", bound, isTarget ? reference.h1Bound : reference.h0Bound, 0.006));
            std::string &list = m_excess[isTarget ? 1 : 0];
            list += (list.empty() ? "" : ", ") + inFormat("%+.1f", 100.0 * (curve.points.back().y / bound - 1.0))
                    + " % at " + lineName;
            m_charts[isTarget ? 1 : 0].curves.push_back(std::move(curve));
            m_upper[isTarget ? 1 : 0].push_back(levelCurve("(8) upper, " + lineName, bound));
        }

        void addErrors(const std::string &row, bool isTarget, const SequentialOutcome &outcome)
        {
            m_made.cells.push_back(measuredCell(row, isTarget ? "α by change of measure" : "β by change of measure",
                                                outcome.otherError,
                                                {isTarget ? 6.107e-4 : 8.785e-4, isTarget ? 4e-7 : 1e-7, 1e-7}));
            const Index wrong = isTarget ? m_study.trials - outcome.acceptedH1 : outcome.acceptedH1;
            const auto trials = double(m_study.trials);
            ReproducedCell counted = frequencyCell(row, isTarget ? "β counted" : "α counted", {wrong, m_study.trials},
                                                   {isTarget ? 8.63e-4 : 6.08e-4, 400000.0, 1e-6});
            // The counts are small: the tolerance follows from the expected number, not from the observed one.
            counted.tolerance = toleranceOf(frequencyError(*counted.reference, 400000.0),
                                            frequencyError(*counted.reference, trials), 1.0 / trials);
            m_made.cells.push_back(std::move(counted));
        }

        void addBounds()
        {
            const WaldBounds lower = waldBounds(m_study.sprt, 1.0, 1);
            for (std::size_t i = 0; i < m_charts.size(); ++i) {
                m_charts[i].curves.insert(m_charts[i].curves.end(), m_upper[i].begin(), m_upper[i].end());
                m_charts[i].curves.push_back(levelCurve("(8) lower", i == 0 ? lower.h0Low : lower.h1Low));
            }
            m_made.charts.assign(m_charts.begin(), m_charts.end());
            m_made.notes.push_back("(8) neglects by how far ln Λ overshoots its boundary, so its \"upper bound\" is "
                                   "exceeded at the uniform end: H0 "
                                   + m_excess[0] + "; H1 " + m_excess[1] + ".");
            m_made.notes.push_back(
                "σ, in cells, is the walk's discretised Gaussian step, rows renormalised on the line; the start is the "
                "row of the middle cell. "
                "α ≤ 1/γ1 and β ≤ γ0 hold for any law; the specified 1e-3 is not reached because of the overshoot.");
        }

        const ReproduceOptions &m_options;
        const RunContext &m_context;
        SequentialStudy m_study;
        DeterministicSprt m_known;
        Reproduction m_made;
        std::array<Chart, 2> m_charts;
        std::array<std::vector<Curve>, 2> m_upper;
        std::array<std::string, 2> m_excess;
        double m_done = 0.0;
    };

} // namespace

Reproducible grossiStages()
{
    return {"grossi:figure2", "Grossi and Lops 2006, Figure 2: stages taken, against what is known of the trajectory",
            [](const ReproduceOptions &options, const RunContext &context) {
                return StagesFigure(options, context).make();
            }};
}

} // namespace faintline
