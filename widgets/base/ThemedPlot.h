#pragma once

#include "base/Axis.h"

#include <qwt_plot.h>

namespace faintline {

/// A plot that looks as the theme says and takes the keyboard's focus, which its frame shows. What a plot of one's own
/// adds is said in two functions: one for other colours or words, one for a canvas of another size.
class ThemedPlot : public QwtPlot
{
    Q_OBJECT

public:
    using Axis = faintline::Axis; ///< QwtPlot has one of its own

    explicit ThemedPlot(QWidget *parent = nullptr);
    ~ThemedPlot() override;

protected:
    /// Palette or words are others.
    virtual void restyle() = 0;
    /// The canvas has another size: ticks, and what is counted per pixel, depend on it as laid out, not on the window.
    virtual void followCanvas() = 0;

    void changeEvent(QEvent *event) override;
    void focusInEvent(QFocusEvent *event) override;
    void focusOutEvent(QFocusEvent *event) override;
    /// What happens on the canvas.
    bool eventFilter(QObject *watched, QEvent *event) override;
};

} // namespace faintline
