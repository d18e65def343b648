#include "app/document/hint.h"

#include "app/document/Document.h"
#include "app/document/thresholdWords.h"

#include <QCoreApplication>

namespace faintline {

QString hint(const Document &document, bool isBusy, const QString &usual)
{
    const auto tr = [](const char *text) { return QCoreApplication::translate("hint", text); };
    if (document.isEmpty())
        return tr("Click a picture, or drop a recording anywhere on the window.");
    if (document.isLive())
        return tr("Scroll back at any time; End returns to the newest frames. The threshold and all settings may be "
                  "changed.");
    if (!document.analysis() && !isBusy)
        return tr("Stopped before a result was available. Press Run to start again; From and To select a part of the "
                  "recording.");
    if (!document.analysis())
        return tr("Reading the recording: a first look. What was found follows when the detector has run.");
    if (document.provisional())
        return tr("Provisional: new statistic of the visible part, with the old threshold and events. Calibrating …");
    if (document.isPreview())
        return tr("Preview: the events that were found so far and exceed this threshold. The detector runs again with "
                  "the new setting.");
    if (document.analysis()->calibration->isFirstEstimate)
        return firstEstimateSentence(*document.analysis(), isBusy);
    if (document.shownEvents().empty())
        return tr("Nothing exceeds the threshold. To lower it, drag its line to the left or press , (comma).");
    return usual;
}

} // namespace faintline
