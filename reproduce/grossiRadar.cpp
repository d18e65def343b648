#include "base/logmath.h"
#include "evaluate/sequential/ScanTest.h"
#include "reproduce/grossiParts.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace faintline {

namespace {

    struct RadarReference {
        std::optional<double> snrDb; ///< empty: noise only
        PublishedAsn stages;
        double variation;
        double acceptH1;
        double acceptRounding;
    };
    const std::array<RadarReference, 8> &figure4References()
    {
        static const std::array<RadarReference, 8> table{{
            {std::nullopt, {11.019, .017}, .157, 2e-4, 1e-4},
            {0.0, {11.054, .018}, .159, 2e-4, 1e-4},
            {4.0, {12.110, .032}, .264, .0375, 1e-4},
            {6.0, {12.748, .050}, .392, .300, 1e-3},
            {8.0, {9.384, .058}, .619, .798, 1e-3},
            {10.0, {5.045, .039}, .770, .984, 1e-3},
            {12.0, {2.962, .022}, .733, .9995, 1e-4},
            {16.0, {1.608, .009}, .586, 1.0, 1e-4},
        }};
        return table;
    }
    constexpr double figure4ReferenceTrials = 10000.0;

    SequentialModel radarModel()
    {
        ScanScene scene;
        scene.rangeCells = 100;
        scene.dopplerCells = 16;
        return scanModel(scene, 12.0);
    }

    /// Figure under construction.
    class RadarFigure
    {
    public:
        RadarFigure(const ReproduceOptions &options, const RunContext &context) : m_options(options), m_context(context)
        {
            m_made.name = "grossi:figure4";
            m_made.title = "ASN and its coefficient of variation in the radar case (Grossi and Lops 2006, Figure 4): 3 "
                           "× 3 × 100 × 16 cells, "
                           "cut-off 20 stages, design SNR 12 dB";
            m_made.quantity = "ASN (stages), CV, P(accept H1)";
            m_study.model = radarModel();
            m_study.sprt.cutOffStage = 20;
            m_study.trials = reducedTrials(10000, options);
        }

        Reproduction make()
        {
            for (std::size_t i = 0; i < figure4References().size(); ++i)
                addPoint(figure4References()[i], i);
            addAveraged();
            addCharts();
            addNotes();
            return std::move(m_made);
        }

    private:
        void addPoint(const RadarReference &reference, std::size_t number)
        {
            const std::string column = reference.snrDb ? formatNumber(*reference.snrDb) + " dB" : "H0";
            m_study.actualSnr = reference.snrDb ? std::optional(ratioFromDb(*reference.snrDb)) : std::nullopt;
            m_study.seed = m_options.seed * 1000 + 900 + number;
            const double from = 0.1 * double(number);
            const SequentialOutcome outcome = simulate(m_study, m_context.part(from, from + 0.1));
            m_made.cells.push_back(
                measuredCell("ASN", column, outcome.stages, {reference.stages.value, reference.stages.error, 1e-3}));
            const double variationError =
                outcome.variation.standardError * std::sqrt(double(m_study.trials) / figure4ReferenceTrials);
            ReproducedCell cv =
                measuredCell("CV", column, outcome.variation, {reference.variation, variationError, 1e-3});
            cv.tolerance *= 2.0;
            m_made.cells.push_back(std::move(cv));
            m_made.cells.push_back(
                frequencyCell("P(accept H1)", column, {outcome.acceptedH1, m_study.trials},
                              {reference.acceptH1, figure4ReferenceTrials, reference.acceptRounding}));
            if (!reference.snrDb) {
                m_noiseStages = outcome.stages.value;
                m_noiseVariation = outcome.variation.value;
                return;
            }
            m_stages.points.push_back({*reference.snrDb, outcome.stages.value, outcome.stages.interval()});
            m_variation.points.push_back({*reference.snrDb, outcome.variation.value, outcome.variation.interval()});
            m_acceptance.points.push_back({*reference.snrDb, m_made.cells.back().ours, m_made.cells.back().interval});
        }

        /// With the noise power estimated from neighbouring cells.
        void addAveraged()
        {
            m_study.actualSnr.reset();
            m_study.trials = std::max<Index>(100, m_study.trials / 5);
            for (const Index cells : {32, 16}) {
                m_study.averagedCells = cells;
                const SequentialOutcome outcome = simulate(m_study, m_context.part(0.9, 1.0));
                m_made.cells.push_back(measuredCell("ASN", "H0, noise power from " + std::to_string(cells) + " cells",
                                                    outcome.stages,
                                                    {cells == 32 ? 13.1 : 15.4, outcome.stages.standardError, 0.1}));
            }
        }

        Curve onNoise(double value) const
        {
            const std::vector<Curve::Point> &points = m_stages.points;
            return {"on noise", Curve::Kind::Theory, {{points.front().x, value, {}}, {points.back().x, value, {}}}};
        }

        void addCharts()
        {
            m_made.charts = {
                {"Stages in the radar case, designed for 12 dB",
                 "actual SNR (dB)",
                 "ASN (stages)",
                 false,
                 false,
                 {m_stages, onNoise(m_noiseStages)}},
                {"Their coefficient of variation",
                 "actual SNR (dB)",
                 "standard deviation / mean",
                 false,
                 false,
                 {m_variation, onNoise(m_noiseVariation)}},
                {"Acceptance of a target", "actual SNR (dB)", "P(accept H1)", false, false, {m_acceptance}}};
        }

        void addNotes()
        {
            const auto peak = std::max_element(m_stages.points.begin(), m_stages.points.end(),
                                               [](const auto &a, const auto &b) { return a.y < b.y; });
            m_made.notes.emplace_back(
                "ASN peaks at " + formatNumber(peak->x) + " dB, " + inFormat("%.2f", peak->y) + " stages against "
                + inFormat("%.2f", m_noiseStages)
                + " on noise: half-way between noise and the design SNR ln Λ has no drift, and only the cut-off ends "
                  "the test. A test designed at each actual SNR has no such peak; it saturates at the cut-off and "
                  "falls.");
            m_made.notes.emplace_back(
                "The publication's cell averaging is not described: sliding means of the 32 or 16 "
                "neighbours in range are shown, with the exact likelihood ratio of such a quotient. "
                "All other cells know the noise power.");
        }

        const ReproduceOptions &m_options;
        const RunContext &m_context;
        SequentialStudy m_study;
        Reproduction m_made;
        Curve m_stages{"ASN with a target", Curve::Kind::Measured, {}};
        Curve m_variation{"CV with a target", Curve::Kind::Measured, {}};
        Curve m_acceptance{"P(accept H1)", Curve::Kind::Measured, {}};
        double m_noiseStages = 0.0;
        double m_noiseVariation = 0.0;
    };

} // namespace

Reproducible grossiRadar()
{
    return {"grossi:figure4",
            "Grossi and Lops 2006, Figure 4: stages and detections in the radar case, against the SNR",
            [](const ReproduceOptions &options, const RunContext &context) {
                return RadarFigure(options, context).make();
            }};
}

} // namespace faintline
