#pragma once

#include <QColor>
#include <QFont>
#include <QPalette>

class QApplication;
class QWidget;
class QwtPlot;

namespace faintline {

/// Appearance of the program: Fusion, our own palettes, bundled fonts; the same pixels on every machine.
///
/// There is no global current theme: the palette carries it, so a widget gets its colours with `Theme::colours(*this)`
/// and restyles itself when its palette changes.
///
///     Theme::prepareEnvironment();          // before QApplication
///     QApplication application(argc, argv);
///     Theme::apply(Theme::Kind::Dark);
class Theme
{
public:
    enum class Kind { Light, Dark, HighContrast };

    /// "light", "dark", "contrast", as in files and on the command line. Unknown names give the dark theme.
    static QString nameOf(Kind kind);
    static Kind named(const QString &name);

    /// Colours for which QPalette has no role.
    struct Colours {
        QColor canvas; ///< behind curves
        QColor grid;
        QColor frame; ///< hairlines around canvases and sections
        QColor text;
        QColor faintText; ///< units, hints, disabled sections
        QColor accent;    ///< selection, focus, the visible span
        QColor threshold;
        QColor event;
        QColor selectedEvent;
        QColor track;
        QColor truth;
        QColor picture; ///< most of a picture, on which these marks lie
        QColor cursor;
        QColor contour; ///< around the cells above the threshold
        QColor error;
        QColor curves[8]; ///< distinguishable without colour vision, used in this order
    };

    /// Removes environment variables that would change fonts or style. Call before creating QApplication.
    static void prepareEnvironment();
    /// Also removes the user's scale, on which rendered pictures do not depend.
    static void prepareForPictures();

    /// Sets style, palette, fonts, C locale and a non-blinking text cursor. May be called again to change the theme of
    /// a running program.
    static void apply(Kind kind);

    static QPalette palette(Kind kind);
    static Kind kind(const QPalette &palette);

    static const Colours &colours(Kind kind);
    static const Colours &colours(const QWidget &widget);

    static QFont font(int pixelSize = 13);
    static QFont boldFont(int pixelSize = 13);
    static QFont monoFont(int pixelSize = 13); ///< for figures in columns
    static QFont plotFont();                   ///< tick labels
    static QFont plotTitleFont();              ///< axis titles
    static QFont plotHeadingFont();
    /// Relative text size of all plots, for presentations.
    static void setPlotScale(double scale);
    static double plotScale();

    /// Draws the thin frame of a plot's canvas, in the accent colour while the plot has the focus.
    static void frame(QwtPlot &plot);
    static void frame(QwtPlot &plot, bool hasFocus); ///< if the plot is part of the focused widget

    /// Styles a Qwt plot: canvas, thin frame, short ticks, fonts, margins.
    static void style(QwtPlot &plot);
};

} // namespace faintline
