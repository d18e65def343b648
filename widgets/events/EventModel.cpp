#include "widgets/events/EventModel.h"

#include "analyse/columns.h"
#include "base/utc.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"

#include <QGuiApplication>
#include <QPalette>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

namespace faintline {

namespace {

    Qt::Alignment alignmentOf(int column)
    {
        const bool isWord = column == EventModel::State || column == EventModel::Judged || column == EventModel::Class;
        return (isWord                       ? Qt::AlignHCenter
                : column == EventModel::Note ? Qt::AlignLeft
                                             : Qt::AlignRight)
               | Qt::AlignVCenter;
    }

    /// The column of files that is shown in a column of the table.
    const TableColumn<Event> &fileColumn(int column)
    {
        static const std::map<int, std::string> names{{EventModel::Id, "event"},
                                                      {EventModel::Onset, "t_onset"},
                                                      {EventModel::Detection, "t_detect"},
                                                      {EventModel::Statistic, "statistic"},
                                                      {EventModel::Snr, "snr_db"},
                                                      {EventModel::Chance, "noise_probability"},
                                                      {EventModel::Window, "window_s"},
                                                      {EventModel::End, "t_end"},
                                                      {EventModel::Drift, "drift_hz_per_s"}};
        static const auto columns = eventColumns(Grid(), {.secondPass = true});
        return *std::ranges::find(columns, names.at(column), &TableColumn<Event>::name);
    }

    QString chanceText(double probability)
    {
        return probability < 0.01 ? powerText(probability, 1)
                                  : EventModel::tr("%1 %").arg(numberText(100.0 * probability, 0));
    }

    double toTenths(double seconds)
    {
        return std::round(10.0 * seconds) / 10.0;
    }

} // namespace

double EventModel::sortValue(const Event &event, int column) const
{
    switch (column) {
    case Id:
        return event.id;
    case Utc:
        return event.onsetSeconds;
    case Confirmation:
        return std::isfinite(event.confirmSeconds) ? event.confirmSeconds : std::numeric_limits<double>::infinity();
    case Frequency:
    case Radio:
        return event.position.empty() ? 0.0 : event.position.front();
    case Bearing:
    case ThirdAxis:
    case FourthAxis: {
        const std::size_t axis = axisOf(Column(column));
        return event.position.empty() ? 0.0 : event.position[std::min(axis, event.position.size() - 1)];
    }
    case Drift:
        return hasBearing() && !event.ratesPerSecond.empty() ? event.ratesPerSecond.front() : event.driftPerSecond;
    case Snr:
        return std::isfinite(event.snrDb) ? event.snrDb : -std::numeric_limits<double>::infinity();
    case Chance:
        return std::isfinite(event.noiseProbability) ? event.noiseProbability : 1.0;
    case Window:
        return std::isfinite(event.windowSeconds) ? event.windowSeconds : 0.0;
    case Judged: {
        const EventReview said = review(event);
        return said.verdict == Verdict::Accepted ? 0.0 : said.verdict == Verdict::None ? 1.0 : 2.0;
    }
    case Class:
        return double(std::distance(m_labels.begin(), m_labels.find(review(event).label)));
    case Note:
        return review(event).note.empty() ? 1.0 : 0.0;
    case State:
        return (event.isConfirmed ? 0.0 : 2.0) + (event.isOpen ? 1.0 : 0.0);
    default:
        return fileColumn(column).number(event);
    }
}

void EventModel::setEvents(std::vector<Event> events)
{
    beginResetModel();
    m_events = std::move(events);
    QHash<int, Event> ordered;
    for (const Event &event : m_events)
        ordered.insert(event.id, m_ordered.value(event.id, event));
    m_ordered = std::move(ordered);
    double last = 0.0;
    for (const Event &event : m_events)
        last = std::max(last, event.endSeconds);
    m_timeDecimals = last < 3.0 ? 4 : last < 30.0 ? 2 : 1; // whistles last milliseconds
    m_areClockTimes = last >= clockFromSeconds;
    endResetModel();
}

void EventModel::takeOrder()
{
    for (const Event &event : m_events)
        m_ordered.insert(event.id, event);
}

void EventModel::setReviews(const std::vector<EventReview> &reviews)
{
    m_reviews.clear();
    m_labels.clear();
    for (const EventReview &one : reviews) {
        m_reviews.insert(one.event, one);
        if (!one.label.empty())
            m_labels.insert(one.label);
    }
    if (!m_events.empty())
        emit dataChanged(index(0, 0), index(rowCount() - 1, ColumnCount - 1));
}

EventReview EventModel::review(const Event &event) const
{
    return m_reviews.value(event.id, EventReview{event.id, Verdict::None, {}, event.id, {}});
}

QString EventModel::reviewText(const EventReview &review)
{
    QStringList words;
    if (review.verdict != Verdict::None)
        words << (review.verdict == Verdict::Accepted ? tr("accepted") : tr("rejected"));
    if (review.signal != review.event)
        words << tr("part of %1").arg(review.signal);
    return words.join(QStringLiteral(", "));
}

int EventModel::rowOf(int id) const
{
    for (std::size_t row = 0; row < m_events.size(); ++row)
        if (m_events[row].id == id)
            return int(row);
    return -1;
}

QString EventModel::stateText(const Event &event)
{
    const QString state = event.isConfirmed ? tr("confirmed") : tr("tentative");
    const QString ended = event.isOpen ? tr("%1, open").arg(state) : state;
    return event.isSubtracted ? tr("%1, subtracted").arg(ended) : ended;
}

int EventModel::rowCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : int(m_events.size());
}

