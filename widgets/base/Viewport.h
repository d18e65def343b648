#pragma once

#include "widgets/base/Span.h"

#include <QObject>

#include <optional>
#include <vector>

namespace faintline {

/// What linked views look at together: the visible time and frequency, the cursor, the measured box.
///
/// Views change it directly, for it is the state of the looking, not of the document. Everything is clamped to the
/// extents. Seconds count from the recording's first sample.
///
/// Frequency lies on a linear or a logarithmic scale; zooming and scrolling keep differences on the first and ratios on
/// the second, whose extents begin above the cell at 0 Hz, at a thousandth of the highest frequency or higher.
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

    /// A new recording: forgets history, cursor and selection, and shows all of it. The smallest spans bound zooming
    /// in.
    void setExtents(const Span &time, const Span &frequency, double smallestSeconds = 0.0, double smallestHz = 0.0);

    /// Ignored where the extents reach below 0 Hz, as those of I/Q recordings do. Holds for later extents, too.
    void setLogarithmic(bool isLogarithmic);
    bool isLogarithmic() const { return m_isLogarithmic; }
    bool canBeLogarithmic() const;

    /// Added to frequencies where an axis is labelled: the centre frequency of an I/Q recording.
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

    /// More time has come: the extents become these. While following, what is visible moves along with the end;
    /// else it stays.
    void grow(const Span &time);
    bool isFollowing() const { return m_isFollowing; }

public slots:
    /// Shows these spans and remembers those before for `zoomBack`.
    void zoomTo(const faintline::Span &time, const faintline::Span &frequency);
    /// Factor above 1 magnifies, about the point, which keeps its place. A run of these is one step of the history.
    void zoomAt(double factor, const faintline::Viewport::Point &point, faintline::Viewport::Axes axes = Axes::Both);
    /// Scrolls; not remembered. The lowest visible frequency moves by `hz`.
    void pan(double seconds, double hz);
    /// Scrolls by shares of what is visible.
    void scroll(double timeShare, double frequencyShare);
    /// Scrolls from `start` so that `from` comes to where `to` was.
    void move(const faintline::Viewport::Box &start, const faintline::Viewport::Point &from,
              const faintline::Viewport::Point &to);
    /// Shows these spans; one step of the history together with the zooming before and after it.
    void stretch(const faintline::Span &time, const faintline::Span &frequency);
    /// Scrolls just so far that the box can be seen, with some room around it; zooms out if it must.
    void reveal(const faintline::Viewport::Box &box);
    void showAll();
    void zoomBack();

    /// Whether growth is followed. Who looks elsewhere ends it, who scrolls to the end begins it again. On: goes there.
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
    bool m_isZoomRun = false; ///< in a run of zoomAt or stretch, already remembered
    bool m_isGrowing = false; ///< since the extents were set
    bool m_isFollowing = false;
    std::optional<Point> m_cursor;
    std::optional<Box> m_selection;
};

} // namespace faintline
