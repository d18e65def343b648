#pragma once

#include "app/features/evaluate/Experiments.h"

namespace faintline {

class StartColumn;

/// Shows an experiment's progress in the column, and says which one it is if it is not what the form would start.
/// `ofForm`: nothing if the form is incomplete.
void showEntry(StartColumn &column, const Experiments::Entry &entry, const std::optional<Experiment> &ofForm);

} // namespace faintline
