#include "app/views/lineDialogs.h"

#include "app/base/tr.h"
#include "app/control/EventFiles.h"
#include "app/control/EventReviews.h"
#include "app/panels/InjectDialog.h"
#include "app/panels/LearnMotionDialog.h"
#include "app/panels/StraightenDialog.h"
#include "app/panels/chosenEvents.h"
#include "app/views/WindowParts.h"
#include "frames/Spectrogram.h"

namespace faintline {

void injectLine(WindowParts &parts, QWidget &window)
{
    const auto &analysis = parts.document().analysis();
    const Spectrogram *spectrogram = analysis ? analysis->frames->spectrogram() : nullptr;
    if (!spectrogram)
        return;
    const RecordingInfo &info = parts.document().recording()->info();
    const Viewport &viewport = parts.document().viewport();
    const Viewport::Point at =
        viewport.cursor().value_or(Viewport::Point{viewport.full().time.middle(), viewport.full().frequency.middle()});
    InjectDialog dialog(info, at.seconds, at.hz, spectrogram->windowSeconds(), &window);
    if (dialog.exec() == QDialog::Accepted)
        parts.controller().inject(dialog.line());
}

void learnMotion(WindowParts &parts, QWidget &window)
{
    if (!parts.document().analysis())
        return;
    auto *dialog = new LearnMotionDialog(parts.document().analysis(), parts.controller(), &window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
}

void straighten(WindowParts &parts, QWidget &window)
{
    const std::vector<Event> events = chosenEvents(parts.document(), parts.eventTable());
    if (!parts.document().lineAnalysis() || !parts.document().recording() || events.empty())
        return parts.showError(Error(tr("Straighten").toStdString(), "requires a recording with an event to follow"));
    auto *dialog =
        new StraightenDialog(parts.document(), events.front(), parts.reviews().files().provenance(), &window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    QObject::connect(dialog, &StraightenDialog::written, dialog,
                     [&parts](const QString &path) { parts.showWritten(path); });
    dialog->open();
}

} // namespace faintline
