#pragma once

#include "inspect/Review.h"

#include <QString>

#include <functional>
#include <vector>

namespace faintline {

/// A filter from a line of text: state words and comparisons, all of which must hold.
///
///     f>1000 drift<0 stat>=25 t<60 dur>5 id=3 open confirmed tentative
///     accepted rejected unreviewed merged noted line keyed spread !rejected
///
/// A term that is not understood is reported and accepts everything.
class EventFilter
{
public:
    EventFilter() = default;
    explicit EventFilter(const QString &text);

    bool accepts(const Event &event, const EventReview &review = {}) const;
    const QString &misunderstood() const { return m_misunderstood; } ///< the first such term, or empty

private:
    std::vector<std::function<bool(const Event &, const EventReview &)>> m_terms;
    QString m_misunderstood;
};

} // namespace faintline
