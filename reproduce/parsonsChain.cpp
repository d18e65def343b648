#include "reproduce/parsonsParts.h"

#include "base/Field.h"
#include "evaluate/experiments/PingExperiment.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr int chainRuns = 12;
    constexpr int vanishPing = 45;

    /// Results of the chain of an independent program in twelve runs, for one model and SNR.
    struct ChainCase {
        std::string preset;
        double snrDb = 0.0;
        int confirmedSteady = 0;
        int confirmedWeaving = -1; ///< -1: no such target
        double falseConfirmed = 0.0;
    };

    const std::vector<ChainCase> &chainCases()
    {
        static const std::vector<ChainCase> cases{{"sonar", 9.0, 12, 12, 0},
                                                  {"sonar", 7.0, 11, 9, 3},
                                                  {"sonarSteady", 9.0, 12, -1, 0},
                                                  {"sonarSteady", 7.0, 12, -1, 0},
                                                  {"sonarSteady", 5.0, 12, -1, 0}};
        return cases;
    }

    /// Target A keeps its rates, B weaves in range; both vanish after 45 of the 60 pings.
    PingScene chainScene(const ChainCase &wanted)
    {
        PingScene scene;
        PingTarget steady;
        steady.snrDb = wanted.snrDb;
        steady.rangeMetres = 8000.0;
        steady.bearingDegrees = 36.0;
        steady.vanishPing = vanishPing;
        steady.legs = {{0, 0.0, 0.0, 3.0, 1.0, 1}};
        scene.targets.push_back(steady);
        if (wanted.confirmedWeaving >= 0) {
            PingTarget weaving = steady;
            weaving.rangeMetres = 18000.0;
            weaving.legs = {{0, 0.0, 0.0, 2.0, 0.0, 1}};
            weaving.weaveCellsPerPing = 6.0;
            scene.targets.push_back(weaving);
        }
        return scene;
    }

    double medianOf(std::vector<double> values)
    {
        if (values.empty())
            return 0.0;
        std::sort(values.begin(), values.end());
        return values[(values.size() - 1) / 2];
    }

    void addChainCells(const ChainCase &wanted, const std::vector<TrackScore> &scores, int runs, Reproduction &made)
    {
        const std::string row = wanted.preset + ", " + formatNumber(wanted.snrDb) + " dB";
        const double share = double(runs) / chainRuns;
        double falseConfirmed = 0.0;
        double falseTracks = 0.0;
        for (const TrackScore &score : scores) {
            falseConfirmed += score.falseConfirmed;
            falseTracks += score.falseTracks;
        }
        for (std::size_t target = 0; target < scores.front().targets.size(); ++target) {
            const std::string name = target == 0 ? "A: " : "B: ";
            double confirmed = 0.0;
            double squares = 0.0;
            double points = 0.0;
            std::vector<double> detect;
            std::vector<double> confirm;
            for (const TrackScore &score : scores) {
                const TargetScore &own = score.targets[target];
                confirmed += own.isConfirmed() ? 1.0 : 0.0;
                squares += own.rmsCells[0] * own.rmsCells[0] * double(own.matchedPoints);
                points += double(own.matchedPoints);
                if (own.isDetected())
                    detect.push_back(double(own.detectLatency));
                if (own.isConfirmed())
                    confirm.push_back(double(own.confirmLatency));
            }
            // As good or better: judged from below only, up to the number of runs.
            const double reference = share * (target == 0 ? wanted.confirmedSteady : wanted.confirmedWeaving);
            const double best = runs;
            ReproducedCell cell = cellOf(row, name + "confirmed of " + std::to_string(runs), confirmed);
            made.cells.push_back(confirmed >= reference ? judged(cell, reference, best - reference)
                                                        : judged(cell, reference, 0.0));
            made.cells.push_back(cellOf(row, name + "median ping of detection", medianOf(detect)));
            made.cells.push_back(cellOf(row, name + "median ping of confirmation", medianOf(confirm)));
            made.cells.push_back(
                cellOf(row, name + "RMS range error, cells", points > 0.0 ? std::sqrt(squares / points) : 0.0));
        }
        made.cells.push_back(
            judged(cellOf(row, "false confirmed", falseConfirmed), 0.0, std::ceil(share * wanted.falseConfirmed)));
        made.cells.push_back(cellOf(row, "false tracks", falseTracks));
    }

    Reproduction reproduceFigure1(const ReproduceOptions &options, const RunContext &context)
    {
        Reproduction made{"parsons:figure1",
                          "Parsons 2008, Figure 1: the chain from detector to tracks",
                          "12 runs of 60 pings",
                          {},
                          {},
                          {}};
        const auto count = double(chainCases().size());
        const int runs = options.quick ? 3 : chainRuns;
        for (std::size_t i = 0; i < chainCases().size(); ++i) {
            PingExperiment experiment;
            experiment.scene = chainScene(chainCases()[i]);
            experiment.settings = preset(chainCases()[i].preset).settings;
            experiment.runs = runs;
            experiment.seed = options.seed;
            const auto scores = runPings(experiment, context.part(double(i) / count, double(i + 1) / count));
            addChainCells(chainCases()[i], scores, runs, made);
        }
        made.notes = {"The paper's Figure 1 is a diagram: the references are an independent program's chain. Confirmed "
                      "targets are "
                      "judged from below, "
                      "false confirmed tracks from above.",
                      "A keeps its rates (3 cells and 1 beam a ping), B weaves in range by ±6 cells a ping about 2, "
                      "period 20; both "
                      "vanish after 45 pings."};
        return made;
    }

} // namespace

std::vector<Reproducible> parsonsChain()
{
    return {{"parsons:figure1", "Parsons 2008, Figure 1: the chain from detector to tracks", reproduceFigure1}};
}

} // namespace faintline
