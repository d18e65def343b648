// Dialogs shown before a computation.

#include "app/window/MainWindow.h"

#include "app/control/EventFiles.h"
#include "app/control/EventReviews.h"
#include "app/panels/InjectDialog.h"
#include "app/panels/LearnMotionDialog.h"
#include "app/panels/StraightenDialog.h"
#include "app/panels/chosenEvents.h"
#include "frames/Spectrogram.h"

namespace faintline {

void MainWindow::injectLine()
{
    const auto &analysis = m_document.analysis();
    const Spectrogram *spectrogram = analysis ? analysis->frames->spectrogram() : nullptr;
    if (!spectrogram)
        return;
    const RecordingInfo &info = m_document.recording()->info();
    const Viewport &viewport = m_document.viewport();
    const Viewport::Point at =
        viewport.cursor().value_or(Viewport::Point{viewport.full().time.middle(), viewport.full().frequency.middle()});
    InjectDialog dialog(info, at.seconds, at.hz, spectrogram->windowSeconds(), this);
    if (dialog.exec() == QDialog::Accepted)
        m_controller.inject(dialog.line());
}

void MainWindow::learnMotion()
{
    if (!m_document.analysis())
        return;
    auto *dialog = new LearnMotionDialog(m_document.analysis(), m_controller, this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
}

void MainWindow::straighten()
{
    const std::vector<Event> events = chosenEvents(m_document, *m_events);
    if (!m_document.lineAnalysis() || !m_document.recording() || events.empty())
        return showError(Error(tr("Straighten").toStdString(), "requires a recording with an event to follow"));
    auto *dialog = new StraightenDialog(m_document, events.front(), m_reviews->files().provenance(), this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &StraightenDialog::written, this, &MainWindow::showWritten);
    dialog->open();
}

} // namespace faintline
