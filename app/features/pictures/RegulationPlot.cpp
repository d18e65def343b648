#include "app/features/pictures/RegulationPlot.h"

#include <algorithm>

namespace faintline {

RegulationPlot::RegulationPlot(QWidget *parent) : StripPlot(tr("ln K (nat)"), parent)
{
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding); // Qwt's default never shrinks below the hint
    setRightTitle(tr("resets"));
    setFixedScale(Side::Right, {-0.05, 1.05}); // a curve on the frame would not be seen
}

void RegulationPlot::setAnalysis(const Analysis &analysis)
{
    std::vector<float> resetFraction(analysis.continuedFraction.size());
    std::transform(analysis.continuedFraction.begin(), analysis.continuedFraction.end(), resetFraction.begin(),
                   [](float continued) { return 1.0f - continued; });
    setSeries(tr("ln K"), analysis.time(), analysis.lnK);
    setSeries(tr("reset fraction"), analysis.time(), std::move(resetFraction), Side::Right);
}

void RegulationPlot::clear(const QString &emptySentence)
{
    removeSeries(tr("ln K"));
    removeSeries(tr("reset fraction"));
    setEmptySentence(emptySentence);
}

} // namespace faintline
