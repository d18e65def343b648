#pragma once

#include "analyse/AnalysisRequest.h"
#include "analyse/Source.h"
#include "analyse/events.h"
#include "base/RunContext.h"
#include "plan/Analysis.h"

#include <memory>

namespace faintline {

/// The only way from a recording or frames to their tracks, for window, command line, surveys and library alike:
///
///   frames → background → normalised frames → calibrated detector → threshold, clusters, tracks → their refinement
///
/// A recording determines its window if the settings leave it open (chooseWindow.h); slopes may be given in Hz/s. Ready-
/// made frames are analysed with the settings' own model or bank of models, or with the request's; recorded pings and
/// power are normalised as the settings ask. Streams: memory is bounded for any length. Throws Error, Cancelled.
std::shared_ptr<const Analysis> analyse(const OpenedSource &source, const AnalysisSettings &settings,
                                        const AnalysisRequest &request = {}, const RunContext &context = {});

} // namespace faintline
