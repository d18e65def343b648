#pragma once

#include "app/document/Document.h"

#include <QList>
#include <QObject>

#include <vector>

class QAction;
class QMenu;

namespace faintline {

class EventTable;
class HandLine;
class WaterfallView;

/// Lines of events, drawn by hand where a person sees them: cut in two, moved, or as detected again. They are part of the
/// reviews, shown over the pictures, and change nothing that was measured.
class DrawnLines : public QObject
{
    Q_OBJECT

public:
    DrawnLines(Document &document, EventTable &table, std::vector<WaterfallView *> views, QObject *parent);

    /// For the selected event.
    QList<QAction *> actions() const { return {m_cut, m_draw, m_undraw}; }
    void addCutTo(QMenu &menu, double seconds);

private:
    /// A piece of an event's line, and the lines that show it, one in each view.
    struct Piece {
        int event;
        std::size_t number; ///< among the event's pieces
        std::vector<HandLine *> lines;
    };

    const Event *chosen(const std::vector<Event> &events) const;
    void cut(double seconds);
    void keep(const Piece &piece, const HandLine &line);
    void setDrawn(int event, std::vector<SignalPath> pieces, const QString &text);
    void show();
    void enable();
    HandLine *lineIn(std::size_t view);

    Document &m_document;
    EventTable &m_table;
    std::vector<WaterfallView *> m_views;
    QAction *m_cut;
    QAction *m_draw;
    QAction *m_undraw;
    std::vector<Piece> m_pieces; ///< those after the first `m_shown` are empty, kept for later
    std::size_t m_shown = 0;
};

} // namespace faintline
