#include "app/document/thresholdWords.h"

#include "app/base/tr.h"
#include "app/document/statisticUnit.h"

#include <QCoreApplication>

namespace faintline {

QString firstEstimateSentence(const Analysis &analysis, bool isBusy)
{
    return (isBusy ? tr("Threshold %1 %2 (first estimate, false alarms within a factor %3; being refined).")
                   : tr("Threshold %1 %2 (first estimate, false alarms within a factor %3; Run refines it)."))
        .arg(analysis.threshold, 0, 'f', 2)
        .arg(statisticUnit(analysis.settings))
        .arg(analysis.calibration->rateUncertaintyAt(analysis.threshold), 0, 'f', 1);
}

Error firstEstimateError()
{
    return Error("threshold", "is a first estimate; export needs the refined threshold. Press Run if the refinement "
                              "was stopped");
}

QString refinedSentence(const Analysis &analysis, double firstEstimate)
{
    return tr("Threshold refined from %3 to %1 %2. The events were updated.")
        .arg(analysis.threshold, 0, 'f', 2)
        .arg(statisticUnit(analysis.settings))
        .arg(firstEstimate, 0, 'f', 2);
}

} // namespace faintline
