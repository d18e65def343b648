#include "app/features/events/EventReviews.h"

#include "app/features/events/DrawnLines.h"
#include "app/features/events/EventFiles.h"
#include "base/oneLine.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"
#include "widgets/events/EventTable.h"
#include "widgets/pings/PingMap.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QAction>
#include <QInputDialog>
#include <QMenu>

#include <algorithm>

namespace faintline {

namespace {

    constexpr int longestClass = 40; ///< characters shown
    constexpr int keys = 9;          ///< that assign a class

    /// "accepted, 12.3 s … 45.6 s at 71.20 Hz: a note"
    QString lineOf(const Review &review, const QString &unit)
    {
        const SignalPath &path = review.paths.front();
        QString line =
            QStringLiteral("%1 … %2 at %3")
                .arg(secondsText(path.seconds.front(), 0.1), secondsText(path.seconds.back(), 0.1),
                     QStringLiteral("%1 %2").arg(numberText(path.position.front().front(), 2), unit).trimmed());
        const QString verdict = review.verdict == Verdict::Accepted   ? EventReviews::tr("accepted")
                                : review.verdict == Verdict::Rejected ? EventReviews::tr("rejected")
                                                                      : QString();
        if (!verdict.isEmpty())
            line = verdict + QStringLiteral(", ") + line;
        if (!review.label.empty())
            line = messageText(review.label) + QStringLiteral(", ") + line;
        return review.note.empty() ? line : QStringLiteral("%1: %2").arg(line, messageText(review.note));
    }

} // namespace

EventReviews::EventReviews(Document &document, EventTable &table, std::vector<WaterfallView *> views, QWidget *window)
    : QObject(window), m_document(document), m_table(table), m_views(std::move(views)), m_window(window),
      m_files(new EventFiles(document, window)), m_drawn(new DrawnLines(document, table, m_views, this))
{
    m_eventActions << add(tr("&Accept"), Qt::Key_Y, tr("This is a signal"), &EventReviews::accept)
                   << add(tr("Re&ject"), Qt::Key_X, tr("Not a signal; show it dimmed"), &EventReviews::reject)
                   << add(tr("&Undecided"), Qt::Key_U, tr("Clear the accept or reject mark"), &EventReviews::takeBack)
                   << add(tr("&Note…"), Qt::Key_E, tr("Edit the note on the event"), &EventReviews::editNote);
    addClasses();
    m_merge = add(tr("&Merge"), Qt::Key_G,
                  tr("Treat the selected events as one signal; select several with "
                     "Ctrl or Shift and click"),
                  &EventReviews::merge);
    m_eventActions << m_merge
                   << add(tr("&Separate"), QKeySequence(Qt::SHIFT | Qt::Key_G),
                          tr("Treat merged events as several "
                             "signals again"),
                          &EventReviews::separate);
    m_actions << nullptr << m_drawn->actions() << nullptr;
    m_addBox =
        add(tr("Add annotation of the &box…"), Qt::Key_B, tr("Label the measured box (M)"), &EventReviews::askForLabel);
    m_actions << nullptr << m_files->actions();

    for (QAction *action : m_eventActions + m_drawn->actions())
        m_table.table()->addAction(action);
    connect(&m_table, &EventTable::unmatchedActivated, this, &EventReviews::goToUnmatched);
    connect(&m_table, &EventTable::noteRequested, this, &EventReviews::editNote);
    connect(&m_table, &EventTable::selectionChanged, this, &EventReviews::enable);
    connect(&m_document.viewport(), &Viewport::selectionChanged, this, &EventReviews::enable);
    connect(&m_document, &Document::opened, this, &EventReviews::show);
    connect(&m_document, &Document::annotationsChanged, this, &EventReviews::show);
    connect(&m_document, &Document::shownEventsChanged, this, &EventReviews::show);
    for (WaterfallView *view : m_views)
        connect(view, &WaterfallView::contextMenuRequested, this, [this, view](QMenu *menu, double seconds, double hz) {
            if (const int event = view->eventAt(view->positionOf({seconds, hz})))
                fillContextMenu(*menu, event);
            fillContextMenu(*menu, seconds, hz);
        });
    enable();
}

void EventReviews::addMaps(std::vector<PingMap *> maps)
{
    m_maps = std::move(maps);
    for (PingMap *map : m_maps)
        connect(map->plane(), &WaterfallView::contextMenuRequested, this,
                [this, map](QMenu *menu, double range, double bearing) {
                    if (const int track = map->trackAt({range, bearing}))
                        fillContextMenu(*menu, track);
                });
}

QAction *EventReviews::add(const QString &text, const QKeySequence &key, const QString &tip,
                           void (EventReviews::*act)())
{
    auto *action = new QAction(text, this);
    action->setShortcut(key);
    action->setToolTip(tip);
    connect(action, &QAction::triggered, this, act);
    m_actions << action;
    return action;
}

void EventReviews::addClasses()
{
    auto *menu = new QMenu(tr("&Class"), m_window);
    for (int key = 1; key <= keys; ++key) {
        QAction *action = menu->addAction(QString(), this, [this, key] { classify(m_classNames[key - 1]); });
        action->setShortcut(Qt::Key_0 + key);
    }
    QAction *none = menu->addAction(tr("&No class"), this, [this] { classify({}); });
    none->setShortcut(QKeySequence(Qt::SHIFT | Qt::Key_U));
    for (QAction *action : menu->actions()) {
        m_window->addAction(action); // keys of a hidden menu have no effect
        m_classes << action;
    }
    m_table.table()->addAction(menu->menuAction());
    menu->addSeparator();
    menu->addAction(tr("&Edit class names…"), this, &EventReviews::editClassNames);
    m_actions << menu->menuAction();
    setClassNames({});
}

void EventReviews::setClassNames(const QStringList &names)
{
    m_classNames.clear();
    for (int i = 0; i < keys; ++i) {
        const QString name = QString::fromStdString(oneLine(names.value(i).trimmed().toStdString()));
        m_classNames << (name.isEmpty() ? tr("class %1").arg(i + 1) : name);
        m_classes[i]->setText(buttonText(m_classNames.back(), longestClass));
    }
    emit classNamesChanged(m_classNames);
}

std::vector<int> EventReviews::chosen() const
{
    return m_document.analysis() ? m_table.selectedEvents() : std::vector<int>();
}

void EventReviews::setReviews(std::vector<Review> reviews, const QString &text)
{
    Annotations after = m_document.annotations();
    after.reviews = std::move(reviews);
    m_document.annotate(std::move(after), text);
}

void EventReviews::judge(Verdict verdict)
{
    const std::vector<int> ids = chosen();
    if (ids.empty())
        return;
    const QString text = verdict == Verdict::Accepted   ? tr("Accept")
                         : verdict == Verdict::Rejected ? tr("Reject")
                                                        : tr("Unmark");
    setReviews(
        withVerdict(m_document.annotations().reviews, *m_document.analysis(), m_document.shownEvents(), ids, verdict),
        ids.size() == 1 ? tr("%1 event %2").arg(text).arg(ids.front()) : tr("%1 %2 events").arg(text).arg(ids.size()));
}

void EventReviews::merge()
{
    if (const std::vector<int> ids = chosen(); ids.size() > 1)
        setReviews(merged(m_document.annotations().reviews, *m_document.analysis(), m_document.shownEvents(), ids),
                   tr("Merge %1 events").arg(ids.size()));
}

void EventReviews::separate()
{
    if (const std::vector<int> ids = chosen(); !ids.empty())
        setReviews(separated(m_document.annotations().reviews, *m_document.analysis(), m_document.shownEvents(), ids),
                   tr("Separate events"));
}

void EventReviews::setNote(int id, const QString &note)
{
    const std::vector<Event> events = m_document.shownEvents();
    if (std::any_of(events.begin(), events.end(), [id](const Event &event) { return event.id == id; }))
        setReviews(withNote(m_document.annotations().reviews, *m_document.analysis(), m_document.shownEvents(), id,
                            oneLine(note.toStdString())),
                   tr("Note on event %1").arg(id));
}

void EventReviews::editNote()
{
    const int id = m_table.selectedEvent();
    if (id == 0 || !m_document.analysis())
        return;
    QString before;
    for (const EventReview &one :
         eventReviews(*m_document.analysis(), m_document.shownEvents(), m_document.annotations().reviews))
        if (one.event == id)
            before = QString::fromStdString(oneLine(one.note));
    bool isGiven = false;
    const QString note = QInputDialog::getText(m_window, tr("Note on event %1").arg(id), tr("Note:"), QLineEdit::Normal,
                                               before, &isGiven);
    if (isGiven && m_document.analysis())
        setNote(id, note);
}

void EventReviews::classify(const QString &name)
{
    const std::vector<int> ids = chosen();
    if (ids.empty())
        return;
    const QString events = ids.size() == 1 ? tr("event %1").arg(ids.front()) : tr("%1 events").arg(ids.size());
    setReviews(withLabel(m_document.annotations().reviews, *m_document.analysis(), m_document.shownEvents(), ids,
                         name.toStdString()),
               name.isEmpty() ? tr("Clear the class of %1").arg(events)
                              : tr("Classify %1 as %2").arg(events, buttonText(name, longestClass)));
}

void EventReviews::editClassNames()
{
    bool isGiven = false;
    const QString names = QInputDialog::getMultiLineText(m_window, tr("Edit class names"),
                                                         tr("Class names for the keys 1 to 9, one per line:"),
                                                         m_classNames.join(QLatin1Char('\n')), &isGiven);
    if (isGiven)
        setClassNames(names.split(QLatin1Char('\n')));
}

void EventReviews::annotateSelection(const QString &label)
{
    const auto box = m_document.box();
    if (!box)
        return;
    Annotations after = m_document.annotations();
    after.boxes.push_back({box->time.low,
                           box->time.high,
                           box->frequency.low,
                           box->frequency.high,
                           oneLine(label.toStdString()),
                           {},
                           Verdict::None});
    m_document.annotate(std::move(after), tr("Add annotation"));
    m_document.viewport().clearSelection();
}

void EventReviews::askForLabel()
{
    bool isGiven = false;
    const QString label =
        QInputDialog::getText(m_window, tr("Add annotation"), tr("Label of the box:"), QLineEdit::Normal, {}, &isGiven);
    if (isGiven)
        annotateSelection(label);
}

void EventReviews::fillContextMenu(QMenu &menu, double seconds, double hz)
{
    if (!m_document.isOnePicture())
        return;
    menu.addSeparator();
    menu.addAction(m_addBox);
    m_drawn->addCutTo(menu, seconds);
    const std::vector<Annotation> &boxes = m_document.annotations().boxes;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const Annotation &box = boxes[i];
        const bool isIn = seconds >= box.startSeconds && seconds <= box.endSeconds
                          && (!box.lowHz || (hz >= *box.lowHz && hz <= *box.highHz));
        if (!isIn)
            continue;
        const QString name =
            box.label.empty() ? tr("annotation") : tr("“%1”").arg(buttonText(QString::fromStdString(box.label), 40));
        menu.addAction(tr("Remove %1").arg(name), this, [this, i, name] {
            Annotations after = m_document.annotations();
            after.boxes.erase(after.boxes.begin() + std::ptrdiff_t(i));
            m_document.annotate(std::move(after), tr("Remove %1").arg(name));
        });
    }
}

