#pragma once

#include "detect/Sprt.h"

#include <functional>
#include <vector>

namespace faintline {

/// One look of a radar into one angular sector: a separate sequential test.
struct SectorVisit {
    Index round = 0;
    Index sector = 0;
    Index firstStage = 0; ///< stages the radar spent before this visit
    SprtResult result;
};

/// Rounds of looks and their cost.
struct Survey {
    std::vector<SectorVisit> visits; ///< in chronological order
    Index stages = 0;                ///< total number
    Index fixedStages = 0;           ///< that a test of fixed size would have spent

    /// Fraction of the fixed-size test's stages that was saved; negative if more were needed.
    double saving() const { return fixedStages > 0 ? 1.0 - double(stages) / double(fixedStages) : 0.0; }
};

/// The stages of one look; they may depend on when it begins.
using SectorSource = std::function<StageSource(const SectorVisit &visit)>;

/// Number of visits and maximum length of a look.
struct SurveyPlan {
    Index sectors = 1;
    Index rounds = 1;
    Index stagesAtMost = 1; ///< per look
    Index fixedSize = 1;    ///< stages per look of the fixed-size test for comparison
};

/// Visits sector after sector, round after round. Each look lasts until its test decides or `plan.stagesAtMost` stages
/// are taken (no decision). Empty sectors, the majority, are left early, which is where a sequential test saves stages
/// compared with one of `plan.fixedSize` stages per look. Source: Grossi and Lops 2006, section 4. Throws Error,
/// Cancelled.
Survey survey(const SequentialModel &model, const SprtSettings &settings, const SurveyPlan &plan,
              const SectorSource &source, const RunContext &context = {});

} // namespace faintline
