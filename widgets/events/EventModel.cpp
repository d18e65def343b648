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
#include <utility>

namespace faintline {

namespace {

    constexpr double never = std::numeric_limits<double>::infinity();

    double windowOf(const Event &event)
    {
        return std::isfinite(event.windowSeconds) ? event.windowSeconds : 0.0;
    }

    QString orDash(double value, const std::function<QString(double)> &text)
    {
        return std::isfinite(value) ? text(value) : QStringLiteral("–");
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

EventModel::EventModel(QObject *parent) : ColumnModel(parent)
{
    layColumns();
}

/// A column of files, with its unit if there is no other.
ShownColumn<Event> EventModel::ofFile(const char *name, std::function<QString(const Event &)> text,
                                      const std::optional<QString> &otherUnit) const
{
    static const auto columns = eventColumns(Grid(), {.secondPass = true, .kinds = true});
    const TableColumn<Event> &column = *std::ranges::find(columns, name, &TableColumn<Event>::name);
    const QString heading = QString::fromStdString(column.heading);
    const QString unit = otherUnit.value_or(QString::fromStdString(column.unit));
    return {.heading = unit.isEmpty() ? heading : QStringLiteral("%1 (%2)").arg(heading, unit),
            .text = std::move(text),
            .key = [&column](const Event &event) { return column.number(event); },
            .tip = QString::fromStdString(column.sentence)};
}

/// Seconds without a unit, which each row would repeat, or h:min:s in all rows.
QString EventModel::timeText(double seconds) const
{
    return m_areClockTimes && std::isfinite(seconds) ? clockText(seconds, 0, true)
                                                     : numberText(seconds, m_timeDecimals);
}

ShownColumn<Event> EventModel::withTimes(ShownColumn<Event> column) const
{
    column.text = [this, seconds = column.key](const Event &event) { return timeText(seconds(event)); };
    column.cellTip = [seconds = column.key](const Event &event) { return secondsText(seconds(event), 0.01); };
    return column;
}

ShownColumn<Event> EventModel::ofAxis(std::size_t axis) const
{
    const auto unitOf = [this](std::size_t i) { return labelText(m_scales.axes[i].unit, mostUnitLetters); };
    const auto nameOf = [this](std::size_t i) {
        return capitalised(labelText(m_scales.axes[i].name, mostUnitLetters));
    };
    ShownColumn<Event> column;
    column.text = [axis, decimals = axis == 0 && hasBearing() ? decimalsFor(m_scales.axes.front().step)
                                    : axis == 0               ? 2
                                                              : 1](const Event &event) {
        return axis < event.position.size() ? numberText(event.position[axis], decimals) : QStringLiteral("–");
    };
    column.key = [axis](const Event &event) {
        return event.position.empty() ? 0.0 : event.position[std::min(axis, event.position.size() - 1)];
    };
    if (axis == 0 && !hasBearing()) {
        column.heading = tr("f (Hz)");
        column.tip = tr("Frequency in the middle between onset and end");
        return column;
    }
    const bool isThere = axis < m_scales.axes.size();
    column.tip = tr("%1 at detection").arg(isThere ? nameOf(axis) : tr("Position"));
    if (!isThere || unitOf(axis).isEmpty()) {
        column.heading = isThere ? nameOf(axis) : tr("Axis %1").arg(axis + 1);
        return column;
    }
    // As "f (Hz)", so that the times are in view; the tool tip has the whole name.
    const bool isBrief = m_scales.axes.size() == 2 && nameOf(0).left(1) != nameOf(1).left(1);
    column.spoken = QStringLiteral("%1 (%2)").arg(nameOf(axis), unitOf(axis));
    column.heading = isBrief ? QStringLiteral("%1 (%2)").arg(nameOf(axis).left(1), unitOf(axis)) : column.spoken;
    return column;
}

/// In the order of `Column`.
std::vector<ShownColumn<Event>> EventModel::columns() const
{
    using E = const Event &;
    const auto radioHz = [this](E event) { return m_scales.centreHz + event.position.front(); };
    ShownColumn<Event> onset = withTimes(ofFile("t_onset", {}, QString()));
    onset.tip = tr("%1; s, from ten minutes on h:min:s").arg(onset.tip);
    ShownColumn<Event> drift = ofFile("drift_hz_per_s", {});
    if (hasBearing())
        drift.heading = tr("Rate (%1/s)").arg(labelText(m_scales.axes.front().unit, mostUnitLetters));
    drift.key = [this](E event) {
        return hasBearing() && !event.ratesPerSecond.empty() ? event.ratesPerSecond.front() : event.driftPerSecond;
    };
    drift.text = [rate = drift.key](E event) { return powerText(rate(event), 3); };
    ShownColumn<Event> snr = ofFile(
        "snr_db", [](E event) { return orDash(event.snrDb, [](double value) { return numberText(value, 1); }); },
        m_snrUnit);
    snr.key = [](E event) { return event.snrDb; };
    ShownColumn<Event> id = ofFile("event", [this](E event) { return idText(event); });
    id.key = [](E event) { return event.id; };
    ShownColumn<Event> call =
        ofFile("call", [](E event) { return event.call == 0 ? QString() : QString::number(event.call); });
    call.key = [](E event) { return event.call; };

    std::vector<ShownColumn<Event>> all{
        id,
        ofAxis(0),
        ofAxis(1),
        ofAxis(2),
        ofAxis(3),
        onset,
        withTimes(ofFile("t_detect", {}, QString())),
        withTimes({.heading = tr("Conf."),
                   .key = [](E event) { return event.confirmSeconds; },
                   .tip = tr("Confirmed: time at which the track was confirmed")}),
        ofFile(
            "statistic", [](E event) { return numberText(event.statistic, 1); }, m_scales.statisticUnit),
        snr,
        ofFile("noise_probability", [](E event) { return orDash(event.noiseProbability, chanceText); }),
        ofFile("window_s",
               [](E event) {
                   return orDash(event.windowSeconds, [](double value) { return QString::number(value, 'g', 4); });
               }),
        {.heading = tr("Kind"),
         .text = [](E event) { return QString::fromStdString(nameOf(event.kind)); },
         .key = [](E event) { return double(event.kind); },
         .alignment = Qt::AlignHCenter,
         .tip =
             tr("Line, keyed (a line with two pauses or more), or spread: wider than a line, followed by its centre")},
        call,
        {.heading = tr("Onset (UTC)"),
         .text =
             [this](E event) {
                 return m_scales.startUnixSeconds ? QString::fromStdString(
                            formatUtc(toTenths(*m_scales.startUnixSeconds + event.onsetSeconds)))
                                                  : QString();
             },
         .key = [](E event) { return event.onsetSeconds; },
         .tip = tr("Date and time of the onset")},
        {.heading = tr("RF (Hz)"),
         .text = [radioHz](E event) { return event.position.empty() ? QString() : numberText(radioHz(event), 2); },
         .key = [](E event) { return event.position.empty() ? 0.0 : event.position.front(); },
         .tip = tr("Radio frequency in the middle between onset and end: centre frequency plus offset")},
        withTimes(ofFile("t_end", {}, QString())),
        drift,
        {.heading = tr("State"),
         .text = stateText,
         .key = [](E event) { return (event.isConfirmed ? 0.0 : 2.0) + (event.isOpen ? 1.0 : 0.0); },
         .alignment = Qt::AlignHCenter,
         .tip = tr("Confirmed or tentative; open if the data ended before the track")},
        {.heading = tr("Review"),
         .text = [this](E event) { return reviewText(review(event)); },
         .key =
             [this](E event) {
                 const Verdict verdict = review(event).verdict;
                 return verdict == Verdict::Accepted ? 0.0 : verdict == Verdict::None ? 1.0 : 2.0;
             },
         .alignment = Qt::AlignHCenter,
         .tip = tr("Accepted (Y), rejected (X) or undecided (U), or part of another event's signal")},
        {.heading = tr("Class"),
         .text = [this](E event) { return labelText(review(event).label, longestNote); },
         .key = [this](E event) { return double(std::distance(m_labels.begin(), m_labels.find(review(event).label))); },
         .alignment = Qt::AlignHCenter,
         .tip = tr("Your class of the signal; 1 to 9 set it, Shift+U clears it")},
        {.heading = tr("Note"),
         .text = [this](E event) { return labelText(review(event).note, longestNote); },
         .key = [this](E event) { return review(event).note.empty() ? 1.0 : 0.0; },
         .alignment = Qt::AlignLeft,
         .tip = tr("Your note on the event; E edits it"),
         .cellTip =
             [this](E event) {
                 const QString note = labelText(review(event).note, longestNote);
                 return note.isEmpty() ? QVariant() : asHtml(note);
             }}};
    for (ShownColumn<Event> &one : all)
        one.colour = [this](E event) {
            return review(event).verdict == Verdict::Rejected
                       ? QVariant(QGuiApplication::palette().brush(QPalette::PlaceholderText))
                       : QVariant();
        };
    return all;
}

/// The texts are those of the events, the order is that of the values with which they were listed.
void EventModel::layColumns()
{
    std::vector<ShownColumn<int>> all;
    for (const ShownColumn<Event> &one : columns()) {
        const auto of = [this](const auto &function) {
            return [this, function](int row) { return function(m_events[std::size_t(row)]); };
        };
        const auto key = [this, key = one.key](int row) {
            return key(*m_ordered.constFind(m_events[std::size_t(row)].id));
        };
        all.push_back({one.heading, of(one.text), key, one.alignment, one.tip, one.spoken, of(one.colour), {}});
        if (one.cellTip)
            all.back().cellTip = of(one.cellTip);
    }
    setColumns(std::move(all));
    emit headerDataChanged(Qt::Horizontal, 0, ColumnCount - 1);
}

void EventModel::setEvents(std::vector<Event> events)
{
    beginResetModel();
    m_events = std::move(events);
    setRowCount(int(m_events.size()));
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

/// Visible in a narrow panel, unlike the review column.
QString EventModel::idText(const Event &event) const
{
    const Verdict verdict = review(event).verdict;
    const QString mark = verdict == Verdict::Accepted   ? QStringLiteral("✓ ")
                         : verdict == Verdict::Rejected ? QStringLiteral("× ")
                                                        : QString();
    return mark + QString::number(event.id);
}

bool EventModel::hasChances() const
{
    return std::ranges::any_of(m_events, [](const Event &event) { return std::isfinite(event.noiseProbability); });
}

bool EventModel::hasWindows() const
{
    return std::ranges::any_of(m_events,
                               [&](const Event &event) { return windowOf(event) != windowOf(m_events.front()); });
}

bool EventModel::hasKinds() const
{
    return std::ranges::any_of(m_events, [](const Event &event) { return event.kind > SignalKind::Line; });
}

bool EventModel::hasCalls() const
{
    return std::ranges::any_of(m_events, [](const Event &event) { return event.call != 0; });
}

bool EventModel::hasClasses() const
{
    return !m_labels.empty();
}

void EventModel::setScales(const EventScales &scales)
{
    if (scales == m_scales)
        return;
    m_scales = scales;
    layColumns();
}

void EventModel::setSnrUnit(const QString &unit)
{
    if (std::exchange(m_snrUnit, unit) != unit)
        layColumns();
}

} // namespace faintline
