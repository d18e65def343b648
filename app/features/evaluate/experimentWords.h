#pragma once

#include "evaluate/experiments/Campaign.h"

#include <QString>

namespace faintline {

/// Its lines in a few words: "8 runs, -4 … 2 dB, 40 T_FT, seed 1".
QString experimentWords(const Experiment &experiment);

} // namespace faintline
