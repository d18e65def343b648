#pragma once

#include "widgets/base/Span.h"

#include <QObject>

#include <optional>
#include <vector>

namespace faintline {

/// Shared state of linked views: visible time and frequency, cursor, measured box.
///
/// Views change it directly, because it is view state rather than document state. All values are clamped to the
/// extents. Seconds count from the recording's first sample.
///
/// The frequency scale is linear or logarithmic. Zooming and scrolling preserve differences on a linear and ratios on a
/// logarithmic scale, whose extents begin above the cell at 0 Hz, at a thousandth of the highest frequency or higher.
class Viewport : public QObject
{
    Q_OBJECT

public:
    struct Point {
        double seconds = 0.0;
        double hz = 0.0;
        bool operator==(const Point &) const = default;
    };
    struct Box {
        Span time;      ///< s
        Span frequency; ///< Hz
        bool operator==(const Box &) const = default;
    };
    enum class Axes { Time, Frequency, Both };

    explicit Viewport(QObject *parent = nullptr);

    /// Sets the extents of a new recording: clears history, cursor and selection, and shows everything. The smallest
    /// spans limit zooming in.
    void setExtents(const Span &time, const Span &frequency, double smallestSeconds = 0.0, double smallestHz = 0.0);

    /// Ignored if the extents reach below 0 Hz, as those of I/Q recordings do. Also applies to later extents.
    void setLogarithmic(bool isLogarithmic);
    bool isLogarithmic() const { return m_isLogarithmic; }
    bool canBeLogarithmic() const;

    /// Added to frequencies in axis labels: the centre frequency of an I/Q recording.
    void setOriginHz(double hz);
    double originHz() const { return m_originHz; }

    bool isEmpty() const { return m_full.time.isEmpty() || m_full.frequency.isEmpty(); }
    const Box &full() const { return m_full; }
    Box extents() const { return {m_full.time, m_frequencies}; } ///< `full` on the linear scale
    const Box &visible() const { return m_visible; }
    const Span &time() const { return m_visible.time; }
    const Span &frequency() const { return m_visible.frequency; }
    bool showsAll() const { return m_visible == m_full; }

    const std::optional<Point> &cursor() const { return m_cursor; }
    const std::optional<Box> &selection() const { return m_selection; }

    bool canZoomBack() const { return !m_history.empty(); }

    /// Extends the time of a growing recording. While following, the visible span moves with the end; otherwise it
    /// stays.
    void grow(const Span &time);
    bool isFollowing() const { return m_isFollowing; }

public slots:
    /// Shows these spans and stores the previous ones for `zoomBack`.
    void zoomTo(const faintline::Span &time, const faintline::Span &frequency);
    /// Zooms about a fixed point; factors above 1 magnify. A sequence of calls is one step of the history.
    void zoomAt(double factor, const faintline::Viewport::Point &point, faintline::Viewport::Axes axes = Axes::Both);
    /// Scrolls; not stored in the history. The lowest visible frequency moves by `hz`.
    void pan(double seconds, double hz);
    /// Scrolls by fractions of the visible spans.
    void scroll(double timeShare, double frequencyShare);
    /// Scrolls from `start` so that `from` moves to the former position of `to`.
    void move(const faintline::Viewport::Box &start, const faintline::Viewport::Point &from,
              const faintline::Viewport::Point &to);
    /// Shows these spans; one step of the history together with the zooming before and after it.
    void stretch(const faintline::Span &time, const faintline::Span &frequency);
    /// Scrolls by as little as possible to show the box with some room around it; zooms out if necessary.
    void reveal(const faintline::Viewport::Box &box);
    void showAll();
    void zoomBack();

    /// Whether the end of a growing recording is followed. Scrolling away ends it, scrolling to the end resumes it.
    /// Setting it moves to the end.
    void setFollowing(bool isFollowing);

    void setCursor(const faintline::Viewport::Point &point);
    void clearCursor();
    void setSelection(const faintline::Viewport::Box &box);
    void clearSelection();

signals:
    void extentsChanged();
    void scaleChanged(); ///< linear or logarithmic, or its origin
    void spanChanged();
    void cursorChanged();
    void selectionChanged();
    void followingChanged(bool isFollowing);

private:
    double onScale(double hz) const;
    Span onScale(const Span &hz) const;
    Span fromScale(const Span &span) const;
    double smallestOnScale(const Span &span) const;
    void applyScale();
    Box clamped(const Box &box) const;
    void remember();
    void show(const Box &box);
    bool isAtEnd() const;

    Box m_full;
    Span m_frequencies; ///< extents on the linear scale
    bool m_wantsLogarithmic = false;
    bool m_isLogarithmic = false;
    double m_originHz = 0.0;
    Box m_visible;
    Box m_smallest; ///< widths only
    std::vector<Box> m_history;
    bool m_isZoomRun = false; ///< in a sequence of zoomAt or stretch that is already stored
    bool m_isGrowing = false; ///< since the extents were set
    bool m_isFollowing = false;
    std::optional<Point> m_cursor;
    std::optional<Box> m_selection;
};

} // namespace faintline
