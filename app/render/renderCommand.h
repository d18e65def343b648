#pragma once

#include "app/render/RenderOptions.h"

namespace faintline {

/// Opens the source (a lesson: at a step) in a window nobody sees, waits until it has settled, and writes the pictures:
/// the same bytes from run to run. Needs a QApplication. Throws Error.
void render(const RenderOptions &options);

/// The same for a report as one HTML page: the same bytes from run to run.
void report(const RenderOptions &options);

} // namespace faintline
