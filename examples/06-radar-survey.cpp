// A radar looks into one sector after the other, into each until it is sure. Most are empty and are left early.
#include "base/logmath.h"
#include "detect/Survey.h"
#include "evaluate/sequential/SequentialStudy.h"
#include "recording/ScanScene.h"

#include <cstdio>
#include <vector>

using namespace faintline;

int main()
{
    // What may be there: a target of 10 dB somewhere in 3 × 3 × 40 cells that moves by at most one cell a scan, its
    // Doppler unknown.
    const auto spatial = [](const char *name, Index cells) {
        KinematicAxis axis;
        axis.name = name;
        axis.cells = cells;
        axis.step = {1.0 / 3.0, 1.0 / 3.0};
        axis.renormalised = true;
        return axis;
    };
    KinematicAxis doppler;
    doppler.name = "Doppler";
    doppler.cells = 8;
    const double snr = ratioFromDb(10.0);
    const SequentialModel model =
        makeSequentialModel({spatial("azimuth", 3), spatial("elevation", 3), spatial("range", 40), doppler},
                            {false, false, false, true}, Likelihood(LikelihoodKind::Exponential, snr));
    const SprtSettings sprt{1e-2, 1e-2, 30};

    SequentialStudy study;
    study.model = model;
    study.sprt = sprt;
    study.trials = 1000;
    const Index fixedSize = simulatedFixedSampleSize(study, 40).value_or(40);
    std::printf("a test of fixed size with the same errors takes %td scans a sector\n", fixedSize);

    // Six sectors, three rounds; the target is in sector 2.
    ScanScene scene{.rangeCells = 40, .dopplerCells = 8, .stages = 30, .snrDb = 10.0, .seed = 11};
    const auto look = [&](const SectorVisit &visit) -> StageSource {
        ScanScene sector = scene;
        sector.hasTarget = visit.sector == 2;
        const int run = int(visit.round * 6 + visit.sector);
        return [sector, run, path = scanTrajectory(sector, run),
                y = std::vector<float>(3 * 3 * 40 * 8)](Index stage, std::span<double> out) mutable {
            readScan(sector, path, run, stage, y);
            std::copy(y.begin(), y.end(), out.begin());
        };
    };
    const Survey made = survey(model, sprt, {6, 3, scene.stages, fixedSize}, look);
    for (const SectorVisit &visit : made.visits) {
        std::printf("round %td, sector %td: %2td scans, %s", visit.round, visit.sector, visit.result.stages,
                    visit.result.decision == SprtDecision::H1 ? "a target" : "nothing");
        if (visit.result.decision == SprtDecision::H1)
            std::printf(" in range cell %td at last", visit.result.trajectory.back()[2]);
        std::printf("\n");
    }
    std::printf("%td scans in all, %.0f %% fewer than tests of fixed size\n", made.stages, 100.0 * made.saving());
    return made.saving() > 0.0 ? 0 : 1;
}
