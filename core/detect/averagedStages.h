#pragma once

#include "detect/Sprt.h"

namespace faintline {

/// The same stages for unknown noise power: each cell is divided by the mean of its N nearest neighbours along the
/// model's last axis with a state (range), then converted to the cell of equal evidence under known noise
/// (averageCells, correctAveraged).
///
/// The frames may be in any unit of power. The model's likelihood must be exponential. Throws Error naming `where` if
/// it is not, or if N is not within 1 … cells of that axis - 1. Source: constant false-alarm rate statistics, Grossi
/// and Lops 2006, section 5. Oracle: the trials of SequentialStudy, which average independently.
StageSource averagedStages(StageSource source, const SequentialModel &model, Index N, const std::string &where);

} // namespace faintline
