#include "widgets/base/Theme.h"

#include "widgets/base/icon.h"

#include <qwt_plot.h>
#include <qwt_plot_canvas.h>
#include <qwt_plot_layout.h>
#include <qwt_scale_draw.h>
#include <qwt_scale_widget.h>

#include <QApplication>
#include <QFontDatabase>
#include <QLocale>
#include <QPainter>
#include <QProxyStyle>
#include <QStyleOption>
#include <QToolTip>

#include <cmath>
#include <utility>

namespace faintline {

namespace {

    constexpr auto sansFamily = "Inter";
    constexpr auto monoFamily = "Noto Sans Mono";

    /// The basic colours from which all others are derived.
    struct Ground {
        QColor window, base, alternate, button, text, faint, disabled, accent, onAccent, link, toolTip;
    };

    const Ground &ground(Theme::Kind kind)
    {
        static const Ground light{0xf3f4f6, 0xffffff, 0xf7f8fa, 0xfafbfc, 0x1c232d, 0x5d6876,
                                  0xa3abb5, 0x2468b2, 0xffffff, 0x1d5fa8, 0xfdfdfe};
        static const Ground dark{0x22262d, 0x191c21, 0x1f2329, 0x2d323a, 0xe2e6eb, 0x98a2af,
                                 0x636c78, 0x2f6fb8, 0xffffff, 0x6fb1f2, 0x2d323a};
        static const Ground contrast{Qt::black, 0x202020, 0x2a2a2a,  0x383838, 0xffffff, 0xe0e0e0,
                                     0x9a9a9a,  0xffd800, Qt::black, 0x7fd4ff, Qt::black};
        switch (kind) {
        case Theme::Kind::Light:
            return light;
        case Theme::Kind::HighContrast:
            return contrast;
        case Theme::Kind::Dark:
            break;
        }
        return dark;
    }

    QColor mixed(const QColor &a, const QColor &b, double share)
    {
        const auto mix = [share](int x, int y) { return int(x + share * (y - x) + 0.5); };
        return {mix(a.red(), b.red()), mix(a.green(), b.green()), mix(a.blue(), b.blue())};
    }

    QFont bundledFont(const char *family, int pixelSize, QFont::Weight weight)
    {
        QFont font(QString::fromLatin1(family));
        font.setPixelSize(pixelSize);
        font.setWeight(weight);
        font.setHintingPreference(QFont::PreferNoHinting);
        font.setStyleStrategy(static_cast<QFont::StyleStrategy>(QFont::PreferAntialias | QFont::NoSubpixelAntialias
                                                                | QFont::NoFontMerging));
        return font;
    }

    double wordScale = 1.0; ///< relative text size of plots

    int scaled(int pixelSize)
    {
        return int(std::lround(wordScale * pixelSize));
    }

    void loadFonts()
    {
        static const bool isLoaded = [] {
            for (const char *file : {"Inter-Regular.otf", "Inter-Bold.otf", "NotoSansMono-Regular.ttf"})
                QFontDatabase::addApplicationFont(QStringLiteral(":/fonts/") + QLatin1String(file));
            return true;
        }();
        Q_UNUSED(isLoaded);
    }

    /// Fusion style with tabs that fit a narrow column, and our own icons.
    class Style : public QProxyStyle
    {
    public:
        Style() : QProxyStyle(QStringLiteral("Fusion")) { setObjectName(styleName()); }
        static QString styleName() { return QStringLiteral("faintline"); }

        int pixelMetric(PixelMetric metric, const QStyleOption *option, const QWidget *widget) const override
        {
            constexpr int tabRoom = 13;
            return metric == PM_TabBarTabHSpace ? tabRoom : QProxyStyle::pixelMetric(metric, option, widget);
        }

        /// Fusion's own dock buttons have few pixels, and light ones in every theme.
        QIcon standardIcon(StandardPixmap kind, const QStyleOption *option, const QWidget *widget) const override
        {
            if (kind == SP_TitleBarCloseButton)
                return icon(QStringLiteral("close"));
            if (kind == SP_TitleBarNormalButton)
                return icon(QStringLiteral("detach"));
            return QProxyStyle::standardIcon(kind, option, widget);
        }

