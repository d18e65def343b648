#include "app/features/events/EventFiles.h"

#include "app/base/filePath.h"
#include "app/base/writeAndReport.h"
#include "app/document/thresholdWords.h"
#include "exchange/annotateRecording.h"
#include "exchange/readAnnotations.h"
#include "exchange/writeEvents.h"
#include "exchange/writeReviewed.h"
#include "inspect/judgeByBoxes.h"
#include "widgets/base/labelText.h"

#include <QAction>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>

namespace faintline {

EventFiles::EventFiles(Document &document, QWidget *window)
    : QObject(window), m_document(document), m_window(window), m_provenance(document)
{
    add(tr("&Import annotations…"), {}, tr("Raven selection tables, Audacity labels, SigMF, CSV, JSON"),
        &EventFiles::askForImport);
    add(tr("E&xport events and annotations…"), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_E),
        tr("CSV, JSON, Raven, Audacity, SigMF"), &EventFiles::askForExport);
    add(tr("Export &tracks…"), {}, tr("Frequency, band, presence and SNR of each track frame by frame: CSV, JSON"),
        &EventFiles::askForTracks);
    connect(&m_provenance, &Provenance::failed, this, &EventFiles::failed);
}

void EventFiles::add(const QString &text, const QKeySequence &key, const QString &tip, void (EventFiles::*act)())
{
    auto *action = new QAction(text, this);
    action->setShortcut(key);
    action->setToolTip(tip);
    connect(action, &QAction::triggered, this, act);
    m_actions << action;
}

void EventFiles::importFrom(const QString &path)
{
    const RecordingInfo info = m_document.recording() ? m_document.recording()->info() : RecordingInfo();
    std::vector<std::string> notes;
    const std::vector<Annotation> boxes = readAnnotations(pathBytes(path), info, &notes);
    Annotations after = m_document.annotations();
    JudgedByBoxes imported{{}, boxes, 0};
    if (m_document.analysis()) {
        imported = judgeByBoxes(after.reviews, *m_document.analysis(), m_document.shownEvents(), boxes);
        after.reviews = imported.reviews;
    }
    after.boxes.insert(after.boxes.end(), imported.others.begin(), imported.others.end());
    m_document.annotate(std::move(after), tr("Import %1 annotations").arg(boxes.size()));
    const QString judged = imported.judged == 0 ? QString() : tr(" They review %1 event(s).").arg(imported.judged);
    QString words = tr("%1 annotation(s) imported; Ctrl+Z undoes the import.").arg(boxes.size()) + judged;
    for (const std::string &note : notes)
        words += QLatin1Char(' ') + labelText(note) + QLatin1Char('.');
    emit told(fileLabel(path), words);
}

bool EventFiles::isFinal()
{
    const auto &analysis = m_document.analysis();
    if (analysis && analysis->calibration->isFirstEstimate)
        emit failed(firstEstimateError());
    return analysis && !analysis->calibration->isFirstEstimate;
}

void EventFiles::exportTo(const QString &path)
{
    if (!isFinal())
        return;
    writeReviewed(*m_document.analysis(), m_document.shownEvents(), m_document.annotations(), pathBytes(path));
    writeProvenance(path, false);
}

void EventFiles::annotateRecording()
{
    if (!isFinal())
        return;
    const int count = faintline::annotateRecording(
        m_document.source().path,
        reviewedSigmf(*m_document.analysis(), m_document.shownEvents(), m_document.annotations()));
    emit told(fileLabel(m_document.sourcePath()), tr("%1 annotation(s) added; all else in it was kept.").arg(count));
}

/// Whether the events are to be added to the recording's own annotations, because its metadata were chosen.
bool EventFiles::wantsToAnnotate(const QString &path)
{
    if (!isMetadataOf(pathBytes(path), m_document.source().path))
        return false;
    const QString question = tr("%1 holds the metadata of the recording and is not replaced. Add the events to its "
                                "annotations? Everything else in it is kept.")
                                 .arg(fileLabel(path));
    return QMessageBox::question(m_window, tr("Annotate the recording"), asHtml(question),
                                 QMessageBox::Yes | QMessageBox::Cancel, QMessageBox::Yes)
           == QMessageBox::Yes;
}

void EventFiles::exportTracksTo(const QString &path)
{
    if (!isFinal())
        return;
    writeTracksOf(m_document.shownEvents(), *m_document.analysis(), pathBytes(path));
    writeProvenance(path, true);
}

void EventFiles::writeProvenance(const QString &path, bool isOfTracks)
{
    // Only a threshold that is being dragged differs from the settings'.
    const bool isDragged = m_document.shownThreshold() != m_document.analysis()->threshold;
    m_provenance.with(
        [this, path, isOfTracks, isDragged, threshold = m_document.shownThreshold()](const std::string &provenance) {
            writeAndReport(*this, path, [&] {
                Json json = parseJson(provenance, "provenance");
                if (isDragged)
                    json["shownThreshold"] = threshold;
                if (isOfTracks)
                    json["tracks"] = true;
                writeProvenanceBeside(path, json.dump(2) + "\n");
            });
        });
}

void EventFiles::askForImport()
{
    const QString path =
        QFileDialog::getOpenFileName(m_window, tr("Import annotations"), QFileInfo(m_document.sourcePath()).path(),
                                     tr("Annotations (*.txt *.sigmf-meta *.csv *.json);;All files (*)"));
    if (!path.isEmpty())
        actOrReport(*this, [&] { importFrom(path); });
}

void EventFiles::askForExport()
{
    const QString path = QFileDialog::getSaveFileName(
        m_window, tr("Export events and annotations"),
        nameBeside(m_document.sourcePath(), QStringLiteral("-events.csv")),
        tr("Table (*.csv);;JSON (*.json);;Raven selection table (*.selections.txt);;Audacity labels (*.txt);;SigMF "
           "annotations (*.sigmf-meta)"));
    if (!path.isEmpty())
        actOrReport(*this, [&] { wantsToAnnotate(path) ? annotateRecording() : exportTo(path); });
}

void EventFiles::askForTracks()
{
    const QString path = QFileDialog::getSaveFileName(
        m_window, tr("Export tracks"), nameBeside(m_document.sourcePath(), QStringLiteral("-tracks.csv")),
        tr("Table (*.csv);;JSON (*.json)"));
    if (!path.isEmpty())
        actOrReport(*this, [&] { exportTracksTo(path); });
}

} // namespace faintline
