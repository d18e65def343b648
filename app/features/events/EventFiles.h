#pragma once

#include "app/document/Document.h"
#include "app/document/Provenance.h"

#include <QList>
#include <QObject>

class QAction;
class QWidget;

namespace faintline {

/// Events in files: import of annotations, export of events with their reviews and of their tracks.
///
/// Imported boxes review the events that they match, and those that match none are added to the document's boxes
/// (judgeByBoxes.h); an import is one undoable step. An export is accompanied by its provenance in
/// PATH.provenance.json. Events above a threshold of a first estimate are not exported, because the settings would not
/// reproduce them.
class EventFiles : public QObject
{
    Q_OBJECT

public:
    /// `window`: parent of dialogs.
    EventFiles(Document &document, QWidget *window);

    /// Import, export of events and export of tracks, each of which asks for a file; for a menu, which enables them
    /// once there is an analysis.
    const QList<QAction *> &actions() const { return m_actions; }

    /// Throws Error.
    void importFrom(const QString &path);
    void exportTo(const QString &path);
    /// Adds the events with their reviews and the boxes to the annotations in a SigMF recording's own metadata.
    void annotateRecording();
    /// Exports the tracks of the events shown, frame by frame: .csv or .json.
    void exportTracksTo(const QString &path);

    Provenance &provenance() { return m_provenance; }

signals:
    void failed(const faintline::Error &error);
    void written(const QString &path);
    void told(const QString &where, const QString &what);

private:
    /// Whether there is an analysis and its threshold is final, with which alone it can be made again; says if not.
    bool isFinal();
    void add(const QString &text, const QKeySequence &key, const QString &tip, void (EventFiles::*act)());
    void askForImport();
    void askForExport();
    void askForTracks();
    bool wantsToAnnotate(const QString &path);
    void writeProvenance(const QString &path, bool isOfTracks);

    Document &m_document;
    QWidget *m_window;
    QList<QAction *> m_actions;
    Provenance m_provenance;
};

} // namespace faintline
