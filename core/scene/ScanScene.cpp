#include "scene/ScanScene.h"

#include "base/Random.h"
#include "base/logmath.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    std::uint64_t streamOf(int run, Index number)
    {
        return (std::uint64_t(run) << 32) + std::uint64_t(number);
    }

    Index uniformCell(Random &random, Index cells)
    {
        return std::min(cells - 1, Index(random.uniform() * double(cells)));
    }

    /// Draws until a step stays on the axis, which renormalises the law over the existing cells.
    Index moved(Index from, Index cells, const ScanScene &scene, Random &random)
    {
        for (;;) {
            const double step = scene.moves == ScanMoves::Uniform ? double(uniformCell(random, 3) - 1)
                                                                  : std::floor(scene.moveCells * random.normal() + 0.5);
            const double to = double(from) + step;
            if (to >= 0.0 && to < double(cells))
                return Index(to);
        }
    }

} // namespace

const std::vector<Field<ScanScene>> &ScanScene::fields()
{
    using S = ScanScene;
    static const std::vector<Field<S>> table{
        field(&S::azimuthCells, "azimuthCells", "", 1.0, 65536.0, "Cells in azimuth.").advanced(),
        field(&S::elevationCells, "elevationCells", "", 1.0, 65536.0, "Cells in elevation.").advanced(),
        field(&S::rangeCells, "rangeCells", "", 1.0, 1048576.0, "Cells in range."),
        field(&S::dopplerCells, "dopplerCells", "", 1.0, 65536.0,
              "Cells in Doppler, which is ambiguous and drawn "
              "independently at every stage."),
        field(&S::stages, "stages", "", 1.0, 1000000.0, "Number of scans of the sector."),
        field(&S::hasTarget, "hasTarget", "Whether there is a target; otherwise the scans contain noise only."),
        field(&S::snrDb, "snrDb", "dB", -60.0, 120.0, "Mean power of the target over the noise in its cell.")
            .labelled("True SNR"),
        field(&S::moves, "moves", scanMovesNames, "Motion of the target from stage to stage.").advanced(),
        field(&S::moveCells, "moveCells", "", 0.0, 1000.0,
              "Standard deviation of a Gaussian step along each axis, in cells.")
            .labelled("Step deviation")
            .advanced(),
        field(&S::secondsPerStage, "secondsPerStage", "s", 1e-9, 1e9, "Time between two scans."),
        field(&S::seed, "seed", "", 0.0, 2147483647.0,
              "Seed of the random numbers; the same seed gives the same scans.")
            .advanced(),
    };
    return table;
}

void checkScene(const ScanScene &scene)
{
    checkFields(scene, ScanScene::fields());
    const double cells =
        double(scene.azimuthCells) * scene.elevationCells * double(scene.rangeCells) * scene.dopplerCells;
    if (cells > 0x1p28)
        throw fieldError("rangeCells", std::to_string(scene.rangeCells),
                         "gives a scan of " + formatNumber(cells) + " cells; at most 2²⁸ are possible");
    if (cells * scene.stages > 0x1p31)
        throw fieldError("stages", std::to_string(scene.stages), "gives more than 2³¹ values in all");
}

ScanScene scanSceneFromJson(const Json &json)
{
    ScanScene scene;
    readFields(json, ScanScene::fields(), scene, {}, {"kind"});
    if (const auto kind = json.find("kind"); kind != json.end() && *kind != "scans")
        throw Error("kind", "must be \"scans\" for a radar's scans");
    checkScene(scene);
    return scene;
}

Json toJson(const ScanScene &scene)
{
    Json json;
    json["kind"] = "scans";
    json.update(writeFields(scene, ScanScene::fields()));
    return json;
}

Grid scanGrid(const ScanScene &scene)
{
    const auto axis = [](const char *name, int cells) { return Axis{name, "", 0.0, 1.0, cells, false}; };
    return {{axis("azimuth", scene.azimuthCells), axis("elevation", scene.elevationCells),
             axis("range", scene.rangeCells), axis("Doppler", scene.dopplerCells)}};
}

std::vector<ScanCell> scanTrajectory(const ScanScene &scene, int run)
{
    std::vector<ScanCell> trajectory;
    if (!scene.hasTarget)
        return trajectory;
    Random random(std::uint64_t(scene.seed), streamOf(run, 0));
    const ScanCell cells{scene.azimuthCells, scene.elevationCells, scene.rangeCells, scene.dopplerCells};
    for (Index stage = 0; stage < scene.stages; ++stage) {
        ScanCell at{};
        for (std::size_t axis = 0; axis < at.size(); ++axis)
            at[axis] = stage == 0 || axis == 3 ? uniformCell(random, cells[axis])
                                               : moved(trajectory.back()[axis], cells[axis], scene, random);
        trajectory.push_back(at);
    }
    return trajectory;
}

void readScan(const ScanScene &scene, const std::vector<ScanCell> &trajectory, int run, Index stage, std::span<float> y)
{
    Random(std::uint64_t(scene.seed), streamOf(run, stage + 1)).exponentials(y);
    if (stage >= std::ssize(trajectory))
        return;
    const ScanCell &at = trajectory[std::size_t(stage)];
    const Index cell = ((at[0] * scene.elevationCells + at[1]) * scene.rangeCells + at[2]) * scene.dopplerCells + at[3];
    y[std::size_t(cell)] *= float(1.0 + ratioFromDb(scene.snrDb));
}

Json scanTruth(const ScanScene &scene, const std::vector<ScanCell> &trajectory)
{
    Json json;
    json["snrDb"] = scene.snrDb;
    json["axes"] = Json::array();
    for (const Axis &axis : scanGrid(scene).axes)
        json["axes"].push_back(axis.name);
    json["cells"] = trajectory;
    return json;
}

} // namespace faintline