/// What is said next is said about that event.
void EventReviews::fillContextMenu(QMenu &menu, int event)
{
    const std::vector<int> selected = m_table.selectedEvents();
    if (std::ranges::find(selected, event) == selected.end())
        m_table.setSelectedEvent(event);
    if (m_table.selectedEvent() == 0) // the list's filter hides it
        return;
    menu.addSection(tr("Event %1").arg(event));
    menu.addActions(m_eventActions);
}

void EventReviews::show()
{
    std::vector<EventReview> said;
    if (m_document.analysis())
        said = eventReviews(*m_document.analysis(), m_document.shownEvents(), m_document.annotations().reviews);
    m_table.setReviews(said);
    showUnmatched();
    std::vector<int> rejected;
    for (const EventReview &one : said)
        if (one.verdict == Verdict::Rejected)
            rejected.push_back(one.event);
    for (WaterfallView *view : m_views) {
        view->setFaintEvents(rejected);
        view->setAnnotations(m_document.shownBoxes());
    }
    for (PingMap *map : m_maps)
        map->setFaintTracks(rejected);
    enable();
}

void EventReviews::showUnmatched()
{
    const std::vector<Review> &reviews = m_document.annotations().reviews;
    m_unmatched.clear();
    if (m_document.analysis())
        m_unmatched = unmatchedReviews(*m_document.analysis(), m_document.shownEvents(), reviews);
    std::erase_if(m_unmatched, [&](std::size_t index) { return reviews[index].paths.empty(); }); // without a position
    const QString unit =
        m_unmatched.empty() ? QString() : labelText(m_document.analysis()->grid().axes.front().unit, mostUnitLetters);
    QStringList lines;
    for (const std::size_t index : m_unmatched)
        lines << lineOf(reviews[index], unit);
    m_table.setUnmatched(lines);
}

void EventReviews::goToUnmatched(int line)
{
    const SignalPath &path = m_document.annotations().reviews[m_unmatched[std::size_t(line)]].paths.front();
    Viewport::Box box{{path.seconds.front(), path.seconds.back()},
                      {path.position.front().front(), path.position.front().front()}};
    for (const std::vector<double> &position : path.position) {
        box.frequency.low = std::min(box.frequency.low, position.front() - path.tolerance.front());
        box.frequency.high = std::max(box.frequency.high, position.front() + path.tolerance.front());
    }
    m_document.viewport().reveal(box);
    m_document.viewport().setCursor({path.seconds.front(), path.position.front().front()});
}

void EventReviews::enable()
{
    const std::vector<int> ids = chosen();
    for (QAction *action : m_eventActions + m_classes)
        action->setEnabled(!ids.empty());
    m_merge->setEnabled(ids.size() > 1);
    m_addBox->setEnabled(m_document.box().has_value() && !m_document.isEmpty());
    for (QAction *action : m_files->actions())
        action->setEnabled(m_document.analysis() != nullptr);
}

} // namespace faintline
