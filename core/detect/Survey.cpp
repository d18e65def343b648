#include "detect/Survey.h"

namespace faintline {

Survey survey(const SequentialModel &model, const SprtSettings &settings, const SurveyPlan &plan,
              const SectorSource &source, const RunContext &context)
{
    Survey made;
    const Index looks = plan.sectors * plan.rounds;
    for (Index look = 0; look < looks; ++look) {
        SectorVisit visit{look / plan.sectors, look % plan.sectors, made.stages, {}};
        const auto count = double(looks);
        visit.result = runSprt(model, settings, plan.stagesAtMost, source(visit),
                               context.part(double(look) / count, double(look + 1) / count));
        made.stages += visit.result.stages;
        made.fixedStages += plan.fixedSize;
        made.visits.push_back(std::move(visit));
    }
    return made;
}

} // namespace faintline
