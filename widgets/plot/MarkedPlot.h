#pragma once

#include "widgets/base/Span.h"
#include "widgets/base/ThemedPlot.h"

#include <optional>
#include <vector>

class QwtPlotGrid;

namespace faintline {

class CanvasSentence;

/// Base class of plots for sequential tests: an integer abscissa, titles and spans, lines with texts, a cursor set by
/// clicks, and a sentence while there is no data. Follows the palette.
class MarkedPlot : public ThemedPlot
{
    Q_OBJECT

public:
    /// A line across the canvas at x (upright) or at y, with a text.
    struct Mark {
        double at = 0.0;
        bool isUpright = true;
        QString words;
        bool isAbove = false; ///< for a level line: the text is above it
        bool operator==(const Mark &) const = default;
    };

    explicit MarkedPlot(QWidget *parent = nullptr);

    void setTitles(const QString &x, const QString &y);
    void setSpans(const Span &x, const Span &y);
    void setMarks(std::vector<Mark> marks);
    const std::vector<Mark> &marks() const { return m_marks; }
    /// Distance of the texts of upright lines from the canvas's upper edge.
    void setMarksTop(double pixels) { m_marksTop = pixels; }
    void setCursor(std::optional<double> x);
    std::optional<double> cursor() const { return m_cursorAt; }
    void setEmptySentence(const QString &sentence);
    /// Whether the sentence is shown instead of the axes.
    void setEmpty(bool isEmpty);

    QPointF canvasPosition(double x, double y) const;

    QSize sizeHint() const override { return {420, 220}; }
    QSize minimumSizeHint() const override { return {180, 110}; }

signals:
    /// A click on the canvas, in the axes' values.
    void activated(double x, double y);

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;
    void followCanvas() override { layAxes(); }

    /// Called when colours may have changed; overrides call this implementation first.
    void restyle() override;
    /// A click on the canvas, in its pixels.
    virtual void clicked(const QPointF &canvas);

private:
    class MarkItem;
    void layAxes();

    Span m_x{0.0, 1.0};
    Span m_y{0.0, 1.0};
    std::vector<Mark> m_marks;
    double m_marksTop = 3.0;
    std::optional<double> m_cursorAt;
    int m_resizing = 0; ///< nested
    QwtPlotGrid *m_grid;
    MarkItem *m_markItem;
    CanvasSentence *m_sentence;
};

} // namespace faintline
