#pragma once

#include "app/document/Document.h"
#include "app/document/Provenance.h"

#include <QObject>

#include <vector>

class QAction;
class QMenu;
class QWidget;

namespace faintline {

class EventTable;
class PingMap;
class WaterfallView;

/// What a person says about events, and boxes of their own: the actions, and where it is shown.
///
/// Events are judged where they are selected, in the table, and tracks of pings by a right click on them. Nothing is
/// ever deleted by judging: a rejected event stays in the table and is drawn faint. Each action is one undoable step of
/// the document.
class EventReviews : public QObject
{
    Q_OBJECT

public:
    /// `views`: the waterfalls that show events and boxes. Dialogs belong to `window`.
    EventReviews(Document &document, EventTable &table, std::vector<WaterfallView *> views, QWidget *window);

    /// Where tracks of pings are seen.
    void addMaps(std::vector<PingMap *> maps);

    /// The actions for a menu: those on events first. The table's context menu has the same.
    void addActionsTo(QMenu &menu);

    void judge(Verdict verdict);
    void merge();
    void separate();
    void setNote(int id, const QString &note);
    /// Gives the selected events a class; an empty name clears it.
    void classify(const QString &name);
    /// The classes that the keys 1 to 9 give; a key without a name of its own gives "class 3".
    QStringList classNames() const { return m_classNames; }
    void setClassNames(const QStringList &names);
    /// The measured box becomes an annotation.
    void annotateSelection(const QString &label);

    /// Throws Error.
    void importFrom(const QString &path);
    void exportTo(const QString &path);
    /// The tracks of the events shown, frame by frame: .csv or .json.
    void exportTracksTo(const QString &path);

    Provenance &provenance() { return m_provenance; }

signals:
    void classNamesChanged(const QStringList &names);
    void failed(const faintline::Error &error);
    void written(const QString &path);
    void told(const QString &where, const QString &what);

private:
    QAction *add(const QString &text, const QKeySequence &key, const QString &tip, void (EventReviews::*act)());
    void accept() { judge(Verdict::Accepted); }
    void reject() { judge(Verdict::Rejected); }
    void takeBack() { judge(Verdict::None); }
    void editNote();
    void addClasses();
    void editClassNames();
    void askForLabel();
    void askForImport();
    void askForExport();
    void askForTracks();
    void writeProvenance(const QString &path, bool isOfTracks);
    void fillContextMenu(QMenu &menu, double seconds, double hz);
    void fillContextMenu(QMenu &menu, int track);
    void show();
    void showUnmatched();
    void goToUnmatched(int line);
    void enable();
    std::vector<int> chosen() const;
    void setReviews(std::vector<Review> reviews, const QString &text);

    Document &m_document;
    EventTable &m_table;
    std::vector<WaterfallView *> m_views;
    std::vector<PingMap *> m_maps;
    QWidget *m_window;
    QList<QAction *> m_actions;      ///< null: a separator
    QList<QAction *> m_eventActions; ///< need a selected event
    QAction *m_merge = nullptr;
    QList<QAction *> m_classes; ///< of the keys 1 to 9, and the one that clears them
    QStringList m_classNames;
    QAction *m_addBox = nullptr;
    std::vector<std::size_t> m_unmatched; ///< reviews, in the order they are listed
    Provenance m_provenance;
};

} // namespace faintline
