#pragma once

#include "frames/PeakPyramid.h"
#include "widgets/base/ThemedPlot.h"
#include "widgets/base/Viewport.h"

#include <QPointer>

#include <memory>
#include <optional>
#include <vector>

class QwtPlotCurve;
class QwtPlotGrid;
class QwtPlotMarker;
class QwtPlotZoneItem;

namespace faintline {

class CanvasSentence;
class CurveKey;
struct StripSeries;

/// Curves over time, linked with the waterfalls: ln K and the continued fraction, or the statistic at the cursor.
///
/// Long curves are drawn by their minimum and maximum per pixel, so that a peak of one frame is visible. Time runs from
/// left to right. Wheel scrolls, Ctrl+wheel zooms in time, drag pans, click places the cursor.
class StripPlot : public ThemedPlot
{
    Q_OBJECT

public:
    enum class Side { Left, Right }; ///< which ordinate

    /// `ordinate`: title with unit of the left axis, "ln K (nat)".
    explicit StripPlot(const QString &ordinate, QWidget *parent = nullptr);
    ~StripPlot() override;

    void setViewport(Viewport *viewport);

    /// Replaces the curve of that name. `values`: one per step of `time`; NaN leaves a gap.
    void setSeries(const QString &name, const Axis &time, std::vector<float> values, Side side = Side::Left);
    void removeSeries(const QString &name);
    /// UTC of second 0, since 1970: the axis then shows times of day; none: seconds.
    void setStartUnixSeconds(std::optional<double> start);
    void setLeftTitle(const QString &title);
    void setRightTitle(const QString &title);

    /// Shows the values of a picture over time at the cursor's frequency and follows the cursor. Null for none.
    void setProfile(const QString &name, std::shared_ptr<const PeakPyramid> picture, const Axis &frequency);

    /// A fixed ordinate instead of the visible range, such as 0 … 1 for a fraction.
    void setFixedScale(Side side, const Span &span);

    /// A horizontal line with a label, such as the threshold; NaN for none.
    void setLevel(double value, const QString &label);

    /// Shades a range of the left ordinate, such as that of ln K on noise.
    void setBand(const std::optional<Span> &band);

    void setEmptySentence(const QString &sentence);

    QSize sizeHint() const override { return {520, 110}; }
    QSize minimumSizeHint() const override;

signals:
    void hovered(double seconds, double value);

protected:
    void wheelEvent(QWheelEvent *event) override;
    bool eventFilter(QObject *watched, QEvent *event) override;
    void restyle() override;
    void followCanvas() override { followSpan(); }

private:
    void layAxes();
    void nameCurves();
    int widthOfRightAxis() const;
    void followSpan();
    void followCursor();
    void readProfile();
    void updateOrdinate(Side side);
    StripSeries &series(const QString &name);

    QPointer<Viewport> m_viewport;
    std::vector<std::unique_ptr<StripSeries>> m_series;
    QString m_profileName;
    std::shared_ptr<const PeakPyramid> m_profile;
    Axis m_profileFrequency;
    std::optional<Span> m_fixed[2];
    std::optional<double> m_startUnixSeconds;
    double m_levelValue;
    QwtPlotGrid *m_grid;
    QwtPlotMarker *m_cursorLine;
    QwtPlotMarker *m_level;
    QwtPlotZoneItem *m_bandItem;
    std::optional<Span> m_band;
    CanvasSentence *m_sentence;
    CurveKey *m_key;
    std::optional<double> m_dragLow; ///< start of the visible time at the mouse press
    QPointF m_dragStart;
    bool m_isPanning = false;
};

} // namespace faintline
