#pragma once

#include "widgets/events/EventFilter.h"
#include "widgets/table/ColumnTable.h"

namespace faintline {

/// Sorts an EventModel by value and filters it.
class EventProxy : public ColumnProxy
{
    Q_OBJECT

public:
    using ColumnProxy::ColumnProxy;

    void setFilter(const EventFilter &filter);
    const EventFilter &filter() const { return m_filter; }

protected:
    bool filterAcceptsRow(int row, const QModelIndex &parent) const override;

private:
    EventFilter m_filter;
};

} // namespace faintline
