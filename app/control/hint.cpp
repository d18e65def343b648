#include "app/control/hint.h"

#include "app/document/Document.h"
#include "app/control/thresholdWords.h"

#include <QCoreApplication>

namespace faintline {

QString hint(const Document &document, bool isBusy)
{
    const auto tr = [](const char *text) { return QCoreApplication::translate("hint", text); };
    if (document.isEmpty())
        return tr("Click a picture, or drop a recording anywhere on the window.");
    if (!document.analysis() && !isBusy)
        return tr("Stopped before there was a result. Run begins again; From and To choose a part of the recording.");
    if (!document.analysis())
        return tr("Reading the recording and listening to its noise.");
    if (document.provisional())
        return tr("Provisional: the new statistic of what is visible, beside the old threshold and events. Calibrating …");
    if (document.analysis()->calibration->isFirstEstimate)
        return firstEstimateSentence(*document.analysis(), isBusy);
    if (document.hasPings() && !document.shownEvents().empty())
        return tr("J and L step from ping to ping, Space plays, P looks from above; N goes to the next track.");
    if (document.shownEvents().empty())
        return tr(
            "Nothing exceeds the threshold: drag its line to the left, or press , (comma), and see what appears.");
    return tr("Drag the threshold line: contour and events follow. N goes to the next event, ? shows all keys.");
}

} // namespace faintline