int EventModel::columnCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : ColumnCount;
}

/// Seconds without a unit, which each row would repeat, or h:min:s in all rows.
QString EventModel::timeText(double seconds) const
{
    return m_areClockTimes && std::isfinite(seconds) ? clockText(seconds, 0, true)
                                                     : numberText(seconds, m_timeDecimals);
}

QString EventModel::text(const Event &event, int column) const
{
    switch (column) {
    case Id: { // visible in a narrow panel, unlike the review column
        const Verdict verdict = review(event).verdict;
        const QString mark = verdict == Verdict::Accepted   ? QStringLiteral("✓ ")
                             : verdict == Verdict::Rejected ? QStringLiteral("× ")
                                                            : QString();
        return mark + QString::number(event.id);
    }
    case Onset:
    case Detection:
    case End:
        return timeText(sortValue(event, column));
    case Confirmation:
        return timeText(event.confirmSeconds);
    case Utc:
        return m_startUnixSeconds
                   ? QString::fromStdString(formatUtc(toTenths(*m_startUnixSeconds + event.onsetSeconds)))
                   : QString();
    case Radio:
        return radioText(event);
    case Frequency:
        return event.position.empty()
                   ? QStringLiteral("–")
                   : numberText(event.position.front(), hasBearing() ? decimalsFor(m_axes.front().step) : 2);
    case Bearing:
    case ThirdAxis:
    case FourthAxis: {
        const std::size_t axis = axisOf(Column(column));
        return axis < event.position.size() ? numberText(event.position[axis], 1) : QStringLiteral("–");
    }
    case Drift:
        return powerText(sortValue(event, Drift), 3);
    case Statistic:
        return numberText(event.statistic, 1);
    case Snr:
        return std::isfinite(event.snrDb) ? numberText(event.snrDb, 1) : QStringLiteral("–");
    case Chance:
        return std::isfinite(event.noiseProbability) ? chanceText(event.noiseProbability) : QStringLiteral("–");
    case Window:
        return std::isfinite(event.windowSeconds) ? QString::number(event.windowSeconds, 'g', 4) : QStringLiteral("–");
    case Judged:
        return reviewText(review(event));
    case Class:
        return labelText(review(event).label, longestNote);
    case Note:
        return labelText(review(event).note, longestNote);
    default:
        return stateText(event);
    }
}

QVariant EventModel::data(const QModelIndex &index, int role) const
{
    if (!index.isValid() || index.row() >= rowCount())
        return {};
    const Event &event = m_events[std::size_t(index.row())];
    switch (role) {
    case Qt::DisplayRole:
        return text(event, index.column());
    case Qt::ForegroundRole:
        return review(event).verdict == Verdict::Rejected
                   ? QVariant(QGuiApplication::palette().brush(QPalette::PlaceholderText))
                   : QVariant();
    case Qt::ToolTipRole:
        if (const int column = index.column();
            column == Onset || column == Detection || column == Confirmation || column == End)
            return secondsText(sortValue(event, column), 0.01);
        return index.column() == Note && !text(event, Note).isEmpty() ? QVariant(asHtml(text(event, Note)))
                                                                      : QVariant();
    case SortRole:
        return sortValue(*m_ordered.constFind(event.id), index.column());
    case Qt::TextAlignmentRole:
        return QVariant::fromValue(alignmentOf(index.column()));
    case Qt::AccessibleTextRole:
        return tr("%1: %2").arg(headerData(index.column(), Qt::Horizontal, role).toString(),
                                text(event, index.column()));
    default:
        return {};
    }
}

bool EventModel::hasChances() const
{
    return std::ranges::any_of(m_events, [](const Event &event) { return std::isfinite(event.noiseProbability); });
}

bool EventModel::hasWindows() const
{
    return std::any_of(m_events.begin(), m_events.end(), [this](const Event &event) {
        return sortValue(event, Window) != sortValue(m_events.front(), Window);
    });
}