        /// Fusion fills what a heading leaves of its line with the window's colour.
        void drawControl(ControlElement element, const QStyleOption *option, QPainter *painter,
                         const QWidget *widget) const override
        {
            if (element != CE_HeaderEmptyArea)
                return QProxyStyle::drawControl(element, option, painter, widget);
            QStyleOptionHeader empty;
            static_cast<QStyleOption &>(empty) = *option;
            empty.type = QStyleOptionHeader::Type;
            empty.version = QStyleOptionHeader::Version;
            empty.position = QStyleOptionHeader::End;
            QProxyStyle::drawControl(CE_HeaderSection, &empty, painter, widget);
        }

        /// On dark grounds Fusion's outline of an empty box cannot be seen.
        void drawPrimitive(PrimitiveElement element, const QStyleOption *option, QPainter *painter,
                           const QWidget *widget) const override
        {
            QProxyStyle::drawPrimitive(element, option, painter, widget);
            const bool isBox = element == PE_IndicatorCheckBox || element == PE_IndicatorItemViewItemCheck;
            const bool isRing = element == PE_IndicatorRadioButton;
            if ((!isBox && !isRing) || Theme::kind(option->palette) == Theme::Kind::Light)
                return;
            painter->save();
            painter->setRenderHint(QPainter::Antialiasing);
            painter->setPen(QPen(
                mixed(option->palette.color(QPalette::WindowText), option->palette.color(QPalette::Window), 0.5), 1.0));
            painter->setBrush(Qt::NoBrush);
            const QRectF outline = QRectF(option->rect).adjusted(0.5, 0.5, -0.5, -0.5);
            isBox ? painter->drawRoundedRect(outline, 2.0, 2.0) : painter->drawEllipse(outline);
            painter->restore();
        }
    };

