#include "support/test.h"
#include "widgets/plot/ColourMap.h"

#include <QColor>

#include <cmath>
#include <limits>

using namespace faintline;

namespace {

/// Relative luminance of an sRGB colour, 0 … 1 (IEC 61966-2-1).
double luminance(QRgb colour)
{
    const auto linear = [](int byte) {
        const double share = byte / 255.0;
        return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(qRed(colour)) + 0.7152 * linear(qGreen(colour)) + 0.0722 * linear(qBlue(colour));
}

} // namespace

/// The colours of values: which is more can be told by brightness alone, so also without colour vision.
class tst_ColourMap : public QObject
{
    Q_OBJECT

private slots:
    void namesLeadToTheirMaps()
    {
        for (const QString &name : ColourMap::names())
            QCOMPARE(ColourMap::named(name).name(), name);
        QCOMPARE(QSet<QString>(ColourMap::names().begin(), ColourMap::names().end()).size(), ColourMap::names().size());
        QVERIFY(ColourMap::names().contains(ColourMap::defaultName()));
        QCOMPARE(ColourMap::named("viridis").entries().front(), QRgb(0xff440154));
        QCOMPARE(ColourMap::named("viridis").entries().back(), QRgb(0xfffde725));
    }

    void anUnknownNameIsTheDefault()
    {
        for (const char *name : {"", "Inferno", "no such map"})
            QCOMPARE(ColourMap::named(name).name(), ColourMap::defaultName());
    }

    void nextGoesRound()
    {
        QString name = ColourMap::defaultName();
        QStringList visited;
        for (qsizetype i = 0; i < ColourMap::names().size(); ++i) {
            visited << name;
            name = ColourMap::next(name);
        }
        QCOMPARE(visited, ColourMap::names());
        QCOMPARE(name, ColourMap::defaultName());
        QCOMPARE(ColourMap::next("no such map"), ColourMap::defaultName());
    }

    void moreIsBrighter_data()
    {
        QTest::addColumn<QString>("name");
        for (const char *name : {"inferno", "magma", "viridis", "cividis", "grey"})
            QTest::newRow(name) << QString(name);
    }

    void moreIsBrighter()
    {
        QFETCH(QString, name);
        const auto &entries = ColourMap::named(name).entries();
        for (std::size_t i = 8; i < entries.size(); ++i) // neighbours may round alike
            QVERIFY2(luminance(entries[i]) > luminance(entries[i - 8]), qPrintable(QString::number(i)));
        QVERIFY(luminance(entries.back()) - luminance(entries.front()) > 0.6);
    }

    void divergingMapsTurnInTheMiddle_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<double>("sign"); // of the change of luminance towards the middle
        QTest::newRow("blue-red") << QString("blue-red") << 1.0;
        QTest::newRow("ice-fire") << QString("ice-fire") << -1.0;
    }

    void divergingMapsTurnInTheMiddle()
    {
        QFETCH(QString, name);
        QFETCH(double, sign);
        const ColourMap &map = ColourMap::named(name);
        for (double share = 0.06; share <= 0.5; share += 0.06) {
            QVERIFY(sign * (luminance(map.at(share)) - luminance(map.at(share - 0.06))) > 0.0);
            QVERIFY(sign * (luminance(map.at(1.0 - share)) - luminance(map.at(1.06 - share))) > 0.0);
        }
        // The middle has next to no colour, the ends are of two.
        QVERIFY(QColor(map.at(0.5)).hsvSaturationF() < 0.4);
        QVERIFY(qBlue(map.at(0.2)) > qRed(map.at(0.2)));
        QVERIFY(qBlue(map.at(0.8)) < qRed(map.at(0.8)));
    }

    void neighbouringStepsAreSmall()
    {
        for (const QString &name : ColourMap::names()) {
            const auto &entries = ColourMap::named(name).entries();
            for (std::size_t i = 1; i < entries.size(); ++i) {
                const QColor a(entries[i - 1]), b(entries[i]);
                const int step = std::max(
                    {std::abs(a.red() - b.red()), std::abs(a.green() - b.green()), std::abs(a.blue() - b.blue())});
                QVERIFY2(step <= 4, qPrintable(QStringLiteral("%1 at %2: %3").arg(name).arg(i).arg(step)));
            }
        }
    }

    void greyIsGreyAndPaperItsReverse()
    {
        const ColourMap &grey = ColourMap::named("grey"), &paper = ColourMap::named("paper");
        for (int i = 0; i < 256; ++i) {
            QCOMPARE(grey.entries()[std::size_t(i)], qRgb(i, i, i));
            QCOMPARE(paper.entries()[std::size_t(i)], qRgb(255 - i, 255 - i, 255 - i));
            QCOMPARE(grey.at(i / 255.0), qRgb(i, i, i));
        }
    }

    void positionsBeyondTheEndsAreTheEnds()
    {
        constexpr double inf = std::numeric_limits<double>::infinity();
        const ColourMap &map = ColourMap::named("viridis");
        for (const double low : {-1e-9, -5.0, -1e300, -inf})
            QCOMPARE(map.at(low), map.entries().front());
        for (const double high : {1.0 + 1e-9, 5.0, 1e300, inf})
            QCOMPARE(map.at(high), map.entries().back());
    }

    void aPositionThatIsNoNumberIsTheLowEnd()
    {
        const ColourMap &map = ColourMap::named("viridis");
        QCOMPARE(map.at(std::numeric_limits<double>::quiet_NaN()), map.entries().front());
    }
};

FAINTLINE_WINDOW_TEST(tst_ColourMap)
#include "tst_ColourMap.moc"