bool EventModel::hasClasses() const
{
    return !m_labels.empty();
}

void EventModel::setStatisticUnit(const QString &unit)
{
    m_statisticUnit = unit;
    emit headerDataChanged(Qt::Horizontal, Statistic, Statistic);
}

void EventModel::setSnrUnit(const QString &unit)
{
    m_snrUnit = unit;
    emit headerDataChanged(Qt::Horizontal, Snr, Snr);
}

void EventModel::setAxes(const std::vector<Axis> &axes)
{
    m_axes = axes;
    emit headerDataChanged(Qt::Horizontal, 0, ColumnCount - 1);
}

void EventModel::setOrigin(std::optional<double> startUnixSeconds, double centreHz)
{
    m_startUnixSeconds = startUnixSeconds;
    m_centreHz = centreHz;
    emit headerDataChanged(Qt::Horizontal, 0, ColumnCount - 1);
}

QString EventModel::radioText(const Event &event) const
{
    return event.position.empty() ? QString() : numberText(m_centreHz + event.position.front(), 2);
}

QVariant EventModel::headerData(int section, Qt::Orientation orientation, int role) const
{
    if (orientation != Qt::Horizontal)
        return {};
    if (role == Qt::TextAlignmentRole)
        return QVariant::fromValue(alignmentOf(section));
    const auto unit = [this](std::size_t axis) { return labelText(m_axes[axis].unit, mostUnitLetters); };
    const auto nameOf = [this](std::size_t axis) { return capitalised(labelText(m_axes[axis].name, mostUnitLetters)); };
    const auto heading = [&](Column column) {
        const std::size_t axis = axisOf(column);
        if (!hasColumn(column))
            return tr("Axis %1").arg(axis + 1);
        if (unit(axis).isEmpty())
            return nameOf(axis);
        // As "f (Hz)", so that the times are in view; the tool tip has the whole name.
        const bool isBrief = role == Qt::DisplayRole && m_axes.size() == 2 && nameOf(0).left(1) != nameOf(1).left(1);
        return QStringLiteral("%1 (%2)").arg(isBrief ? nameOf(axis).left(1) : nameOf(axis), unit(axis));
    };
    struct Words {
        QString heading, tip;
    };
    const auto own = [this](Column column) {
        const TableColumn<Event> &one = fileColumn(column);
        const bool isClock = column == Onset || column == Detection || column == End; // whose unit changes
        const QString name = QString::fromStdString(one.heading);
        const QString ownUnit = column == Statistic ? m_statisticUnit
                                : column == Snr     ? m_snrUnit
                                                    : QString::fromStdString(one.unit);
        return Words{isClock || ownUnit.isEmpty() ? name : QStringLiteral("%1 (%2)").arg(name, ownUnit),
                     QString::fromStdString(one.sentence)};
    };
    const auto atDetection = [&](Column column) {
        return tr("%1 at detection").arg(hasColumn(column) ? nameOf(axisOf(column)) : tr("Position"));
    };
    const Words words[] = {
        own(Id),
        hasBearing() ? Words{heading(Frequency), atDetection(Frequency)}
                     : Words{tr("f (Hz)"), tr("Frequency in the middle between onset and end")},
        {heading(Bearing), atDetection(Bearing)},
        {heading(ThirdAxis), atDetection(ThirdAxis)},
        {heading(FourthAxis), atDetection(FourthAxis)},
        {own(Onset).heading, tr("%1; s, from ten minutes on h:min:s").arg(own(Onset).tip)},
        own(Detection),
        {tr("Conf."), tr("Confirmed: time at which the track was confirmed")},
        own(Statistic),
        own(Snr),
        own(Chance),
        own(Window),
        {tr("Onset (UTC)"), tr("Date and time of the onset")},
        {tr("RF (Hz)"), tr("Radio frequency in the middle between onset and end: centre frequency plus offset")},
        own(End),
        hasBearing() ? Words{tr("Rate (%1/s)").arg(unit(0)), own(Drift).tip} : own(Drift),
        {tr("State"), tr("Confirmed or tentative; open if the data ended before the track")},
        {tr("Review"), tr("Accepted (Y), rejected (X) or undecided (U), or part of another event's signal")},
        {tr("Class"), tr("Your class of the signal; 1 to 9 set it, Shift+U clears it")},
        {tr("Note"), tr("Your note on the event; E edits it")}};
    if (section < 0 || section >= ColumnCount)
        return {};
    if (role == Qt::DisplayRole || role == Qt::AccessibleTextRole)
        return words[section].heading;
    return role == Qt::ToolTipRole ? words[section].tip : QVariant();
}

} // namespace faintline
