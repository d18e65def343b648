#include "signal/formats/SigprocFile.h"
#include "support/test.h"

#include "support/errors.h"

#include <cmath>

using namespace faintline;
using namespace faintline::test;

namespace {

/// A filterbank that holds 1 everywhere.
class Ones final : public Filterbank
{
public:
    using Filterbank::Header;
    explicit Ones(const Header &header)
    {
        m_info.path = "x.fil";
        setAxes(header);
    }

private:
    void readStored(const PowerPart & /*part*/, Index /*first*/, std::span<float> out) const override
    {
        std::ranges::fill(out, 1.0f);
    }
};

Ones::Header header(double foff)
{
    return {1420.0, foff, 0.5, 58849.25, 8, 100};
}

PowerInfo axesOf(const Ones::Header &header)
{
    return Ones(header).info();
}

} // namespace

/// Axes of filterbanks in sigproc's units, and the channels of a receiver's DC offset.
class tst_Filterbank : public QObject
{
    Q_OBJECT

private slots:
    void frequenciesAscend()
    {
        for (const double foff : {0.25, -0.25}) { // MHz
            const Axis axis = axesOf(header(foff)).frequency;
            QCOMPARE(axis.unit, std::string("Hz"));
            QCOMPARE(axis.count, Index(8));
            QCOMPARE(axis.step, 0.25e6);
            for (int channel = 0; channel < 8; ++channel) { // by the file's definition: fch1 + channel · foff
                const double hz = (1420.0 + channel * foff) * 1e6;
                QVERIFY(std::abs(axis.value(foff > 0.0 ? channel : 7 - channel) - hz) < 1e-6);
            }
        }
    }

    void timeIsTheMiddleOfAFrame()
    {
        const Axis axis = axesOf(header(1.0)).time;
        QCOMPARE(axis.value(0.0), 0.25);
        QCOMPARE(axis.value(99.0), 49.75);
        QCOMPARE(axis.count, Index(100));
    }

    void theStartIsADate()
    {
        const QDateTime date(QDate(2020, 1, 1), QTime(6, 0), QTimeZone::utc()); // MJD 58849.25
        QCOMPARE(axesOf(header(1.0)).startUnixSeconds, std::optional(double(date.toSecsSinceEpoch())));
        Ones::Header unknown = header(1.0);
        for (const double mjd : {0.0, 40587.0, -5.0, 1e7, std::nan("")}) {
            unknown.tstart = mjd;
            QVERIFY(!axesOf(unknown).startUnixSeconds);
        }
    }

    void refusals_data()
    {
        QTest::addColumn<double>("fch1");
        QTest::addColumn<double>("foff");
        QTest::addColumn<double>("tsamp");
        QTest::addColumn<QByteArray>("why");
        QTest::newRow("no spacing") << 1420.0 << 0.0 << 1.0 << QByteArray("foff = 0");
        QTest::newRow("far spacing") << 1420.0 << -2e9 << 1.0 << QByteArray("foff = -2e+09");
        QTest::newRow("unknown spacing") << 1420.0 << std::nan("") << 1.0 << QByteArray("foff");
        QTest::newRow("far channel") << 2e9 << 1.0 << 1.0 << QByteArray("fch1 = 2e+09");
        QTest::newRow("no time") << 1420.0 << 1.0 << 0.0 << QByteArray("tsamp = 0");
        QTest::newRow("unknown time") << 1420.0 << 1.0 << std::nan("") << QByteArray("tsamp");
    }

    void refusals()
    {
        QFETCH(double, fch1);
        QFETCH(double, foff);
        QFETCH(double, tsamp);
        QFETCH(QByteArray, why);
        const std::string error = errorOf([&] { axesOf({fch1, foff, tsamp, 0.0, 8, 100}); });
        QVERIFY2(contains(error, "x.fil: " + why.toStdString()), error.c_str());
    }

    void dcIsInTheMiddleOfEachCoarseChannel_data()
    {
        QTest::addColumn<Index>("channels");
        QTest::addColumn<bool>("descends");
        QTest::addColumn<QList<Index>>("fileChannels"); // counted as in the file
        const Index coarse = Index(1) << 20;
        for (const bool descends : {false, true}) {
            const char *order = descends ? "descending" : "ascending";
            QTest::addRow("three coarse channels, %s", order)
                << 3 * coarse << descends << QList<Index>{coarse / 2, 3 * coarse / 2, 5 * coarse / 2};
            for (const Index cut : {Index(65536), Index(1) << 19, coarse - 1, 3 * coarse / 2})
                QTest::addRow("%lld channels cut out, %s", static_cast<long long>(cut), order)
                    << cut << descends << QList<Index>{};
        }
    }

    void dcIsInTheMiddleOfEachCoarseChannel()
    {
        QFETCH(Index, channels);
        QFETCH(bool, descends);
        QFETCH(QList<Index>, fileChannels);
        const Ones ones({1420.0, descends ? -1.0 : 1.0, 1.0, 0.0, channels, 2});
        QList<Index> found;
        constexpr Index part = 50000; // read part by part, two frames of each
        for (Index first = 0; first < channels; first += part) {
            const Index cells = std::min(part, channels - first);
            std::vector<float> values(std::size_t(2 * cells));
            ones.read({0, 0, 2, first, cells, true}, values);
            QVERIFY(values == std::vector<float>(values.size(), 1.0f));
            ones.read({0, 0, 2, first, cells}, values);
            for (Index i = 0; i < cells; ++i) {
                QCOMPARE(std::isnan(values[std::size_t(i)]), std::isnan(values[std::size_t(cells + i)]));
                if (std::isnan(values[std::size_t(i)]))
                    found << (descends ? channels - 1 - (first + i) : first + i);
            }
        }
        std::sort(found.begin(), found.end());
        QCOMPARE(found, fileChannels);
    }
};

FAINTLINE_TEST(tst_Filterbank)
#include "tst_Filterbank.moc"
