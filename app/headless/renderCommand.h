#pragma once

#include "app/headless/RenderOptions.h"

namespace faintline {

/// Opens the source (a lesson at a given step) in a hidden window, waits until it has settled and writes the pictures,
/// byte-identical from run to run. Needs a QApplication. Throws Error.
void render(const RenderOptions &options);

/// The same for a report as one HTML page, byte-identical from run to run.
void report(const RenderOptions &options);

} // namespace faintline
