#pragma once

#include "plan/Analysis.h"
#include "refine/explanation.h"

#include <vector>

namespace faintline {

/// Tracks of signals that stronger ones hide: a further run of the chain over the floor that explained signals raise.
///
/// The chain is that of the analysis, with the same threshold, on y/floor. Cells within the main lobe of an explained
/// signal are not known to hold nothing else: there λ = -(ln K + ln h(0)) - 0.05, so that a path that goes on behind a
/// stronger signal loses as much as in noise, and none gains. Only tracks that the first run could not find are
/// returned: at half of their points or more the floor is raised within a resolution cell. Because they are a second
/// chance for noise, they also have to be a hundred times rarer than ordered (sureStatistic.h). Throws Cancelled.
std::vector<Track> searchBehind(const Analysis &analysis, const Explanations &explanations, const RunContext &context);

} // namespace faintline
