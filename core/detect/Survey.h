#pragma once

#include "detect/Sprt.h"

#include <functional>
#include <vector>

namespace faintline {

/// One look of a radar into one angular sector: a sequential test of its own.
struct SectorVisit {
    Index round = 0;
    Index sector = 0;
    Index firstStage = 0; ///< stages the radar spent before it came here
    SprtResult result;
};

/// Rounds of looks, and what they cost.
struct Survey {
    std::vector<SectorVisit> visits; ///< in the order they were made
    Index stages = 0;                ///< all of them together
    Index fixedStages = 0;           ///< a test of fixed size would have spent

    /// Share of the fixed-size test's stages that was not needed; negative if more were.
    double saving() const { return fixedStages > 0 ? 1.0 - double(stages) / double(fixedStages) : 0.0; }
};

/// The stages of one look; may depend on when it begins.
using SectorSource = std::function<StageSource(const SectorVisit &visit)>;

/// How often each sector is visited, and how long a look may take.
struct SurveyPlan {
    Index sectors = 1;
    Index rounds = 1;
    Index stagesAtMost = 1; ///< of one look
    Index fixedSize = 1;    ///< stages a look of the test that it is compared with
};

/// Visits sector after sector, round after round: each is looked at until its test decides or `plan.stagesAtMost` are
/// taken (no decision), then the beam moves on. Empty sectors, the many, are left early; that is what a sequential test
/// saves against one of `plan.fixedSize` stages a look. Source: Grossi and Lops 2006, section 4. Throws Error,
/// Cancelled.
Survey survey(const SequentialModel &model, const SprtSettings &settings, const SurveyPlan &plan,
              const SectorSource &source, const RunContext &context = {});

} // namespace faintline
