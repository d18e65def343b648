#include "base/logmath.h"
#include "evaluate/theory/walkOnLine.h"
#include "reproduce/grossiParts.h"

namespace faintline {

namespace {

    struct TrackReference {
        double snrDb;
        std::array<double, 5> last;
        std::array<double, 5> track;
        double missesPerThousand;
    };
    constexpr std::array<TrackReference, 4> figure3References{{
        {0.0, {.957, .866, .696, .546, .466}, {.925, .344, .013, 0.0, 0.0}, 1.05},
        {3.0, {.995, .972, .927, .867, .824}, {.998, .915, .427, .041, .004}, 0.99},
        {6.0, {1.0, .995, .986, .971, .957}, {1.0, .995, .871, .350, .076}, 0.74},
        {10.0, {1.0, 1.0, .999, .997, .996}, {1.0, 1.0, .989, .791, .455}, 0.59},
    }};
    constexpr double figure3ReferenceTrials = 6000.0; ///< a standard error of at most 0.0065

    Reproduction reproduceFigure3(const ReproduceOptions &options, const RunContext &context)
    {
        Reproduction made;
        made.name = "grossi:figure3";
        made.title = "Correct last cell and correct trajectory against what is known of it (Grossi and Lops 2006, "
                     "Figure 3): M = 100";
        made.quantity = "probability, given H1 accepted";
        SequentialStudy study;
        study.trials = reducedTrials(5000, options);
        study.estimatesTrajectory = true;
        Chart lastChart{
            "Last cell correct within two cells, M = 100", "entropy rate / ln M", "P_c,last", false, false, {}};
        Chart trackChart{"Trajectory correct within five cells all along, M = 100",
                         "entropy rate / ln M",
                         "P_c,track",
                         false,
                         false,
                         {}};
        double done = 0.0;
        for (const TrackReference &reference : figure3References) {
            const double snr = ratioFromDb(reference.snrDb);
            const std::string name = formatNumber(reference.snrDb) + " dB";
            Curve last{name, Curve::Kind::Measured, {}};
            Curve track{name, Curve::Kind::Measured, {}};
            Index misses = 0;
            study.actualSnr = snr;
            for (std::size_t i = 0; i < walkDeviations.size(); ++i) {
                study.model = walkOnLine(100, walkDeviations[i], snr);
                study.seed = options.seed * 1000 + std::uint64_t(500.0 + 10.0 * reference.snrDb) + i;
                const SequentialOutcome outcome = simulate(study, context.part(done, done + 0.05));
                done += 0.05;
                misses += study.trials - outcome.acceptedH1;
                const std::string column = deviationName(walkDeviations[i]);
                made.cells.push_back(frequencyCell(name + ", last", column, {outcome.correctLast, outcome.acceptedH1},
                                                   {reference.last[i], figure3ReferenceTrials, 1e-3}));
                made.cells.push_back(frequencyCell(name + ", track", column, {outcome.correctTrack, outcome.acceptedH1},
                                                   {reference.track[i], figure3ReferenceTrials, 1e-3}));
                const double x = relativeEntropyRate(100, walkDeviations[i]);
                const ReproducedCell &trackCell = made.cells.back();
                const ReproducedCell &lastCell = made.cells[made.cells.size() - 2];
                last.points.push_back({x, lastCell.ours, lastCell.interval});
                track.points.push_back({x, trackCell.ours, trackCell.interval});
            }
            const Index trials = study.trials * std::ssize(walkDeviations);
            ReproducedCell missed =
                frequencyCell(name, "P(miss), all σ", {misses, trials},
                              {1e-3 * reference.missesPerThousand, 5.0 * figure3ReferenceTrials, 1e-5});
            missed.tolerance = toleranceOf(frequencyError(*missed.reference, 5.0 * figure3ReferenceTrials),
                                           frequencyError(*missed.reference, double(trials)), 1e-5);
            made.cells.push_back(std::move(missed));
            lastChart.curves.push_back(std::move(last));
            trackChart.curves.push_back(std::move(track));
        }
        made.charts = {std::move(lastChart), std::move(trackChart)};
        made.notes.push_back(
            "The test is designed at the actual SNR, so P_d hardly depends on it: a lower SNR is paid for with stages, "
            "and with trajectories that "
            "are longer and less often correct.");
        return made;
    }

} // namespace

Reproducible grossiTrajectories()
{
    return {"grossi:figure3", "Grossi and Lops 2006, Figure 3: how often the trajectory is correct", reproduceFigure3};
}

} // namespace faintline
