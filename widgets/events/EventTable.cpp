#include "widgets/events/EventTable.h"

#include "widgets/base/labelText.h"
#include "widgets/events/EventCard.h"
#include "widgets/events/EventModel.h"
#include "widgets/events/EventProxy.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QStackedLayout>
#include <QStyle>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <utility>

namespace faintline {

EventTable::EventTable(QWidget *parent)
    : QWidget(parent), m_model(new EventModel(this)), m_proxy(new EventProxy(this)), m_filter(new QLineEdit),
      m_table(new ColumnTable(tr("Events"), m_model, m_proxy)), m_card(new EventCard(*m_model)), m_count(new QLabel),
      m_empty(new QLabel(tr("Events appear here after a recording has been analysed."))), m_unmatchedTitle(new QLabel),
      m_unmatched(new QListWidget)
{
    m_filter->setPlaceholderText(tr("Filter: f>1000 stat>25 !rejected"));
    m_filter->setToolTip(tr("Conditions that must all hold: open, confirmed, tentative, accepted, rejected, "
                            "unreviewed, merged, noted, line, "
                            "keyed, spread, negated by a leading !; id, call, t, detect, confirm, end, dur, f, drift, "
                            "stat, snr compared by <, >, =, <=, >=; "
                            "class=NAME, without spaces"));
    m_filter->setClearButtonEnabled(true);
    m_filter->setAccessibleName(tr("Filter events"));
    connect(m_filter, &QLineEdit::textChanged, this, &EventTable::applyFilter);

    setUpTable();
    m_empty->setAlignment(Qt::AlignCenter);
    m_empty->setWordWrap(true);
    m_empty->setForegroundRole(QPalette::PlaceholderText);
    m_empty->setMargin(16);
    auto *stack = new QStackedLayout;
    m_count->setForegroundRole(QPalette::PlaceholderText);

    auto *top = new QHBoxLayout;
    top->addWidget(m_filter, 1);
    top->addWidget(m_count);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(4, 4, 4, 4);
    layout->setSpacing(4);
    layout->addLayout(top);
    layout->addLayout(stack, 1);
    for (QWidget *page : {static_cast<QWidget *>(m_empty), static_cast<QWidget *>(m_table)})
        stack->addWidget(page); // only now, because the first one is shown, alone if it has no parent
    layout->addWidget(m_card);
    layout->addWidget(m_unmatchedTitle);
    layout->addWidget(m_unmatched);
    setUpUnmatched();
    updateCount();
    connect(m_table->selectionModel(), &QItemSelectionModel::selectionChanged, this, &EventTable::followSelection);
    connect(m_table->selectionModel(), &QItemSelectionModel::currentChanged, this, &EventTable::followSelection);
    connect(m_model, &QAbstractItemModel::dataChanged, this, &EventTable::updateCard);
    connect(m_model, &QAbstractItemModel::headerDataChanged, this, &EventTable::updateCard);
    updateCard();
}

void EventTable::setUpUnmatched()
{
    constexpr int mostHeight = 76; // pixels: three lines
    m_unmatchedTitle->setForegroundRole(QPalette::PlaceholderText);
    m_unmatchedTitle->setBuddy(m_unmatched);
    m_unmatched->setMaximumHeight(mostHeight);
    m_unmatched->setAccessibleName(tr("Reviews without an event"));
    m_unmatched->setToolTip(tr("Reviews of signals that are not detected with these settings. They are kept and apply "
                               "again when the signals are detected; click one to go to its place"));
    connect(m_unmatched, &QListWidget::itemClicked, this,
            [this](QListWidgetItem *item) { emit unmatchedActivated(m_unmatched->row(item)); });
    connect(m_unmatched, &QListWidget::itemActivated, this,
            [this](QListWidgetItem *item) { emit unmatchedActivated(m_unmatched->row(item)); });
    setUnmatched({});
}

void EventTable::setUnmatched(const QStringList &lines)
{
    m_unmatched->clear();
    m_unmatched->addItems(lines);
    m_unmatchedTitle->setText(lines.size() == 1 ? tr("1 review matches no event:")
                                                : tr("%1 reviews match no event:").arg(lines.size()));
    m_unmatchedTitle->setVisible(!lines.isEmpty());
    m_unmatched->setVisible(!lines.isEmpty());
}

void EventTable::setUpTable()
{
    m_table->setFrameStyle(QFrame::StyledPanel | QFrame::Sunken);
    m_table->setAlternatingRowColors(true);
    m_table->setTabKeyNavigation(false);
    m_table->setSortingEnabled(true);
    m_table->sortByColumn(EventModel::Onset, Qt::AscendingOrder);
    connect(m_table->horizontalHeader(), &QHeaderView::sectionClicked, this, [this] {
        m_model->takeOrder();
        m_proxy->invalidate();
    });
    m_table->horizontalHeader()->setResizeContentsPrecision(20); // rows; numbers of all of them: widenColumns
    m_table->horizontalHeader()->setStretchLastSection(true);
    m_table->horizontalHeader()->setMinimumSectionSize(26);
    orderColumns();
    m_table->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    m_table->installEventFilter(this);
    for (const int column :
         {EventModel::Bearing, EventModel::ThirdAxis, EventModel::FourthAxis, EventModel::Chance, EventModel::Window,
          EventModel::Kind, EventModel::Call, EventModel::Utc, EventModel::Radio, EventModel::Class})
        m_table->setColumnHidden(column, true);
    connect(m_table, &QTableView::clicked, this, [this](const QModelIndex &index) {
        if (selectedEvents().size() == 1) // otherwise several are being selected
            activate(index.row());
    });
    connect(m_table, &QTableView::doubleClicked, this, [this](const QModelIndex &index) {
        if (index.column() == EventModel::Note)
            emit noteRequested();
    });
}

void EventTable::setEvents(const std::vector<Event> &events)
{
    const int selected = selectedEvent();
    const bool isFirst = m_model->events().empty();
    m_model->setEvents(events);
    m_table->setColumnHidden(EventModel::Chance, !m_model->hasChances());
    m_table->setColumnHidden(EventModel::Window, !m_model->hasWindows());
    m_table->setColumnHidden(EventModel::Kind, !m_model->hasKinds());
    m_table->setColumnHidden(EventModel::Call, !m_model->hasCalls());
    if (isFirst && !events.empty()) {
        m_table->resizeColumnsToContents();
        narrowColumns();
    }
    widenColumns();
    setSelectedEvent(selected);
    updateCount();
}

/// Announces a selection once, whatever took it: new contents and filters do so without a signal of the table's.
void EventTable::followSelection()
{
    if (m_isChoosing) // the current row is told apart from the selection
        return;
    updateCard();
    std::pair now(selectedEvent(), selectedEvents());
    if (std::exchange(m_announced, now) != now)
        emit selectionChanged();
}

/// Lines are told apart by frequency and SNR, targets by when they were confirmed.
void EventTable::orderColumns()
{
    QHeaderView &header = *m_table->horizontalHeader();
    std::vector<int> order;
    if (!m_model->hasBearing())
        order = {EventModel::Id,  EventModel::Frequency, EventModel::Snr,    EventModel::Onset, EventModel::Drift,
                 EventModel::End, EventModel::Chance,    EventModel::Window, EventModel::Kind,  EventModel::Call};
    for (int column = 0; column < EventModel::ColumnCount; ++column)
        if (std::ranges::find(order, column) == order.end())
            order.push_back(column);
    for (int place = 0; place < int(order.size()); ++place)
        header.moveSection(header.visualIndex(order[std::size_t(place)]), place);
}

/// Number columns are as wide as their headings, without the style's margins.
void EventTable::narrowColumns()
{
    for (int column = EventModel::Id; column <= EventModel::Drift; ++column)
        if (!m_table->isColumnHidden(column))
            m_table->setColumnWidth(column, m_table->headingWidth(column));
}

/// Width of a cell's whole text, or of the widest one with as many digits.
int EventTable::widthOf(int row, int column) const
{
    const int room = 2 * (style()->pixelMetric(QStyle::PM_FocusFrameHMargin, nullptr, m_table) + 1) + 2;
    QString text = m_model->index(row, column).data().toString();
    for (QChar &letter : text)
        if (letter.isDigit())
            letter = QLatin1Char('0');
    return m_table->fontMetrics().horizontalAdvance(text) + room;
}

/// Numbers are never truncated: columns fit their smallest and largest values.
void EventTable::widenColumns()
{
    const int rows = m_model->rowCount();
    for (int column = EventModel::Id; column <= EventModel::Drift; ++column) {
        if (m_table->isColumnHidden(column))
            continue;
        const auto value = [&](int row) { return m_model->index(row, column).data(EventModel::SortRole).toDouble(); };
        int least = -1;
        int most = -1;
        for (int row = 0; row < rows; ++row) {
            if (!std::isfinite(value(row)))
                continue;
            least = least < 0 || value(row) < value(least) ? row : least;
            most = most < 0 || value(row) > value(most) ? row : most;
        }
        for (const int row : {least, most})
            if (row >= 0)
                m_table->setColumnWidth(column, std::max(m_table->columnWidth(column), widthOf(row, column)));
    }
}

void EventTable::setReviews(const std::vector<EventReview> &reviews)
{
    const int selected = selectedEvent();
    m_model->setReviews(reviews);
    m_table->setColumnHidden(EventModel::Class, !m_model->hasClasses());
    m_proxy->setFilter(m_proxy->filter()); // the filter may depend on reviews
    int width = m_table->columnWidth(EventModel::Id);
    for (const EventReview &review : reviews) // "✓ 12" is wider than "12"
        if (const int row = m_model->rowOf(review.event); row >= 0 && review.verdict != Verdict::None)
            width = std::max(width, widthOf(row, EventModel::Id));
    m_table->setColumnWidth(EventModel::Id, width);
    if (selected != 0 && selectedEvent() != selected)
        setSelectedEvent(selected);
    followSelection();
    updateCount();
}

std::vector<int> EventTable::selectedEvents() const
{
    std::vector<int> ids;
    for (const int row : m_table->selectedSourceRows())
        ids.push_back(m_model->events()[std::size_t(row)].id);
    std::sort(ids.begin(), ids.end());
    return ids;
}

void EventTable::setScales(const EventScales &scales)
{
    m_model->setScales(scales);
    for (const auto column : {EventModel::Bearing, EventModel::ThirdAxis, EventModel::FourthAxis})
        m_table->setColumnHidden(column, !m_model->hasColumn(column));
    m_table->setColumnHidden(EventModel::Utc, !m_model->hasUtc());
    m_table->setColumnHidden(EventModel::Radio, !m_model->hasRadio());
    orderColumns();
}

void EventTable::setSnrUnit(const QString &unit)
{
    m_model->setSnrUnit(unit);
}

void EventTable::setEmptySentence(const QString &sentence)
{
    m_empty->setText(sentence);
}

int EventTable::selectedEvent() const
{
    const QModelIndex index = m_table->currentIndex();
    if (!index.isValid() || !m_table->selectionModel()->isRowSelected(index.row()))
        return 0;
    return m_model->events()[std::size_t(m_table->sourceRow(index))].id;
}

void EventTable::setSelectedEvent(int id)
{
    const int row = m_model->rowOf(id);
    const QModelIndex index = row < 0 ? QModelIndex() : m_proxy->mapFromSource(m_model->index(row, 0));
    if (!index.isValid()) {
        m_table->clearSelection();
        m_table->setCurrentIndex({});
        followSelection();
        return;
    }
    choose(index);
    m_table->scrollTo(index);
}

/// Selects only this row, regardless of modifier keys.
void EventTable::choose(const QModelIndex &row)
{
    m_isChoosing = true;
    m_table->selectionModel()->setCurrentIndex(row, QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
    m_isChoosing = false;
    followSelection();
}

void EventTable::activate(int proxyRow)
{
    if (proxyRow < 0 || proxyRow >= m_proxy->rowCount())
        return;
    choose(m_proxy->index(proxyRow, 0));
    emit eventActivated(selectedEvent());
}

void EventTable::step(int by)
{
    const int rows = m_proxy->rowCount();
    if (rows == 0)
        return;
    const int row = selectedEvent() == 0 ? (by > 0 ? -1 : rows) : m_table->currentIndex().row();
    activate((row + by + rows) % rows);
}

void EventTable::selectNext()
{
    step(1);
}

void EventTable::selectPrevious()
{
    step(-1);
}

void EventTable::applyFilter(const QString &text)
{
    const EventFilter filter(text);
    m_isChoosing = true; // another row is the current one for a moment
    m_proxy->setFilter(filter);
    m_isChoosing = false;
    followSelection();
    updateCount();
}

void EventTable::setPreview(bool isPreview)
{
    m_isPreview = isPreview;
    updateCount();
}

void EventTable::updateCount()
{
    constexpr int longestUnknown = 16; // letters
    const auto all = int(m_model->events().size());
    const int shown = m_proxy->rowCount();
    const QString &unknown = m_proxy->filter().misunderstood();
    const QString count = shown < all ? tr("%1 of %2 events").arg(shown).arg(all)
                          : all == 1  ? tr("1 event")
                                      : tr("%1 events").arg(all);
    m_count->setText(!unknown.isEmpty() ? tr("“%1”?").arg(labelText(unknown, longestUnknown))
                     : m_isPreview      ? tr("Preview: %1").arg(count)
                                        : count);
    static_cast<QStackedLayout *>(layout()->itemAt(1)->layout())->setCurrentIndex(all > 0 ? 1 : 0);
}

void EventTable::updateCard()
{
    constexpr int leastList = 130; // pixels, of the filter and some events
    const int row = m_model->rowOf(selectedEvent());
    m_card->setRow(row);
    m_card->setVisible(row >= 0 && height() >= leastList + m_card->layout()->totalHeightForWidth(width()));
}

void EventTable::resizeEvent(QResizeEvent *event)
{
    QWidget::resizeEvent(event);
    updateCard();
}

void EventTable::keyPressEvent(QKeyEvent *event)
{
    if (event->key() == Qt::Key_N && !(event->modifiers() & (Qt::ControlModifier | Qt::AltModifier)))
        step(event->modifiers().testFlag(Qt::ShiftModifier) ? -1 : 1);
    else
        QWidget::keyPressEvent(event);
}

bool EventTable::eventFilter(QObject *watched, QEvent *event)
{
    if (watched == m_table && event->type() == QEvent::KeyPress) {
        auto *key = static_cast<QKeyEvent *>(event);
        if (key->key() == Qt::Key_Return || key->key() == Qt::Key_Enter) {
            activate(m_table->currentIndex().row());
            return true;
        }
        if (key->key() == Qt::Key_N) { // otherwise the table's keyboard search would take it
            keyPressEvent(key);
            return true;
        }
    }
    return QWidget::eventFilter(watched, event);
}

} // namespace faintline