    void styleAxis(QwtPlot &plot, QwtAxisId axis, const Theme::Colours &colours)
    {
        QwtScaleWidget &widget = *plot.axisWidget(axis);
        QPalette palette = widget.palette();
        palette.setColor(QPalette::WindowText, mixed(colours.frame, colours.faintText, 0.5)); // ticks
        palette.setColor(QPalette::Text, colours.text);
        widget.setPalette(palette);
        widget.setFont(Theme::plotFont());
        widget.setMargin(0);
        widget.setSpacing(3);
        QwtText title = widget.title();
        title.setFont(Theme::plotTitleFont());
        title.setRenderFlags(Qt::AlignCenter); // never wrapped: that would move the canvas
        title.setColor(colours.faintText);
        widget.setTitle(title);

        QwtScaleDraw &draw = *plot.axisScaleDraw(axis);
        draw.enableComponent(QwtAbstractScaleDraw::Backbone, false);
        draw.setTickLength(QwtScaleDiv::MinorTick, 2);
        draw.setTickLength(QwtScaleDiv::MediumTick, 2);
        draw.setTickLength(QwtScaleDiv::MajorTick, 4);
        draw.setSpacing(3);
        widget.setLabelRotation(draw.labelRotation()); // recomputes the scale's layout
    }

} // namespace

void Theme::prepareEnvironment()
{
    for (const char *name : {"QT_FONT_DPI", "QT_STYLE_OVERRIDE", "QT_QPA_PLATFORMTHEME"})
        qunsetenv(name);
}

void Theme::prepareForPictures()
{
    prepareEnvironment();
    qunsetenv("QT_SCALE_FACTOR");
}

void Theme::apply(Kind kind)
{
    loadFonts();
    QLocale::setDefault(QLocale::c());
    if (!qApp->style() || qApp->style()->objectName() != Style::styleName())
        QApplication::setStyle(new Style);
    const QPalette colours = palette(kind);
    QApplication::setPalette(colours);
    QToolTip::setPalette(colours);
    QApplication::setFont(font());
    QToolTip::setFont(font(12));
    QApplication::setCursorFlashTime(0);
}

QString Theme::nameOf(Kind kind)
{
    switch (kind) {
    case Kind::Light:
        return QStringLiteral("light");
    case Kind::HighContrast:
        return QStringLiteral("contrast");
    case Kind::Dark:
        break;
    }
    return QStringLiteral("dark");
}

Theme::Kind Theme::named(const QString &name)
{
    for (const Kind kind : {Kind::Light, Kind::HighContrast})
        if (name == nameOf(kind))
            return kind;
    return Kind::Dark;
}

QPalette Theme::palette(Kind kind)
{
    const Ground &g = ground(kind);
    const bool isDark = kind != Kind::Light;
    const double lift = kind == Kind::HighContrast ? 0.8 : 0.12; // edges of buttons and fields
    QPalette palette;
    palette.setColor(QPalette::Window, g.window);
    palette.setColor(QPalette::WindowText, g.text);
    palette.setColor(QPalette::Base, g.base);
    palette.setColor(QPalette::AlternateBase, g.alternate);
    palette.setColor(QPalette::Text, g.text);
    palette.setColor(QPalette::PlaceholderText, mixed(g.faint, g.base, 0.2));
    palette.setColor(QPalette::Button, g.button);
    palette.setColor(QPalette::ButtonText, g.text);
    palette.setColor(QPalette::BrightText, Qt::white);
    palette.setColor(QPalette::Highlight, g.accent);
    palette.setColor(QPalette::HighlightedText, g.onAccent);
    palette.setColor(QPalette::Link, g.link);
    palette.setColor(QPalette::LinkVisited, g.link);
    palette.setColor(QPalette::ToolTipBase, g.toolTip);
    palette.setColor(QPalette::ToolTipText, g.text);
    palette.setColor(QPalette::Light, mixed(g.button, Qt::white, isDark ? lift : 1.0));
    palette.setColor(QPalette::Midlight, mixed(g.button, Qt::white, isDark ? 0.5 * lift : 0.5));
    palette.setColor(QPalette::Mid, mixed(g.window, Qt::black, isDark ? 0.25 : 0.18));
    palette.setColor(QPalette::Dark, mixed(g.window, Qt::black, isDark ? 0.45 : 0.35));
    palette.setColor(QPalette::Shadow, mixed(g.window, Qt::black, 0.7));
    for (const QPalette::ColorRole role :
         {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::HighlightedText})
        palette.setColor(QPalette::Disabled, role, g.disabled);
    palette.setColor(QPalette::Disabled, QPalette::Light, Qt::transparent); // Fusion draws the etching of disabled text
                                                                            // with it
    palette.setColor(QPalette::Disabled, QPalette::Highlight, mixed(g.window, g.faint, 0.3));
    return palette;
}

Theme::Kind Theme::kind(const QPalette &palette)
{
    const int lightness = palette.color(QPalette::Window).lightness();
    return lightness == 0 ? Kind::HighContrast : lightness < 128 ? Kind::Dark : Kind::Light;
}

const Theme::Colours &Theme::colours(Kind kind)
{
    const auto make = [](Kind k) {
        const Ground &g = ground(k);
        const bool isDark = k != Kind::Light;
        Colours c;
        c.canvas = isDark ? QColor(0x14171b) : QColor(0xffffff);
        c.grid = isDark ? QColor(255, 255, 255, 26) : QColor(20, 30, 45, 26);
        c.frame = isDark ? QColor(0x3c434d) : QColor(0xc9ced6);
        c.text = g.text;
        c.faintText = g.faint;
        c.accent = isDark ? QColor(0x5a9fe6) : g.accent;
        c.threshold = isDark ? QColor(0xff8a4c) : QColor(0xd0490b);
        c.event = QColor(0x62d6ff);
        c.selectedEvent = QColor(0xffffff);
        c.track = QColor(0x7df0c4);
        c.truth = QColor(0xffffff);
        c.picture = QColor(0x1b1038);
        c.cursor = QColor(0xffffff);
        c.contour = QColor(0x35e0c2);
        c.error = isDark ? QColor(0xff8f85) : QColor(0xb3261e);
        // Near Okabe and Ito's colours, moved apart so that any two differ for every kind of colour vision.
        c.curves[0] = isDark ? QColor(0x5fb0ef) : QColor(0x0a69ac);
        c.curves[1] = isDark ? QColor(0xf0a33c) : QColor(0xc96f00);
        c.curves[2] = isDark ? QColor(0x35c9a0) : QColor(0x00896a);
        c.curves[3] = isDark ? QColor(0xe08fbf) : QColor(0xb14d87);
        c.curves[4] = isDark ? QColor(0xec4d63) : QColor(0xe70046);
        c.curves[5] = isDark ? QColor(0x9d7bff) : QColor(0x5a3fc8);
        c.curves[6] = isDark ? QColor(0xc3d875) : QColor(0x5e6500);
        c.curves[7] = isDark ? QColor(0xd4d8d3) : QColor(0x4e3b36);
        if (k == Kind::HighContrast) {
            c.canvas = Qt::black;
            c.grid = QColor(255, 255, 255, 80);
            c.frame = Qt::white;
            c.accent = g.accent;
            c.threshold = QColor(0xff9d3c);
            c.error = QColor(0xff9d9d);
        }
        return c;
    };
    static const Colours light = make(Kind::Light);
    static const Colours dark = make(Kind::Dark);
    static const Colours contrast = make(Kind::HighContrast);
    switch (kind) {
    case Kind::Light:
        return light;
    case Kind::HighContrast:
        return contrast;
    case Kind::Dark:
        break;
    }
    return dark;
}

const Theme::Colours &Theme::colours(const QWidget &widget)
{
    return colours(kind(widget.palette()));
}

QFont Theme::font(int pixelSize)
{
    return bundledFont(sansFamily, pixelSize, QFont::Normal);
}

QFont Theme::boldFont(int pixelSize)
{
    return bundledFont(sansFamily, pixelSize, QFont::Bold);
}

QFont Theme::monoFont(int pixelSize)
{
    return bundledFont(monoFamily, pixelSize, QFont::Normal);
}

QFont Theme::plotFont()
{
    return font(scaled(11));
}

QFont Theme::plotTitleFont()
{
    return font(scaled(12));
}

QFont Theme::plotHeadingFont()
{
    return boldFont(scaled(13));
}

void Theme::setPlotScale(double scale)
{
    if (std::exchange(wordScale, scale) == scale)
        return;
    QEvent change(QEvent::StyleChange);
    for (QWidget *widget : QApplication::allWidgets())
        if (widget->inherits("QwtPlot") || widget->inherits("faintline::ChartPlot")
            || widget->inherits("faintline::ColourBar") || widget->inherits("faintline::MarkLegend"))
            QApplication::sendEvent(widget, &change);
}

double Theme::plotScale()
{
    return wordScale;
}

void Theme::frame(QwtPlot &plot)
{
    frame(plot, plot.hasFocus());
}

void Theme::frame(QwtPlot &plot, bool hasFocus)
{
    auto *canvas = qobject_cast<QwtPlotCanvas *>(plot.canvas());
    if (!canvas)
        return;
    QPalette palette = canvas->palette();
    palette.setColor(QPalette::WindowText, hasFocus ? colours(plot).accent : colours(plot).frame);
    canvas->setPalette(palette);
}

void Theme::style(QwtPlot &plot)
{
    const Colours &c = colours(plot);
    plot.setAutoFillBackground(true);
    plot.setCanvasBackground(c.canvas);
    if (auto *canvas = qobject_cast<QwtPlotCanvas *>(plot.canvas())) {
        canvas->setFrameStyle(int(QFrame::Box) | int(QFrame::Plain));
        canvas->setLineWidth(1);
        // Our items are cheap to paint; a backing store costs more than it saves.
        canvas->setPaintAttribute(QwtPlotCanvas::BackingStore, false);
    }
    frame(plot);
    for (int axis = 0; axis < QwtAxis::AxisPositions; ++axis)
        styleAxis(plot, QwtAxisId(axis), c);
    plot.plotLayout()->setAlignCanvasToScales(true);
    plot.plotLayout()->setCanvasMargin(0);
    plot.plotLayout()->setSpacing(2);
    plot.setContentsMargins(2, 4, 6, 2);
}

} // namespace faintline
