#pragma once

#include "analyse/events.h"
#include "frames/PeakPyramid.h"
#include "plan/Analysis.h"
#include "widgets/base/Viewport.h"

#include <functional>
#include <memory>
#include <vector>

namespace faintline::test {

inline Axis timeAxis(Index frames, double step = 1.0)
{
    return {"time", "s", 0.5 * step, step, frames, false};
}

inline Axis hzAxis(Index cells, double first = 100.0, double step = 2.0)
{
    return {"frequency", "Hz", first, step, cells, false};
}

/// A picture of value(frame, cell): power ratios (PowerDb) or nats.
inline std::shared_ptr<const PeakPyramid> picture(Index frames, Index cells,
                                                  const std::function<float(Index, Index)> &value,
                                                  ByteScale::Kind kind = ByteScale::Kind::ScoreNats)
{
    auto result = std::make_shared<PeakPyramid>(timeAxis(frames), cells, ByteScale(kind));
    std::vector<float> row(static_cast<std::size_t>(cells));
    for (Index frame = 0; frame < frames; ++frame) {
        for (Index cell = 0; cell < cells; ++cell)
            row[std::size_t(cell)] = value(frame, cell);
        result->append(row);
    }
    result->finish();
    return result;
}

/// Nats that differ from cell to cell: cell + 10·frame, as far as the byte scale is even.
inline std::shared_ptr<const PeakPyramid> countingPicture(Index frames, Index cells)
{
    return picture(frames, cells, [](Index frame, Index cell) { return float(cell + 10 * frame); });
}

inline Event event(int id, double onset, double end, double hz, double statistic = 20.0)
{
    Event result;
    result.id = id;
    result.onsetSeconds = onset;
    result.detectSeconds = 0.5 * (onset + end);
    result.endSeconds = end;
    result.position = {hz};
    result.statistic = statistic;
    result.isConfirmed = true;
    return result;
}

} // namespace faintline::test
