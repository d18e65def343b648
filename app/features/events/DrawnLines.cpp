#include "app/features/events/DrawnLines.h"

#include "widgets/events/EventTable.h"
#include "widgets/waterfall/HandLine.h"

#include <QAction>
#include <QMenu>

#include <algorithm>

namespace faintline {

DrawnLines::DrawnLines(Document &document, EventTable &table, std::vector<WaterfallView *> views, QObject *parent)
    : QObject(parent), m_document(document), m_table(table), m_views(std::move(views)),
      m_cut(new QAction(tr("C&ut at the cursor"), this)), m_draw(new QAction(tr("&Draw by hand"), this)),
      m_undraw(new QAction(tr("As &detected"), this))
{
    m_cut->setShortcut(QKeySequence(Qt::SHIFT | Qt::Key_X));
    m_cut->setToolTip(tr("Cut the selected event's line in two"));
    m_draw->setShortcut(QKeySequence(Qt::SHIFT | Qt::Key_M));
    m_draw->setCheckable(true);
    m_draw->setToolTip(
        tr("Drag the points of the selected event's line to where it is; click it to add one, right-click "
           "one to remove it"));
    m_undraw->setToolTip(tr("Discard what was cut or drawn of the selected event's line"));
    connect(m_cut, &QAction::triggered, this, [this] {
        if (const auto &cursor = m_document.viewport().cursor())
            cut(cursor->seconds);
    });
    connect(m_draw, &QAction::toggled, this, &DrawnLines::show);
    connect(m_undraw, &QAction::triggered, this, [this] {
        const std::vector<Event> events = m_document.shownEvents();
        if (const Event *event = chosen(events))
            setDrawn(event->id, {}, tr("Event %1 as detected").arg(event->id));
    });
    connect(&m_table, &EventTable::selectionChanged, this, &DrawnLines::show);
    for (const auto changed : {&Document::opened, &Document::annotationsChanged, &Document::shownEventsChanged})
        connect(&document, changed, this, &DrawnLines::show);
    connect(&document.viewport(), &Viewport::cursorChanged, this, &DrawnLines::enable);
    enable();
}

/// The selected event if there is one, of frames that form one picture.
const Event *DrawnLines::chosen(const std::vector<Event> &events) const
{
    const std::vector<int> ids = m_document.lineAnalysis() ? m_table.selectedEvents() : std::vector<int>();
    if (ids.size() != 1)
        return nullptr;
    const auto found = std::ranges::find(events, ids.front(), &Event::id);
    return found == events.end() ? nullptr : &*found;
}

void DrawnLines::setDrawn(int event, std::vector<SignalPath> pieces, const QString &text)
{
    Annotations after = m_document.annotations();
    after.reviews =
        withDrawn(std::move(after.reviews), *m_document.analysis(), m_document.shownEvents(), event, std::move(pieces));
    m_document.annotate(std::move(after), text);
}

void DrawnLines::cut(double seconds)
{
    const std::vector<Event> events = m_document.shownEvents();
    const Event *event = chosen(events);
    if (!event)
        return;
    const std::vector<SignalPath> pieces = piecesOf(m_document.annotations().reviews, *m_document.analysis(), *event);
    if (std::vector<SignalPath> after = cutAt(pieces, seconds); after.size() > pieces.size())
        setDrawn(event->id, std::move(after), tr("Cut event %1").arg(event->id));
}

void DrawnLines::addCutTo(QMenu &menu, double seconds)
{
    const std::vector<Event> events = m_document.shownEvents();
    const Event *event = chosen(events);
    if (event && event->onsetSeconds < seconds && seconds < event->endSeconds)
        menu.addAction(tr("Cut event %1 here").arg(event->id), this, [this, seconds] { cut(seconds); });
}

void DrawnLines::keep(const Piece &piece, const HandLine &line)
{
    const std::vector<Event> events = m_document.shownEvents();
    const auto event = std::ranges::find(events, piece.event, &Event::id);
    if (event == events.end() || !m_document.lineAnalysis())
        return;
    std::vector<SignalPath> pieces = piecesOf(m_document.annotations().reviews, *m_document.analysis(), *event);
    SignalPath &changed = pieces.at(piece.number);
    changed.seconds.clear();
    changed.position.clear();
    for (const Viewport::Point &point : line.points()) {
        changed.seconds.push_back(point.seconds);
        changed.position.push_back({point.hz});
    }
    std::erase_if(pieces, [](const SignalPath &each) { return each.seconds.empty(); });
    setDrawn(piece.event, std::move(pieces), tr("Draw event %1").arg(piece.event));
}

/// A line in a view for a piece that is not shown yet. The view keeps it.
HandLine *DrawnLines::lineIn(std::size_t view)
{
    auto *line = new HandLine(*m_views[view]);
    connect(line, &HandLine::edited, this, [this, line] {
        for (std::size_t i = 0; i < m_shown; ++i)
            if (std::ranges::find(m_pieces[i].lines, line) != m_pieces[i].lines.end())
                return keep(m_pieces[i], *line);
    });
    return line;
}

void DrawnLines::show()
{
    struct Shown {
        int event;
        std::size_t number;
        std::vector<Viewport::Point> points;
        bool isActive;
    };
    std::vector<Shown> shown;
    if (const auto analysis = m_document.lineAnalysis()) {
        const std::vector<Event> events = m_document.shownEvents();
        const Event *edited = m_draw->isChecked() ? chosen(events) : nullptr;
        const std::vector<Review> &reviews = m_document.annotations().reviews;
        for (const EventReview &said : eventReviews(*analysis, events, reviews)) {
            const bool isEdited = edited && edited->id == said.event;
            const std::vector<SignalPath> pieces = isEdited ? piecesOf(reviews, *analysis, *edited) : said.drawn;
            for (std::size_t i = 0; i < pieces.size(); ++i) {
                Shown &one = shown.emplace_back(Shown{said.event, i, {}, isEdited});
                for (std::size_t k = 0; k < pieces[i].seconds.size(); ++k)
                    one.points.push_back({pieces[i].seconds[k], pieces[i].position[k].front()});
            }
        }
    }
    while (m_pieces.size() < shown.size()) {
        Piece &piece = m_pieces.emplace_back();
        for (std::size_t view = 0; view < m_views.size(); ++view)
            piece.lines.push_back(lineIn(view));
    }
    m_shown = shown.size();
    for (std::size_t i = 0; i < m_pieces.size(); ++i)
        for (HandLine *line : m_pieces[i].lines) {
            line->setActive(false);
            line->setPoints(i < shown.size() ? shown[i].points : std::vector<Viewport::Point>());
        }
    for (std::size_t i = 0; i < shown.size(); ++i) {
        m_pieces[i].event = shown[i].event;
        m_pieces[i].number = shown[i].number;
        for (HandLine *line : m_pieces[i].lines)
            line->setActive(shown[i].isActive, false);
    }
    enable();
}

void DrawnLines::enable()
{
    const std::vector<Event> events = m_document.shownEvents();
    const Event *event = chosen(events);
    const auto &cursor = m_document.viewport().cursor();
    m_cut->setEnabled(event && cursor && event->onsetSeconds < cursor->seconds && cursor->seconds < event->endSeconds);
    m_draw->setEnabled(event || m_draw->isChecked());
    m_undraw->setEnabled(event
                         && std::ranges::any_of(m_pieces.begin(), m_pieces.begin() + std::ptrdiff_t(m_shown),
                                                [&](const Piece &piece) { return piece.event == event->id; }));
}

} // namespace faintline
