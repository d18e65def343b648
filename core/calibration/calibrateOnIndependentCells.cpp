#include "base/Field.h"
#include "base/Random.h"
#include "calibration/calibrate.h"
#include "calibration/calibrateOn.h"
#include "calibration/keptCalibration.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    /// Everything on which a model's response to noise depends, as text.
    std::string nameOf(const MarkovModel &model)
    {
        std::string name = "cells ";
        const auto add = [&](const std::vector<double> &values) {
            for (const double value : values)
                name += formatNumber(value) + ",";
            name += ";";
        };
        for (const KinematicAxis &axis : model.space.axes()) {
            add({double(axis.cells), axis.cyclic ? 1.0 : 0.0, double(axis.firstRate), double(axis.rateCount),
                 double(axis.ratesPerCell), double(axis.rounding), axis.renormalised ? 1.0 : 0.0});
            add(axis.rateChange);
            add(axis.step);
            add(axis.transition);
        }
        add({double(model.likelihood.kind()), model.likelihood.snr(), model.transitionScale});
        return name;
    }

} // namespace

MarkovModel calibrationSubgrid(const MarkovModel &model)
{
    constexpr Index many = 20000;
    constexpr Index handy = 5000;
    if (model.space.cellCount() <= many)
        return model;
    std::vector<KinematicAxis> axes = model.space.axes();
    KinematicAxis *longest = nullptr;
    for (KinematicAxis &axis : axes)
        if (!axis.cyclic && (!longest || axis.cells > longest->cells))
            longest = &axis;
    if (!longest)
        return model;
    const Index others = model.space.cellCount() / longest->cells;
    longest->cells = std::clamp<Index>(handy / others, 4 * longest->largestDisplacement() + 1, longest->cells);
    longest->cyclic = true;
    return {StateSpace(std::move(axes)), model.likelihood, model.transitionScale};
}

std::shared_ptr<const Calibration> calibrateOnIndependentCells(const MarkovModel &whole,
                                                               const AnalysisSettings &settings,
                                                               const RunContext &context, double cellFrames)
{
    const MarkovModel model = calibrationSubgrid(whole);
    Grid grid;
    for (const KinematicAxis &axis : model.space.axes())
        grid.axes.push_back({axis.name, "", 0.0, 1.0, axis.cells, axis.cyclic});
    // A sonar's hundred rates per cell add cost but little information, because their paths overlap.
    constexpr double mostStates = 1.2e8; ///< per segment
    const double longest = std::min(4e6 / double(grid.size()), mostStates / double(model.space.stateCount()));
    const auto frames = Index(std::clamp(longest, 600.0, 4000.0));
    const auto segment = [&](int number) -> NormalisedFramesPointer {
        Random random(1000, std::uint64_t(number));
        std::vector<float> values(std::size_t(frames * grid.size()));
        for (float &value : values)
            value = float(random.exponential());
        return std::make_shared<FrameArray>(Axis{"time", "s", 0.0, 1.0, frames, false}, grid, std::move(values));
    };
    const double wanted = std::min(cellFrames, 2.0 * mostStates / double(model.space.planeCount()));
    const int segments = std::max(4, int(std::ceil(wanted / double(frames * grid.size()))));
    AnalysisSettings bare = settings;
    bare.selection = {};
    bare.spectrogram = {};
    bare.noise = {};
    bare.pings = {};
    bare.conventional = {};
    bare.decide = withoutThreshold(bare.decide);
    bare.track.bothWays = TrackSettings{}.bothWays;
    return keptCalibration(
        nameOf(model) + settingsToJson(bare) + formatNumber(cellFrames),
        [&] {
            return calibrateOn({segment, segments}, model, settings, {cellFrames}, context);
        },
        context);
}

} // namespace faintline
