#pragma once

#include "inspect/Review.h"

#include "widgets/table/ColumnModel.h"

#include <QHash>

#include <optional>
#include <set>
#include <vector>

namespace faintline {

/// What the numbers of a list of events are measured in and from.
struct EventScales {
    std::vector<Axis>
        axes{}; ///< of the positions; of two, the first takes the frequency's column, the second is the bearing
    QString statisticUnit = QStringLiteral("nat");
    std::optional<double> startUnixSeconds{}; ///< of the recording
    double centreHz = 0.0;                    ///< the frequency that corresponds to 0 Hz
    bool operator==(const EventScales &) const = default;
};

/// Table model of events. Numbers sort numerically (`SortRole`), and are shown with a suitable number of digits.
class EventModel : public ColumnModel
{
    Q_OBJECT

public:
    /// In a narrow panel only the first columns are visible: position, onset, detection and confirmation.
    enum Column {
        Id,
        Frequency,
        Bearing, ///< along the second axis, if there is one
        ThirdAxis,
        FourthAxis,
        Onset,
        Detection,
        Confirmation,
        Statistic,
        Snr,
        Chance, ///< of being noise, if it is known of some events
        Window, ///< if events were found with different windows
        Kind,   ///< if not all are lines
        Call,   ///< if some are overtones of one source
        Utc,    ///< onset, if the recording's start time is known
        Radio,  ///< frequency including the receiver's centre, if there is one
        End,
        Drift,
        State,
        Judged,
        Class, ///< if an event has one
        Note,
        ColumnCount
    };

    explicit EventModel(QObject *parent = nullptr);

    /// Events that were listed before keep their place in the order (`SortRole`), with the values that they had then.
    void setEvents(std::vector<Event> events);
    /// Orders by the values that are shown.
    void takeOrder();
    /// Reviews in any order; events without one are not reviewed.
    void setReviews(const std::vector<EventReview> &reviews);
    EventReview review(const Event &event) const;
    void setScales(const EventScales &scales);
    void setSnrUnit(const QString &unit); ///< of the events' SNR, by default "dB": in a bin
    bool hasBearing() const { return hasColumn(Bearing); }
    /// Whether a column of a position is on an axis of the frames.
    bool hasColumn(Column column) const { return std::size_t(column - Frequency) < m_scales.axes.size(); }
    bool hasUtc() const { return m_scales.startUnixSeconds.has_value(); }
    bool hasChances() const;
    /// Whether another window found some of the events.
    bool hasWindows() const;
    /// Whether some events are of another kind than lines.
    bool hasKinds() const;
    /// Whether some events are overtones of one source.
    bool hasCalls() const;
    /// Whether any event has a class.
    bool hasClasses() const;
    bool hasRadio() const { return m_scales.centreHz != 0.0; }
    const std::vector<Event> &events() const { return m_events; }

    /// Row of an event; -1 if there is none with that id.
    int rowOf(int id) const;

    /// "accepted", "rejected", with the number of the signal if it is another event's.
    static QString reviewText(const EventReview &review);

    /// "confirmed", "tentative", with ", open" if the data ended before the track.
    static QString stateText(const Event &event);

private:
    void layColumns();
    std::vector<ShownColumn<Event>> columns() const;
    ShownColumn<Event> ofFile(const char *name, std::function<QString(const Event &)> text,
                              const std::optional<QString> &otherUnit = {}) const;
    ShownColumn<Event> withTimes(ShownColumn<Event> column) const; ///< whose key is seconds
    ShownColumn<Event> ofAxis(std::size_t axis) const;
    QString idText(const Event &event) const;
    QString timeText(double seconds) const;

    std::vector<Event> m_events;
    QHash<int, Event> m_ordered; ///< with the values by which they are ordered
    QHash<int, EventReview> m_reviews;
    std::set<std::string> m_labels; ///< in order, for sorting; events without one come last
    EventScales m_scales;
    int m_timeDecimals = 1;       ///< of seconds, as short as the recording allows
    bool m_areClockTimes = false; ///< h:min:s
    QString m_snrUnit = QStringLiteral("dB");
};

} // namespace faintline
