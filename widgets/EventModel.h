#pragma once

#include "analysis/analyse.h"

#include <QAbstractTableModel>

#include <optional>
#include <vector>

namespace faintline {

/// Events as rows. Numbers sort as numbers (`SortRole`), and show with as many digits as they deserve.
class EventModel : public QAbstractTableModel
{
    Q_OBJECT

public:
    enum Column { Id, Onset, Detection, End, Frequency, Bearing, Drift, Statistic, State, ColumnCount };
    static constexpr int SortRole = Qt::UserRole;

    using QAbstractTableModel::QAbstractTableModel;

    void setEvents(std::vector<Event> events);
    void setStatisticUnit(const QString &unit);
    /// The axes of the events' positions; of two, the first one takes the frequency's place, the second one is the bearing.
    void setAxes(const std::vector<Axis> &axes);
    bool hasBearing() const { return m_axes.size() > 1; }
    const std::vector<Event> &events() const { return m_events; }

    /// Row of an event, -1 if there is none of that id.
    int rowOf(int id) const;

    /// "confirmed", "tentative", with ", open" where the data ended first.
    static QString stateText(const Event &event);

    int rowCount(const QModelIndex &parent = {}) const override;
    int columnCount(const QModelIndex &parent = {}) const override;
    QVariant data(const QModelIndex &index, int role = Qt::DisplayRole) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role = Qt::DisplayRole) const override;

private:
    QString text(const Event &event, int column) const;
    double sortValue(const Event &event, int column) const;

    std::vector<Event> m_events;
    std::vector<Axis> m_axes;
    QString m_statisticUnit = QStringLiteral("nat");
};

} // namespace faintline
