#include "widgets/events/EventProxy.h"

#include "widgets/events/EventModel.h"

namespace faintline {

void EventProxy::setFilter(const EventFilter &filter)
{
    m_filter = filter;
    invalidateFilter();
    sort(sortColumn(), sortOrder()); // rows that come back are last otherwise
}

bool EventProxy::filterAcceptsRow(int row, const QModelIndex &) const
{
    const auto *model = static_cast<const EventModel *>(sourceModel());
    const Event &event = model->events()[std::size_t(row)];
    return m_filter.accepts(event, model->review(event));
}

} // namespace faintline
