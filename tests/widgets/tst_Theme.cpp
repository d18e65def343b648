#include "support/test.h"
#include "widgets/base/Theme.h"

#include "pictures.h"
#include "widgets/base/ReadOut.h"
#include "widgets/base/icon.h"
#include "widgets/events/EventTable.h"
#include "widgets/forms/SettingsForm.h"
#include "widgets/plot/BarPlot.h"
#include "widgets/plot/ChartPlot.h"
#include "widgets/plot/ColourMap.h"
#include "widgets/plot/ExceedancePlot.h"
#include "widgets/plot/StripPlot.h"
#include "widgets/plot/WalkPlot.h"
#include "widgets/waterfall/ColourBar.h"
#include "widgets/waterfall/OverviewStrip.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QApplication>
#include <QCheckBox>
#include <QGridLayout>
#include <QRadioButton>
#include <QRawFont>

#include <algorithm>
#include <array>
#include <cmath>

using namespace faintline;

/// One of each widget, filled, in one window.
class Sample : public QWidget
{
public:
    Sample()
    {
        const auto picture = test::countingPicture(4, 30);
        const Axis hz = test::hzAxis(30);
        const Viewport::Box box = WaterfallView::extents(picture->time(), hz);
        m_viewport.setExtents(box.time, box.frequency);
        m_viewport.setCursor({1.5, 120.0});
        auto *view = new WaterfallView("Statistic");
        view->setViewport(&m_viewport);
        view->setPicture(picture, hz);
        view->setThreshold(15.0);
        auto *bar = new ColourBar;
        bar->attach(view);
        auto *strip = new StripPlot("D (nat)");
        strip->setViewport(&m_viewport);
        strip->setProfile("D", picture, hz);
        strip->setLevel(12.0, "threshold");
        auto *calibration = new Calibration;
        calibration->levelStep = 5.0;
        calibration->above = {0.5, 0.05, 0.005};
        auto *exceedance = new ExceedancePlot;
        exceedance->setCalibration(std::shared_ptr<const Calibration>(calibration), 1e6);
        auto *overview = new OverviewStrip;
        overview->setViewport(&m_viewport);
        overview->setPicture(picture, hz);
        auto *form = new SettingsForm;
        form->setError("model.snr", "must be larger");
        auto *table = new EventTable;
        table->setEvents({test::event(1, 0.0, 2.0, 110.0)});
        auto *chart = new ChartPlot;
        chart->setChart({"Detection",
                         "SNR (dB)",
                         "Pd",
                         false,
                         false,
                         {{"one", Curve::Kind::Measured, {{1, 0.2, {0.1, 0.3}}, {10, 0.6, {0.5, 0.7}}}}}});
        auto *bars = new BarPlot;
        bars->setBars({{"all", 1, {2.0, 1.0}}}, 1);
        auto *walks = new WalkPlot;
        walks->setTest({1e-3, 1e-3, 10}, Index(6));
        walks->setWalks({{{1.0, 3.0, 5.0, 8.0}, SprtDecision::H1, true, false}});
        auto *layout = new QGridLayout(this);
        const std::initializer_list<QWidget *> widgets{view,  bar,         strip, exceedance, overview, form,
                                                       table, new ReadOut, chart, bars,       walks};
        int i = 0;
        for (QWidget *widget : widgets) {
            layout->addWidget(widget, i / 2, i % 2);
            ++i;
        }
        resize(900, 900);
    }

private:
    Viewport m_viewport;
};

