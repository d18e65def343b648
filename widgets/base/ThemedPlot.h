#pragma once

#include "base/Axis.h"

#include <qwt_plot.h>

#include <QMargins>

namespace faintline {

/// A plot that follows the theme, accepts the keyboard focus and shows it by its frame. Subclasses implement two
/// functions: one for changes of colours or texts, one for changes of the canvas size.
class ThemedPlot : public QwtPlot
{
    Q_OBJECT

public:
    using Axis = faintline::Axis; ///< QwtPlot has another Axis

    explicit ThemedPlot(QWidget *parent = nullptr);
    ~ThemedPlot() override;

    /// Pixels left free beside the plot, so that its canvas is aligned with those of other plots (TimeStack).
    void setSideRooms(int left, int right);
    const QMargins &sideRooms() const { return m_sideRooms; }

    /// Off: a time axis along the lower edge is not drawn, because a plot below has the same axis.
    void setTimeLabels(bool isOn);
    bool hasTimeLabels() const { return m_hasTimeLabels; }

protected:
    /// Called when the palette or the texts change.
    virtual void restyle() = 0;
    /// Called when the canvas size changes, on which ticks and per-pixel counts depend after layout.
    virtual void followCanvas() = 0;

    void changeEvent(QEvent *event) override;
    void focusInEvent(QFocusEvent *event) override;
    void focusOutEvent(QFocusEvent *event) override;
    /// Handles canvas events.
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    QMargins m_sideRooms;
    bool m_hasTimeLabels = true;
};

} // namespace faintline
