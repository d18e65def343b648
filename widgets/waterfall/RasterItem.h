#pragma once

#include "base/Axis.h"
#include "frames/PeakPyramid.h"
#include "widgets/base/Span.h"
#include "widgets/base/rasterise.h"
#include "widgets/plot/PictureColours.h"

#include <qwt_plot_item.h>

#include <QImage>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace faintline {

/// Draws a PeakPyramid on a plot's axes.
///
/// There are two caches, each valid while its key is unchanged: the bytes of the pixels (picture, axes, size) and the
/// image made from them (colours, range, threshold). Dragging a range or a threshold thus costs one table lookup per
/// pixel. Pixels lie on a grid that is fixed in time and frequency, so a scrolling picture does not flicker, and only
/// newly visible parts are drawn; it is placed to the nearest half pixel.
class RasterItem : public QwtPlotItem
{
public:
    RasterItem();

    void setPicture(std::shared_ptr<const PeakPyramid> picture, const Axis &frequency);
    /// Shows a part of the frames of that time axis, on the same pixels as a picture of all of them.
    void setPicture(std::shared_ptr<const PeakPyramid> picture, const Axis &frequency, const Axis &time);
    void setTimeVertical(bool isVertical) { m_isTimeVertical = isVertical; }
    void setLogarithmic(bool isLogarithmic) { m_isLogarithmic = isLogarithmic; } ///< the frequency axis
    void setColours(const PictureColours &colours) { m_colours = colours; }

    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
              const QRectF &canvasRect) const override;

    /// The image of a canvas of the given number of device pixels. x (from left to right) and y are frequency and time
    /// if time is vertical, time and frequency otherwise; `isUpward`: y grows towards the top.
    QImage image(const Span &x, const Span &y, bool isUpward, const QSize &size) const;

private:
    struct BytesKey {
        const PeakPyramid *picture = nullptr;
        PixelRow time, cells;
        bool operator==(const BytesKey &) const = default;
    };
    struct ImageKey {
        bool isUpward = false;
        bool isTimeVertical = false;
        PictureColours colours;
        bool operator==(const ImageKey &) const = default;
    };

    void updateBytes(const PixelRow &time, const PixelRow &cells) const;
    void draw(const PixelRow &time, const PixelRow &cells, int level, std::span<std::uint8_t> out) const;
    void scroll(const PixelRow &time, const PixelRow &cells, int down, int right) const;
    void paint(const ImageKey &key, const QSize &size) const;

    std::shared_ptr<const PeakPyramid> m_picture;
    Axis m_frequency;
    Axis m_time;
    bool m_isTimeVertical = true;
    bool m_isLogarithmic = false;
    PictureColours m_colours;

    mutable BytesKey m_bytesKey;
    mutable std::vector<std::uint8_t> m_bytes; ///< as laid out by `rasterise`
    mutable std::optional<ImageKey> m_imageKey;
    mutable QImage m_image;
};

} // namespace faintline
