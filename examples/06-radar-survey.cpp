// A radar observes one sector after the other, each until its test decides. Most sectors are empty and take few scans.
#include "evaluate/sequential/ScanTest.h"
#include "evaluate/sequential/simulate.h"

#include <cstdio>

using namespace faintline;

int main()
{
    // Possible target: 10 dB, in 3 × 3 × 40 cells, moving by at most one cell per scan, with unknown Doppler.
    const ScanScene scene{.rangeCells = 40, .dopplerCells = 8, .stages = 30, .snrDb = 10.0, .seed = 11};
    SequentialStudy study;
    study.model = scanModel(scene, scene.snrDb);
    study.sprt = {1e-2, 1e-2, scene.stages};
    const Index fixedSize = simulatedFixedSampleSize(study, 40).value_or(40);
    std::printf("a test of fixed size with the same errors takes %td scans a sector\n", fixedSize);

    // Six sectors, three rounds; the target is in sector 2.
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
    const SectorRounds made = visitSectors(study.model, study.sprt, {6, 3, scene.stages, fixedSize}, look);
    for (const auto &[round, sector, firstStage, result] : made.visits) {
        std::printf("round %td, sector %td: %2td scans, ", round, sector, result.stages);
        if (result.decision == SprtDecision::H1)
            std::printf("a target in range cell %td at last\n", result.trajectory.back()[2]);
        else
            std::printf("nothing\n");
    }
    std::printf("%td scans in all, %.0f %% fewer than tests of fixed size\n", made.stages, 100.0 * made.saving());
    return made.saving() > 0.0 ? 0 : 1;
}
