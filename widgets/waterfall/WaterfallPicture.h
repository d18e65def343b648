#pragma once

#include "frames/PeakPyramid.h"
#include "widgets/base/ThemedPlot.h"
#include "widgets/plot/PictureColours.h"
#include "widgets/waterfall/ColourLevels.h"
#include "widgets/waterfall/PictureAxes.h"
#include "widgets/waterfall/PictureDisplay.h"

#include <QPointer>

#include <memory>
#include <optional>
#include <vector>

namespace faintline {

class CanvasSentence;
class RasterItem;

/// A spectrogram, or a detector's statistic, over time and frequency; or over any two axes, such as a sonar's range and
/// bearing, whose own names then label them.
///
/// The picture is a PeakPyramid, which keeps its maxima in time and frequency at any zoom; when zoomed in, every cell
/// is a plain rectangle. This class draws it with its colours and axes; MarkedWaterfall adds marks, and WaterfallView
/// mouse and keyboard.
class WaterfallPicture : public ThemedPlot
{
    Q_OBJECT

public:
    using Orientation = TimeDirection::Orientation;

    /// `heading`: name of the picture, "Input" or "Statistic". `display` and `direction`: shared with other pictures, not
    /// owned; null: the picture has its own.
    explicit WaterfallPicture(const QString &heading, PictureDisplay *display = nullptr,
                              TimeDirection *direction = nullptr);

    PictureDisplay &display() const { return *m_display; }
    TimeDirection &direction() const { return *m_direction; }

    /// Shared with other views; not owned. The caller sets its extents (see `extents`).
    virtual void setViewport(Viewport *viewport);
    Viewport *viewport() const { return m_viewport; }

    /// Sets the picture and the axis of its cells. Null shows the empty sentence. The range is kept unless it is
    /// automatic.
    virtual void setPicture(std::shared_ptr<const PeakPyramid> picture, const Axis &frequency);
    /// Sets the next picture of a sequence on the same axes; the colour range is kept, so that only the signal changes.
    virtual void setNextPicture(std::shared_ptr<const PeakPyramid> picture);
    /// Sets the same picture with more frames, and its close-up; the colour range is kept. Cheap.
    void setGrownPicture(std::shared_ptr<const PeakPyramid> picture, std::shared_ptr<const PeakPyramid> closeup);
    const std::shared_ptr<const PeakPyramid> &picture() const { return m_picture; }
    const Axis &frequencyAxis() const { return m_frequency; }

    /// A stretch of the picture with fewer frames per row: shown instead of it if it covers the visible part and pixels
    /// are smaller than the picture's own rows. Another picture discards it.
    void setCloseup(std::shared_ptr<const PeakPyramid> closeup);
    /// The picture, or its close-up if that is shown.
    const std::shared_ptr<const PeakPyramid> &shownPicture() const { return m_shown; }
    /// The more detailed of these two for the given time.
    const PeakPyramid &finestPicture(const Span &time) const;
    double framesPerPixel() const; ///< as visible

    /// The box that all cells of a picture fill: half a cell beyond the outermost frames and bins.
    static Viewport::Box extents(const Axis &time, const Axis &frequency);

    /// UTC of second 0, since 1970: the axis then shows times of day; none: seconds.
    void setStartUnixSeconds(std::optional<double> start);

    /// Sentence on the canvas while there is no picture.
    void setEmptySentence(const QString &sentence);

    virtual PictureColours colours() const;
    /// Values drawn in the map's first and last colour: dB or nat.
    const Span &range() const { return m_levels.range(); }
    /// Whether the picture shows the level itself, not that over the noise.
    bool isPlain() const { return m_isPlain; }
    void setPlain(bool isPlain);
    bool isRangeAutomatic() const { return m_levels.isAutomatic(); }
    /// The range suggested by the picture's values at this zoom: noise dark, signals bright.
    Span automaticRange() const;
    /// Number of pixels per byte of the picture's scale, for the whole picture, or its close-up, at this zoom.
    const std::vector<double> &histogram() const { return m_levels.histogram(); }
    QString valueUnit() const;                        ///< "dB", or the statistic's
    bool hasTime() const { return m_axes.hasTime(); } ///< as the picture's own axis
    /// Unit of the statistic, by default "nat", and a heading that contains it.
    void setStatisticUnit(const QString &unit, const QString &heading);
    void setHeading(const QString &heading);
    const QString &heading() const { return m_heading; } ///< whole, also where the picture's title is shortened

    /// Value of the cell, at the finest level stored; nothing outside the picture.
    std::optional<double> valueAt(double seconds, double hz) const;
    /// The strongest cell within a few pixels.
    std::optional<Viewport::Point> peakAround(const Viewport::Point &point) const;

    std::optional<double> threshold() const { return m_threshold; }

    /// Pixel on the canvas ↔ time and frequency.
    Viewport::Point pointAt(const QPointF &canvasPosition) const;
    QPointF positionOf(const Viewport::Point &point) const;
    bool isLogarithmic() const { return m_viewport && m_viewport->isLogarithmic(); } ///< the frequency axis
    bool isTimeVertical() const { return m_direction->isVertical(); }
    QwtAxisId timeAxis() const { return m_axes.timeAxis(); }
    QwtAxisId hzAxis() const { return m_axes.hzAxis(); }

    QSize sizeHint() const override { return {520, 420}; }
    QSize minimumSizeHint() const override { return {110, 100}; }

public slots:
    void setRange(double low, double high);
    void setAutomaticRange();
    /// Moves the black or white level by steps of 1 dB, or of ½ nat or a hundredth of the range.
    void stepBlack(int steps);
    void stepWhite(int steps);
    /// Threshold of the statistic in nats; NaN for none. Follows dragging.
    void setThreshold(double nats);

signals:
    void rangeChanged(double low, double high);
    void histogramChanged();
    void shownPictureChanged();
    void thresholdChanged(double nats); ///< NaN: none

protected:
    void restyle() override;
    void followCanvas() override;
    /// Called when the contents of the axes have changed; redraws them.
    virtual void updateContent();

private:
    double originHz() const; ///< of the frequency axis's labels
    Viewport::Box full() const;
    Viewport::Box visible() const;
    void followSpan();
    void fitTitles();
    void choosePicture(bool isOther = true);
    void countHistogram();
    void applyRange(const Span &range);
    double levelStep() const;

    QString m_heading;
    QString m_statisticUnit = QStringLiteral("nat");
    QPointer<Viewport> m_viewport;
    std::shared_ptr<const PeakPyramid> m_picture;
    std::shared_ptr<const PeakPyramid> m_closeup;
    std::shared_ptr<const PeakPyramid> m_shown; ///< one of them
    Axis m_frequency;
    std::optional<double> m_startUnixSeconds;
    RasterItem *m_raster;
    CanvasSentence *m_sentence;
    PictureDisplay *m_display;
    TimeDirection *m_direction;
    PictureAxes m_axes;
    ColourLevels m_levels;
    bool m_isPlain = false;
    std::optional<double> m_threshold;
};

} // namespace faintline
