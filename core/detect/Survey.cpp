#include "detect/Survey.h"

namespace faintline {

Survey survey(const SequentialModel &model, const SprtSettings &settings, Index sectors, Index rounds,
              Index stagesAtMost, Index fixedSize, const SectorSource &source, const RunContext &context)
{
    Survey made;
    const Index looks = sectors * rounds;
    for (Index look = 0; look < looks; ++look) {
        SectorVisit visit{look / sectors, look % sectors, made.stages, {}};
        const auto count = double(looks);
        visit.result = runSprt(model, settings, stagesAtMost, source(visit),
                               context.part(double(look) / count, double(look + 1) / count));
        made.stages += visit.result.stages;
        made.fixedStages += fixedSize;
        made.visits.push_back(std::move(visit));
    }
    return made;
}

} // namespace faintline
