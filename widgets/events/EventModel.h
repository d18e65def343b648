#pragma once

#include "analysis/Review.h"

#include <QAbstractTableModel>
#include <QHash>

#include <optional>
#include <set>
#include <vector>

namespace faintline {

/// Events as rows. Numbers sort as numbers (`SortRole`), and show with as many digits as they deserve.
class EventModel : public QAbstractTableModel
{
    Q_OBJECT

public:
    /// In a narrow panel only the first ones are in sight: where, and when it began, was detected and confirmed.
    enum Column {
        Id,
        Frequency,
        Bearing,
        Onset,
        Detection,
        Confirmation,
        Statistic,
        Snr,
        Window, ///< where some were found by another one than the others
        Utc,    ///< onset, where the recording knows when it began
        Radio,  ///< frequency with the receiver's centre, where there is one
        End,
        Drift,
        State,
        Judged,
        Class, ///< where one of the events has one
        Note,
        ColumnCount
    };
    static constexpr int SortRole = Qt::UserRole;

    using QAbstractTableModel::QAbstractTableModel;

    void setEvents(std::vector<Event> events);
    /// What was said about them, in any order; what is not there has not been reviewed.
    void setReviews(const std::vector<EventReview> &reviews);
    EventReview review(const Event &event) const;
    void setStatisticUnit(const QString &unit);
    /// The axes of the events' positions; of two, the first one takes the frequency's place, the second one is the
    /// bearing.
    void setAxes(const std::vector<Axis> &axes);
    bool hasBearing() const { return m_axes.size() > 1; }
    /// What the recording says of its beginning (UTC) and of the frequency that 0 Hz stands for.
    void setOrigin(std::optional<double> startUnixSeconds, double centreHz);
    bool hasUtc() const { return m_startUnixSeconds.has_value(); }
    /// Whether a longer window has found some of the events.
    bool hasWindows() const;
    /// Whether one of the events was given a class.
    bool hasClasses() const;
    bool hasRadio() const { return m_centreHz != 0.0; }
    const std::vector<Event> &events() const { return m_events; }

    /// Row of an event, -1 if there is none of that id.
    int rowOf(int id) const;

    /// "accepted", "rejected", with the number of the signal it belongs to where that is another event's.
    static QString reviewText(const EventReview &review);

    /// "confirmed", "tentative", with ", open" where the data ended first.
    static QString stateText(const Event &event);

    int rowCount(const QModelIndex &parent = {}) const override;
    int columnCount(const QModelIndex &parent = {}) const override;
    QVariant data(const QModelIndex &index, int role = Qt::DisplayRole) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role = Qt::DisplayRole) const override;

private:
    QString text(const Event &event, int column) const;
    QString radioText(const Event &event) const;
    double sortValue(const Event &event, int column) const;

    std::vector<Event> m_events;
    QHash<int, EventReview> m_reviews;
    std::set<std::string> m_labels; ///< in order, for sorting; events without one come last
    std::vector<Axis> m_axes;
    std::optional<double> m_startUnixSeconds;
    double m_centreHz = 0.0;
    int m_timeDecimals = 1; ///< of seconds, as short as the recording allows
    QString m_statisticUnit = QStringLiteral("nat");
};

} // namespace faintline
