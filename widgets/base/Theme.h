#pragma once

#include <QColor>
#include <QFont>
#include <QPalette>

class QApplication;
class QWidget;
class QwtPlot;

namespace faintline {

/// How the program looks: Fusion, our own palettes, the bundled fonts; the same pixels on every machine.
///
/// There is no current theme to ask for: the palette carries it, so a widget finds its colours with
/// `Theme::colours(*this)` and restyles itself when its palette changes.
///
///     Theme::prepareEnvironment();          // before QApplication
///     QApplication application(argc, argv);
///     Theme::apply(Theme::Kind::Dark);
class Theme
{
public:
    enum class Kind { Light, Dark, HighContrast };

    /// "light", "dark", "contrast": as files and the command line write them. An unknown name is the dark one.
    static QString nameOf(Kind kind);
    static Kind named(const QString &name);

    /// What a palette has no role for.
    struct Colours {
        QColor canvas; ///< behind curves
        QColor grid;
        QColor frame; ///< hair lines round canvases and sections
        QColor text;
        QColor faintText; ///< units, hints, disabled sections
        QColor accent;    ///< selection, focus, the visible span
        QColor threshold;
        QColor event;
        QColor selectedEvent;
        QColor track;
        QColor truth;
        QColor cursor;
        QColor contour; ///< around the cells above the threshold
        QColor error;
        QColor curves[8]; ///< distinguishable without colour vision, in this order
    };

    /// Removes the environment variables that would change sizes or style. Call before QApplication is made.
    static void prepareEnvironment();

    /// Style, palette, fonts, C locale, steady text cursor. May be called again to change the theme of a running
    /// program.
    static void apply(Kind kind);

    static QPalette palette(Kind kind);
    static Kind kind(const QPalette &palette);

    static const Colours &colours(Kind kind);
    static const Colours &colours(const QWidget &widget);

    static QFont font(int pixelSize = 13);
    static QFont boldFont(int pixelSize = 13);
    static QFont monoFont(int pixelSize = 13); ///< figures that must stay in their columns
    static QFont plotFont();                   ///< tick labels
    static QFont plotTitleFont();              ///< axis titles
    static QFont plotHeadingFont();
    /// How much larger all plots' words are than usual, for those who sit far away.
    static void setPlotScale(double scale);
    static double plotScale();

    /// The thin frame of a plot's canvas, in the accent's colour while the plot has the focus.
    static void frame(QwtPlot &plot);
    static void frame(QwtPlot &plot, bool hasFocus); ///< where the plot is a part of what has it

    /// Makes a Qwt plot look like the rest: canvas, thin frame, short ticks, our fonts, margins.
    static void style(QwtPlot &plot);
};

} // namespace faintline
