#pragma once

#include "widgets/base/Viewport.h"

#include <QObject>

#include <optional>
#include <vector>

class QwtPlotCurve;

namespace faintline {

class WaterfallView;

/// Marks on a slice through the states: a ring around the best state, diamonds on states along paths.
class SliceMarks : public QObject
{
    Q_OBJECT

public:
    struct Best {
        double row = 0.0;
        double column = 0.0;
        double score = 0.0; ///< nat
    };

    explicit SliceMarks(WaterfallView &view); ///< its child

    void set(const std::optional<Best> &best, std::vector<Viewport::Point> paths);
    void clear() { set({}, {}); }

    const std::optional<Best> &best() const { return m_best; }
    const std::vector<Viewport::Point> &paths() const { return m_paths; }

private:
    void place();

    WaterfallView &m_view;
    std::optional<Best> m_best;
    std::vector<Viewport::Point> m_paths; ///< rows in place of seconds
    std::vector<QwtPlotCurve *> m_rings;  ///< a dark outline and the ring itself; owned by the view
    std::vector<QwtPlotCurve *> m_diamonds;
};

} // namespace faintline
