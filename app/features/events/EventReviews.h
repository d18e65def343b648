#pragma once

#include "app/document/Document.h"

#include <QObject>

#include <vector>

class QAction;
class QMenu;
class QWidget;

namespace faintline {

class DrawnLines;
class EventFiles;
class EventTable;
class PingMap;
class WaterfallView;

/// A person's reviews of events, and own boxes: the actions and their display.
///
/// Events are reviewed where they are selected: in the table, or tracks of pings by a right-click on them. Reviewing
/// never deletes: a rejected event stays in the table and is drawn dimmed. Each action is one undoable step of the
/// document.
class EventReviews : public QObject
{
    Q_OBJECT

public:
    /// `views`: the waterfalls that show events and boxes. `window`: parent of dialogs.
    EventReviews(Document &document, EventTable &table, std::vector<WaterfallView *> views, QWidget *window);

    /// Adds maps on which tracks of pings are shown.
    void addMaps(std::vector<PingMap *> maps);

    /// Of a menu: those on events first; null: a separator. The table's context menu has the same ones.
    const QList<QAction *> &actions() const { return m_actions; }

    void judge(Verdict verdict);
    void merge();
    void separate();
    void setNote(int id, const QString &note);
    /// Gives the selected events a class; an empty name clears it.
    void classify(const QString &name);
    /// The classes for the keys 1 to 9; a key without a name gives "class 3".
    QStringList classNames() const { return m_classNames; }
    void setClassNames(const QStringList &names);
    /// Turns the measured box into an annotation.
    void annotateSelection(const QString &label);

    /// Import and export, whose actions are among those of the menu.
    EventFiles &files() { return *m_files; }

signals:
    void classNamesChanged(const QStringList &names);

private:
    QAction *add(const QString &text, const QKeySequence &key, const QString &tip, void (EventReviews::*act)());
    void accept() { judge(Verdict::Accepted); }
    void reject() { judge(Verdict::Rejected); }
    void takeBack() { judge(Verdict::None); }
    void editNote();
    void addClasses();
    void editClassNames();
    void askForLabel();
    void fillContextMenu(QMenu &menu, double seconds, double hz);
    void fillContextMenu(QMenu &menu, int event);
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
    EventFiles *m_files;
    DrawnLines *m_drawn;
    QList<QAction *> m_actions;
    QList<QAction *> m_eventActions; ///< enabled with a selected event
    QAction *m_merge = nullptr;
    QList<QAction *> m_classes; ///< for the keys 1 to 9, and the one that clears the class
    QStringList m_classNames;
    QAction *m_addBox = nullptr;
    std::vector<std::size_t> m_unmatched; ///< reviews in the order listed
};

} // namespace faintline