/// The look is the same everywhere: bundled fonts that have every sign the program writes, colours one can read.
class tst_Theme : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    void fontsAreTheBundledOnes()
    {
        QCOMPARE(QRawFont::fromFont(Theme::font()).familyName(), QString("Inter"));
        QCOMPARE(QRawFont::fromFont(Theme::boldFont()).styleName(), QString("Bold"));
        QCOMPARE(QRawFont::fromFont(Theme::monoFont()).familyName(), QString("Noto Sans Mono"));
        QCOMPARE(Theme::font(12).pixelSize(), 12);
    }

    void fontsHaveEverySignOfTheSources()
    {
        static const QRegularExpression comment("//[^\n]*"), literal("\"(?:[^\"\\\\\n]|\\\\.)*\"");
        QSet<char32_t> signs;
        for (const char *folder : {"widgets", "app", "core"}) {
            QDirIterator files(QStringLiteral(FAINTLINE_SOURCE_DIR "/") + folder, {"*.cpp"}, QDir::Files,
                               QDirIterator::Subdirectories);
            while (files.hasNext()) {
                QFile file(files.next());
                QVERIFY(file.open(QIODevice::ReadOnly));
                const QString source = QString::fromUtf8(file.readAll()).remove(comment);
                for (auto literals = literal.globalMatch(source); literals.hasNext();)
                    for (const char32_t sign : literals.next().captured().toUcs4())
                        if (sign > 0x7e)
                            signs.insert(sign);
            }
        }
        QVERIFY(signs.contains(U'·'));
        const QRawFont regular = QRawFont::fromFont(Theme::font()), bold = QRawFont::fromFont(Theme::boldFont());
        for (const char32_t sign : signs)
            QVERIFY2(regular.supportsCharacter(sign) && bold.supportsCharacter(sign),
                     qPrintable(QString("U+%1 %2").arg(uint(sign), 4, 16).arg(QString::fromUcs4(&sign, 1))));
        const QRawFont mono = QRawFont::fromFont(Theme::monoFont());
        for (const char32_t sign : U"−·⁻⁰¹²³⁴⁵⁶⁷⁸⁹–∞0123456789")
            QVERIFY(sign == 0 || mono.supportsCharacter(sign));
    }

    void textCanBeRead_data()
    {
        QTest::addColumn<Theme::Kind>("kind");
        QTest::newRow("light") << Theme::Kind::Light;
        QTest::newRow("dark") << Theme::Kind::Dark;
        QTest::newRow("high contrast") << Theme::Kind::HighContrast;
    }

    void textCanBeRead()
    {
        QFETCH(Theme::Kind, kind);
        const QPalette palette = Theme::palette(kind);
        const Theme::Colours &colours = Theme::colours(kind);
        QVERIFY(contrast(palette.color(QPalette::WindowText), palette.color(QPalette::Window)) > 7.0);
        QVERIFY(contrast(palette.color(QPalette::Text), palette.color(QPalette::Base)) > 7.0);
        QVERIFY(contrast(palette.color(QPalette::ButtonText), palette.color(QPalette::Button)) > 7.0);
        QVERIFY(contrast(palette.color(QPalette::HighlightedText), palette.color(QPalette::Highlight)) > 4.0);
        QVERIFY(contrast(palette.color(QPalette::ToolTipText), palette.color(QPalette::ToolTipBase)) > 7.0);
        QVERIFY(contrast(colours.faintText, palette.color(QPalette::Window)) > 4.5);
        QVERIFY(contrast(colours.error, palette.color(QPalette::Window)) > 4.5);
        QVERIFY(contrast(colours.threshold, colours.canvas) > 4.5);
        for (const QColor &curve : colours.curves)
            QVERIFY(contrast(curve, colours.canvas) > 3.0);
    }

    void anEmptyBoxIsSeen_data() { textCanBeRead_data(); }

    /// The outline of a box that is not checked stands out from the ground.
    void anEmptyBoxIsSeen()
    {
        QFETCH(Theme::Kind, kind);
        Theme::apply(kind);
        QCheckBox box;
        QRadioButton button;
        for (QAbstractButton *each : {static_cast<QAbstractButton *>(&box), static_cast<QAbstractButton *>(&button)}) {
            each->resize(each->sizeHint());
            const QImage picture = each->grab().toImage();
            const QColor ground = each->palette().color(QPalette::Window);
            double best = 0.0;
            for (int x = 0; x < 8; ++x) // its left edge, at half its height
                best = std::max(best, contrast(picture.pixelColor(x, picture.height() / 2), ground));
            const double least = kind == Theme::Kind::Light ? 1.5 : 3.0;
            QVERIFY2(best > least, qPrintable(QString::number(best)));
        }
        Theme::apply(Theme::Kind::Light);
    }

    /// What would change pictures is taken away, but not the scale that a user has chosen.
    void theUsersScaleIsRespected()
    {
        qputenv("QT_SCALE_FACTOR", "1.5");
        qputenv("QT_FONT_DPI", "120");
        Theme::prepareEnvironment();
        QCOMPARE(qgetenv("QT_SCALE_FACTOR"), QByteArray("1.5"));
        QVERIFY(!qEnvironmentVariableIsSet("QT_FONT_DPI"));
        qunsetenv("QT_SCALE_FACTOR");
    }

    void curvesAreToldApart_data() { textCanBeRead_data(); }

    /// Any two curves of a chart differ clearly, and also for those who do not see red or green.
    void curvesAreToldApart()
    {
        QFETCH(Theme::Kind, kind);
        const std::array<double, 9> all{1, 0, 0, 0, 1, 0, 0, 0, 1};
        const std::array<double, 9> noRed{0.152286, 1.052583,  -0.204868, 0.114503, 0.786281,
                                          0.099216, -0.003882, -0.048116, 1.051998};
        const std::array<double, 9> noGreen{0.367322, 0.860646,  -0.227968, 0.280085, 0.672501,
                                            0.047413, -0.011820, 0.042940,  0.968881};
        const auto &curves = Theme::colours(kind).curves;
        for (std::size_t i = 0; i < std::size(curves); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const auto apart = [&](const auto &eye) { return difference(curves[i], curves[j], eye); };
                QVERIFY2(apart(all) > 40.0 && apart(noRed) > 12.0 && apart(noGreen) > 12.0,
                         qPrintable(QString("%1 and %2: %3, %4, %5")
                                        .arg(j + 1)
                                        .arg(i + 1)
                                        .arg(apart(all))
                                        .arg(apart(noRed))
                                        .arg(apart(noGreen))));
            }
    }

    void kindIsFoundInThePalette()
    {
        for (const Theme::Kind kind : {Theme::Kind::Light, Theme::Kind::Dark, Theme::Kind::HighContrast}) {
            QCOMPARE(Theme::kind(Theme::palette(kind)), kind);
            QCOMPARE(Theme::named(Theme::nameOf(kind)), kind);
        }
        Theme::apply(Theme::Kind::Dark);
        QCOMPARE(Theme::kind(QApplication::palette()), Theme::Kind::Dark);
        Theme::apply(Theme::Kind::Light);
        QCOMPARE(Theme::kind(QApplication::palette()), Theme::Kind::Light);
    }

    void mapsAreEven()
    {
        // Lightness rises (or falls) all the way, and no step is much larger than the others.
        for (const QString &name : ColourMap::names()) {
            if (name == "blue-red" || name == "ice-fire") // light or dark in the middle
                continue;
            const ColourMap &map = ColourMap::named(name);
            const double whole = lightness(map.at(1.0)) - lightness(map.at(0.0));
            for (int i = 0; i < 16; ++i) {
                const double step = lightness(map.at((i + 1) / 16.0)) - lightness(map.at(i / 16.0));
                QVERIFY2(step / whole > 0.0 && step / whole < 0.16, qPrintable(name + QString::number(i)));
            }
            QVERIFY(std::abs(whole) > 60.0);
        }
    }

    void aChangeOfThemeLeavesNothingBehind()
    {
        const auto settled = [](QWidget &widget) { // scroll bars follow their layouts some events later
            widget.show();
            QTest::qWait(50);
            return widget.grab().toImage();
        };
        Theme::apply(Theme::Kind::Dark);
        Sample fresh;
        const QImage expected = settled(fresh);
        fresh.hide();

        Theme::apply(Theme::Kind::Light);
        Sample changed;
        QVERIFY(settled(changed) != expected);
        Theme::apply(Theme::Kind::Dark);
        const QImage actual = settled(changed);
        if (actual != expected) {
            expected.save("expected.png");
            actual.save("actual.png");
        }
        QVERIFY2(actual == expected, "see expected.png and actual.png");
        Theme::apply(Theme::Kind::Light);
    }

    void iconsFollowTheTheme()
    {
        const QIcon run = icon("run");
        QVERIFY(!run.isNull());
        QVERIFY(icon("no such icon").isNull());
        const auto strongest = [&] {
            const QImage image = run.pixmap(24, 24).toImage();
            QColor result(Qt::transparent);
            for (int y = 0; y < image.height(); ++y)
                for (int x = 0; x < image.width(); ++x)
                    if (const QColor colour = image.pixelColor(x, y); colour.alpha() > result.alpha())
                        result = colour;
            return result.lightness();
        };
        Theme::apply(Theme::Kind::Dark);
        QVERIFY(strongest() > 200);
        Theme::apply(Theme::Kind::Light);
        QVERIFY(strongest() < 60);
    }

