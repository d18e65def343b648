#include "base/Random.h"
#include "calibrate/CalibrationRequest.h"
#include "calibrate/calibrate.h"
#include "calibrate/calibrateOn.h"
#include "calibrate/constants.h"

#include <algorithm>
#include <cmath>

namespace faintline {

MarkovModel calibrationSubgrid(const MarkovModel &model)
{
    if (model.space.cellCount() <= cutFromCells)
        return model;
    std::vector<KinematicAxis> axes = model.space.axes();
    KinematicAxis *longest = nullptr;
    for (KinematicAxis &axis : axes)
        if (!axis.cyclic && (!longest || axis.cells > longest->cells))
            longest = &axis;
    if (!longest)
        return model;
    const Index others = model.space.cellCount() / longest->cells;
    longest->cells = std::clamp<Index>(simulatedCells / others, 4 * longest->largestDisplacement() + 1, longest->cells);
    longest->cyclic = true;
    return {StateSpace(std::move(axes)), model.likelihood, model.transitionScale};
}

std::shared_ptr<const Calibration> makeIndependentCalibration(const CalibrationRequest &request,
                                                              const CalibrationEffort &effort,
                                                              const RunContext &context)
{
    const MarkovModel &model = *request.model;
    Grid grid;
    for (const KinematicAxis &axis : model.space.axes())
        grid.axes.push_back({axis.name, "", 0.0, 1.0, axis.cells, axis.cyclic});
    const double longest = std::min(4e6 / double(grid.size()), segmentStates / double(model.space.stateCount()));
    const auto frames = Index(std::clamp(longest, 600.0, 4000.0));
    const auto segment = [&](int number) -> NormalisedFramesPointer {
        Random random(1000, std::uint64_t(number));
        std::vector<float> values(std::size_t(frames * grid.size()));
        for (float &value : values)
            value = float(random.exponential());
        return std::make_shared<FrameArray>(Axis{"time", "s", 0.0, 1.0, frames, false}, grid, std::move(values));
    };
    const double wanted = std::min(request.cellFrames, 2.0 * segmentStates / double(model.space.planeCount()))
                          * effort.ofIndependentCells;
    const int segments = std::max(4, int(std::ceil(wanted / double(frames * grid.size()))));
    return calibrateOn({segment, segments}, model, request.settings, effort, context);
}

std::shared_ptr<const Calibration> calibrateOnIndependentCells(const MarkovModel &whole,
                                                               const AnalysisSettings &settings,
                                                               const RunContext &context, double cellFrames)
{
    CalibrationRequest request{ofIndependentCells(settings)};
    request.model = calibrationSubgrid(whole);
    request.cellFrames = cellFrames;
    return requestedCalibration(request, context);
}

} // namespace faintline
