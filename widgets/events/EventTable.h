#pragma once

#include "inspect/Review.h"

#include "widgets/table/ColumnTable.h"

#include <QString>
#include <QWidget>

#include <optional>
#include <utility>
#include <vector>

class QLabel;
class QLineEdit;
class QListWidget;

namespace faintline {

class EventCard;
class EventModel;
class EventProxy;
struct EventScales;

/// The events of an analysis: sorted by any column, filtered by a line of text, stepped through with N and Shift+N.
///
/// The filter is an EventFilter: words ("open", "tentative") and comparisons ("f>1000", "stat>=25"), all of which must
/// hold.
class EventTable : public QWidget
{
    Q_OBJECT

public:
    explicit EventTable(QWidget *parent = nullptr);

    /// Keeps the selection if the event with that id still exists.
    void setEvents(const std::vector<Event> &events);
    void setReviews(const std::vector<EventReview> &reviews); ///< of these events
    void setScales(const EventScales &scales);
    void setSnrUnit(const QString &unit);
    /// Reviews of signals that match no event, one per line; an empty list hides them.
    void setUnmatched(const QStringList &lines);
    void setEmptySentence(const QString &sentence);
    /// Whether the events may change once the detector has run; said beside their number.
    void setPreview(bool isPreview);

    int selectedEvent() const;               ///< 0: none
    std::vector<int> selectedEvents() const; ///< all selected with Shift or Ctrl
    ColumnTable *table() const { return m_table; }
    QLineEdit *filter() const { return m_filter; }
    EventCard &card() { return *m_card; } ///< of the selected event, below the table if there is room

    QSize sizeHint() const override { return {420, 220}; }

public slots:
    /// Selects a row without going there; for events selected elsewhere. None, if there is no such event in the list.
    void setSelectedEvent(int id);
    void selectNext();
    void selectPrevious();

signals:
    /// Emitted on click, Enter, N or Shift+N: views should go to the event.
    void eventActivated(int id);
    void selectionChanged();           ///< by whomever, also because an event is gone: views mark `selectedEvent`
    void unmatchedActivated(int line); ///< index of the line in `setUnmatched`
    void noteRequested();              ///< emitted on a double-click in the notes column, for the selected event

protected:
    void keyPressEvent(QKeyEvent *event) override;
    bool eventFilter(QObject *watched, QEvent *event) override;
    void resizeEvent(QResizeEvent *event) override;

private:
    void setUpTable();
    void setUpUnmatched();
    void step(int by);
    void choose(const QModelIndex &row);
    void activate(int proxyRow);
    void applyFilter(const QString &text);
    void updateCount();
    void updateCard();
    void followSelection();
    void orderColumns();
    void narrowColumns();
    void widenColumns();
    int widthOf(int row, int column) const;

    EventModel *m_model;
    EventProxy *m_proxy;
    QLineEdit *m_filter;
    ColumnTable *m_table;
    EventCard *m_card;
    QLabel *m_count;
    QLabel *m_empty;
    QLabel *m_unmatchedTitle;
    QListWidget *m_unmatched;
    bool m_isPreview = false;
    bool m_isChoosing = false;
    std::pair<int, std::vector<int>> m_announced{}; ///< the selected event, and all selected ones
};

} // namespace faintline
