#include "widgets/Theme.h"

#include "widgets/ColourMap.h"

#include <QApplication>
#include <QDirIterator>
#include <QRawFont>
#include <QRegularExpression>
#include <QSet>
#include <QtTest>

#include <cmath>

using namespace faintline;

/// The look is the same everywhere: bundled fonts that have every sign the program writes, colours one can read.
class tst_Theme : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    void fontsAreTheBundledOnes();
    void fontsHaveEverySignOfTheSources();
    void textCanBeRead_data();
    void textCanBeRead();
    void kindIsFoundInThePalette();
    void mapsAreEven();
    void mapsByName();

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
    /// L* of CIELAB.
    static double lightness(QRgb rgb)
    {
        const double y = luminance(QColor(rgb));
        return y > 0.008856 ? 116.0 * std::cbrt(y) - 16.0 : 903.3 * y;
    }
};

void tst_Theme::fontsAreTheBundledOnes()
{
    QCOMPARE(QRawFont::fromFont(Theme::font()).familyName(), QString("Inter"));
    QCOMPARE(QRawFont::fromFont(Theme::boldFont()).styleName(), QString("Bold"));
    QCOMPARE(QRawFont::fromFont(Theme::monoFont()).familyName(), QString("Noto Sans Mono"));
    QCOMPARE(Theme::font(12).pixelSize(), 12);
}

void tst_Theme::fontsHaveEverySignOfTheSources()
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

void tst_Theme::textCanBeRead_data()
{
    QTest::addColumn<bool>("isDark");
    QTest::newRow("light") << false;
    QTest::newRow("dark") << true;
}

void tst_Theme::textCanBeRead()
{
    QFETCH(bool, isDark);
    const Theme::Kind kind = isDark ? Theme::Kind::Dark : Theme::Kind::Light;
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

void tst_Theme::kindIsFoundInThePalette()
{
    for (const Theme::Kind kind : {Theme::Kind::Light, Theme::Kind::Dark})
        QCOMPARE(Theme::kind(Theme::palette(kind)), kind);
    Theme::apply(Theme::Kind::Dark);
    QCOMPARE(Theme::kind(QApplication::palette()), Theme::Kind::Dark);
    Theme::apply(Theme::Kind::Light);
    QCOMPARE(Theme::kind(QApplication::palette()), Theme::Kind::Light);
}

void tst_Theme::mapsAreEven()
{
    // Lightness rises (or falls) all the way, and no step is much larger than the others.
    for (const QString &name : ColourMap::names()) {
        if (name == "blue-red")
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

void tst_Theme::mapsByName()
{
    QCOMPARE(ColourMap::named("no such map").name(), ColourMap::defaultName());
    QString name = ColourMap::defaultName();
    for (int i = 0; i < ColourMap::names().size(); ++i)
        name = ColourMap::next(name);
    QCOMPARE(name, ColourMap::defaultName());
    const ColourMap &viridis = ColourMap::named("viridis");
    QCOMPARE(viridis.entries().front(), QRgb(0xff440154));
    QCOMPARE(viridis.entries().back(), QRgb(0xfffde725));
    QCOMPARE(viridis.at(-3.0), viridis.at(0.0));
    QCOMPARE(viridis.at(7.0), viridis.at(1.0));
}

QTEST_MAIN(tst_Theme)
#include "tst_Theme.moc"
