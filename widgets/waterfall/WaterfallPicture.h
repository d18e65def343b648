#pragma once

#include "base/Axis.h"
#include "spectrum/PeakPyramid.h"
#include "widgets/base/ThemedPlot.h"
#include "widgets/base/Viewport.h"
#include "widgets/plot/ColourMap.h"
#include "widgets/waterfall/ColourLevels.h"

#include <QPointer>

#include <memory>
#include <optional>
#include <vector>

namespace faintline {

class CanvasSentence;
class NumberScaleDraw;
class RasterItem;
class TimeScaleDraw;

/// A spectrogram, or a detector's statistic, over time and frequency; or over any two axes, such as a sonar's range and
/// bearing: where the picture's own axis is no time, it is labelled as what it is.
///
/// The picture is a PeakPyramid and keeps its maxima in time and frequency however far one zooms out; zoomed in, every
/// cell is a plain rectangle. This class draws it in its colours along its axes; MarkedWaterfall adds what is marked on
/// it, and WaterfallView what mouse and keyboard do.
class WaterfallPicture : public ThemedPlot
{
    Q_OBJECT

public:
    enum class Orientation { NewestOnTop, OldestOnTop, LeftToRight };
    Q_ENUM(Orientation)

    /// `heading`: what the picture shows, "Input" or "Statistic".
    explicit WaterfallPicture(const QString &heading, QWidget *parent = nullptr);

    /// Shared with other views; not owned. The caller sets its extents (see `extents`).
    virtual void setViewport(Viewport *viewport);
    Viewport *viewport() const { return m_viewport; }

    /// The picture and the axis of its cells. Null shows the empty sentence. The range stays unless it is automatic.
    virtual void setPicture(std::shared_ptr<const PeakPyramid> picture, const Axis &frequency);
    /// The next one of a film, on the same axes: colours keep their range, so that what moves is the signal.
    virtual void setNextPicture(std::shared_ptr<const PeakPyramid> picture);
    /// The same picture, which more has come to, and its close-up: colours keep their range. Cheap.
    void setGrownPicture(std::shared_ptr<const PeakPyramid> picture, std::shared_ptr<const PeakPyramid> closeup);
    const std::shared_ptr<const PeakPyramid> &picture() const { return m_picture; }
    const Axis &frequencyAxis() const { return m_frequency; }

    /// A stretch of the picture in rows of fewer frames: shown in its place wherever it holds all that can be seen and
    /// pixels are smaller than the picture's own rows. Another picture drops it.
    void setCloseup(std::shared_ptr<const PeakPyramid> closeup);
    /// The picture, or its close-up where that is what can be seen.
    const std::shared_ptr<const PeakPyramid> &shownPicture() const { return m_shown; }
    /// Of these two the one that tells most of that time.
    const PeakPyramid &finestPicture(const Span &time) const;
    double framesPerPixel() const; ///< as visible

    /// The box all cells of a picture fill: half a cell beyond the outermost frames and bins.
    static Viewport::Box extents(const Axis &time, const Axis &frequency);

    /// UTC of second 0, from 1970 on: the axis then shows times of day; none: seconds.
    void setStartUnixSeconds(std::optional<double> start);

    /// What stands on the canvas while there is no picture.
    void setEmptySentence(const QString &sentence);

    Orientation orientation() const { return m_orientation; }
    const ColourMap &colourMap() const { return *m_colourMap; }
    /// Values drawn in the map's first and last colour: dB or nat.
    const Span &range() const { return m_levels.range(); }
    bool isRangeAutomatic() const { return m_levels.isAutomatic(); }
    /// The range the picture's values suggest at this zoom: noise dark, what stands out of it bright.
    Span automaticRange() const;
    /// Number of pixels per byte of the picture's scale, for the whole picture, or its close-up, at this zoom.
    const std::vector<double> &histogram() const { return m_levels.histogram(); }
    QString valueUnit() const; ///< "dB", or the statistic's
    bool hasTime() const;      ///< as the picture's own axis
    /// What a statistic is measured in, "nat" unless said otherwise, and the heading that says so.
    void setStatisticUnit(const QString &unit, const QString &heading);
    void setHeading(const QString &heading);

    /// The value of the cell there, at the finest level kept; nothing outside the picture.
    std::optional<double> valueAt(double seconds, double hz) const;
    /// The strongest cell within a few pixels.
    std::optional<Viewport::Point> peakAround(const Viewport::Point &point) const;

    std::optional<double> threshold() const { return m_threshold; }

    /// Pixel on the canvas ↔ time and frequency.
    Viewport::Point pointAt(const QPointF &canvasPosition) const;
    QPointF positionOf(const Viewport::Point &point) const;
    bool isTimeVertical() const { return m_orientation != Orientation::LeftToRight; }
    QwtAxisId timeAxis() const { return isTimeVertical() ? QwtAxis::YLeft : QwtAxis::XBottom; }
    QwtAxisId hzAxis() const { return isTimeVertical() ? QwtAxis::XBottom : QwtAxis::YLeft; }

    QSize sizeHint() const override { return {520, 420}; }
    QSize minimumSizeHint() const override { return {220, 180}; }

public slots:
    void setOrientation(faintline::WaterfallPicture::Orientation orientation);
    void cycleOrientation();
    void setColourMap(const QString &name);
    void cycleColourMap();
    void setRange(double low, double high);
    void setAutomaticRange();
    /// Moves the black or white level by so many steps of 1 dB or ½ nat.
    void stepBlack(int steps);
    void stepWhite(int steps);
    /// Of the statistic, in nats; NaN for none. Live while the threshold is dragged.
    void setThreshold(double nats);

signals:
    void orientationChanged(faintline::WaterfallPicture::Orientation orientation);
    void colourMapChanged(const QString &name);
    void rangeChanged(double low, double high);
    void histogramChanged();
    void shownPictureChanged();
    void thresholdChanged(double nats); ///< NaN: none

protected:
    void restyle() override;
    void followCanvas() override { followSpan(); }
    /// What is drawn upon the axes is no longer what it was; draws it anew.
    virtual void updateContent();

    RasterItem &raster() { return *m_raster; }

private:
    Viewport::Box full() const;
    Viewport::Box visible() const;
    void followSpan();
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
    TimeScaleDraw *m_timeDraw = nullptr;     ///< the plot's; null where the picture's own axis is not time,
    NumberScaleDraw *m_numberDraw = nullptr; ///< and then this one
    const ColourMap *m_colourMap;
    Orientation m_orientation = Orientation::NewestOnTop;
    ColourLevels m_levels;
    std::optional<double> m_threshold;
};

} // namespace faintline