private:
    static double luminance(const QColor &colour)
    {
        const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
        return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) + 0.0722 * linear(colour.blueF());
    }
    /// WCAG's contrast ratio.
    static double contrast(const QColor &a, const QColor &b)
    {
        const auto [low, high] = std::minmax({luminance(a), luminance(b)});
        return (high + 0.05) / (low + 0.05);
    }
    /// CIELAB of a colour as it looks without red or green cones (Machado 2009; D65).
    static std::array<double, 3> lab(const QColor &colour, const std::array<double, 9> &eye)
    {
        const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
        const std::array rgb{linear(colour.redF()), linear(colour.greenF()), linear(colour.blueF())};
        std::array<double, 3> seen{};
        for (std::size_t i = 0; i < 3; ++i)
            seen[i] = std::clamp(eye[3 * i] * rgb[0] + eye[3 * i + 1] * rgb[1] + eye[3 * i + 2] * rgb[2], 0.0, 1.0);
        const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
        const double x = f((0.4124 * seen[0] + 0.3576 * seen[1] + 0.1805 * seen[2]) / 0.9505);
        const double y = f(0.2126 * seen[0] + 0.7152 * seen[1] + 0.0722 * seen[2]);
        const double z = f((0.0193 * seen[0] + 0.1192 * seen[1] + 0.9505 * seen[2]) / 1.089);
        return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
    }
    static double difference(const QColor &a, const QColor &b, const std::array<double, 9> &eye)
    {
        const auto p = lab(a, eye), q = lab(b, eye);
        return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
    }
    /// L* of CIELAB.
    static double lightness(QRgb rgb)
    {
        const double y = luminance(QColor(rgb));
        return y > 0.008856 ? 116.0 * std::cbrt(y) - 16.0 : 903.3 * y;
    }
};

FAINTLINE_WINDOW_TEST(tst_Theme)
#include "tst_Theme.moc"
