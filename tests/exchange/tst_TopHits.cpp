#include "exchange/TopHits.h"
#include "support/test.h"

#include "analyse/analyse.h"
#include "base/Random.h"
#include "noise/openFrames.h"
#include "plan/slopeUnit.h"
#include "support/errors.h"
#include "support/recordings.h"

#include <boost/math/distributions/normal.hpp>

#include <cmath>
#include <cstring>

using namespace faintline;
using namespace faintline::test;

namespace {

constexpr Index channels = 1 << 16;
constexpr Index frames = 60;

/// A line of a Gaussian profile, as wide in Hz at half its height, whose power adds up to `snr` deviations over
/// √frames.
struct Injected {
    double startHz; ///< from the lowest channel on
    double drift;
    double widthHz;
    double snr;
};

template <class T>
void put(QByteArray &header, const char *key, T value)
{
    const auto length = std::int32_t(std::strlen(key));
    header.append(reinterpret_cast<const char *>(&length), sizeof length);
    header.append(key);
    header.append(reinterpret_cast<const char *>(&value), sizeof value);
}

/// Channels of 1 Hz, frames of 1 s, Gaussian noise of mean 1 and deviation 0.05; a constant in the middle channel.
QByteArray filterbank(const std::vector<Injected> &lines, bool descends)
{
    constexpr double deviation = 0.05;
    constexpr double lowestMHz = 8420.0;
    QByteArray file(4, '\0');
    file[0] = 12;
    file.append("HEADER_START");
    put(file, "nchans", std::int32_t(channels));
    put(file, "nbits", std::int32_t(32));
    put(file, "nifs", std::int32_t(1));
    put(file, "data_type", std::int32_t(1));
    put(file, "fch1", descends ? lowestMHz + double(channels - 1) * 1e-6 : lowestMHz);
    put(file, "foff", descends ? -1e-6 : 1e-6);
    put(file, "tsamp", 1.0);
    put(file, "tstart", 60000.0);
    const QByteArray end("\x0a\0\0\0HEADER_END", 14);
    file.append(end);
    Random random(7, 0);
    std::vector<float> row(static_cast<std::size_t>(channels));
    for (Index frame = 0; frame < frames; ++frame) {
        random.normals(row, float(deviation));
        for (float &value : row)
            value += 1.0f;
        for (const Injected &line : lines) {
            const double centre = line.startHz + line.drift * double(frame);
            const double sigma = line.widthHz / (2.0 * std::sqrt(2.0 * std::log(2.0)));
            for (Index c = std::max<Index>(0, Index(centre) - 60); c < std::min(channels, Index(centre) + 60); ++c)
                row[std::size_t(c)] += float(line.snr * deviation / std::sqrt(double(frames))
                                             * std::exp(-0.5 * std::pow((double(c) - centre) / sigma, 2.0)));
        }
        if (descends)
            std::reverse(row.begin(), row.end());
        row[std::size_t(channels / 2)] += 3.0f;
        file.append(reinterpret_cast<const char *>(row.data()), Index(row.size() * sizeof(float)));
    }
    return file;
}

TopHits tableOf(const std::string &path, double leastSnr)
{
    AnalysisSettings settings = preset("narrowband").settings;
    const NormalisedFramesPointer opened = openFrames(path);
    settings = withSlopesInBins(settings, *opened);
    const auto analysis = analyse(opened, settings);
    return topHits(*analysis, {"test", openPower(path)->info().startUnixSeconds, 0.0}, leastSnr);
}

TopHits observation(double minutes, const std::vector<TopHit> &hits)
{
    TopHits table;
    table.source = "observation";
    table.startUnixSeconds = 1e9 + 60.0 * minutes;
    table.frameSeconds = 18.0;
    table.channelHz = 2.8;
    table.durationSeconds = 288.0;
    table.hits = hits;
    return table;
}

/// A hit of a signal that lies at `hz` in the first observation.
TopHit hitAt(double hz, double drift, double minutes, double snr = 30.0)
{
    const double now = hz + 60.0 * minutes * drift;
    return {drift, snr, now, 0, now, now};
}

} // namespace

/// Drifting narrow-band signals: the search, its table of hits, and cadences on and off target.
class tst_TopHits : public QObject
{
    Q_OBJECT

private slots:
    // Against the library where that reaches, and beyond against the asymptotic series of the normal law's tail.
    void deviates()
    {
        QCOMPARE(gaussianDeviate(0.1), 0.0);
        QCOMPARE(gaussianDeviate(std::log(2.0)), 0.0);
        const boost::math::normal normal;
        for (const double z : {0.5, 3.0, 12.9, 30.0}) {
            const double y = -std::log(boost::math::cdf(boost::math::complement(normal, z)));
            QVERIFY2(std::abs(gaussianDeviate(y) - z) < 1e-9, qPrintable(QString::number(z)));
        }
        for (const double z : {36.0, 100.0, 1e4}) {
            const double series = 1.0 - 1.0 / (z * z) + 3.0 / std::pow(z, 4.0);
            const double y = 0.5 * z * z + std::log(z * std::sqrt(2.0 * M_PI)) - std::log(series);
            QVERIFY2(std::abs(gaussianDeviate(y) - z) < 1e-4, qPrintable(QString::number(gaussianDeviate(y), 'g', 12)));
        }
    }

    void linesAreFound_data()
    {
        QTest::addColumn<bool>("descends");
        QTest::addColumn<double>("sign");
        QTest::newRow("ascending, up") << false << 1.0;
        QTest::newRow("ascending, down") << false << -1.0;
        QTest::newRow("descending, up") << true << 1.0;
        QTest::newRow("descending, down") << true << -1.0;
    }

    // Lines of 1 and 2 Hz at 1.3 and 2.6 Hz/s within a drift step of what was injected, and the constant in the middle
    // channel, which is no receiver's in a cut-out; not a broad one at 3.9 Hz/s that is too weak.
    void linesAreFound()
    {
        QFETCH(bool, descends);
        QFETCH(double, sign);
        const std::vector<Injected> lines{{channels / 5.0, sign * 1.3, 1.0, 100.0},
                                          {channels * 0.8, sign * 2.6, 2.0, 300.0},
                                          {channels / 3.0, sign * 3.9, 40.0, 30.0}};
        writeBytes(path("x.fil"), filterbank(lines, descends));
        TopHits table = tableOf(path("x.fil"), 50.0);
        const double step = 1.0 / double(frames);
        QCOMPARE(table.driftStep(), step);
        const auto isConstant = [step](const TopHit &hit) {
            return std::abs(hit.driftHzPerSecond) <= step
                   && std::abs(hit.startHz - 8420e6 - double(channels / 2)) <= 1.5;
        };
        QCOMPARE(std::erase_if(table.hits, isConstant), std::size_t(1));
        QCOMPARE(table.hits.size(), std::size_t(2));
        for (const std::size_t i : {std::size_t(0), std::size_t(1)}) {
            const Injected &line = lines[1 - i];
            const TopHit &hit = table.hits[i];
            QVERIFY2(std::abs(hit.driftHzPerSecond - line.drift) <= step,
                     qPrintable(QString::number(hit.driftHzPerSecond)));
            QVERIFY2(std::abs(hit.startHz - 8420e6 - line.startHz) <= 1.5,
                     qPrintable(QString::number(hit.startHz, 'f', 2)));
            // A line is seldom in the middle of a channel, and the law of strong power is an extrapolation.
            QVERIFY2(hit.snr > 0.6 * line.snr && hit.snr < 1.1 * line.snr, qPrintable(QString::number(hit.snr)));
        }
    }

    void tableGoesRound()
    {
        TopHits table = observation(0.0, {hitAt(8.4e9, -0.392226, 0.0, 30.6), hitAt(8.5e9, 1.25, 0.0, 25.0)});
        table.hits.front().channel = 739933;
        writeBytes(path("x.dat"), QByteArray::fromStdString(topHitsText(table)));
        const TopHits back = readTopHits(path("x.dat"));
        QVERIFY(std::abs(*back.startUnixSeconds - *table.startUnixSeconds) < 1e-4);
        QCOMPARE(back.frameSeconds, 18.0);
        QCOMPARE(back.channelHz, 2.8);
        QCOMPARE(back.durationSeconds, 288.0);
        QCOMPARE(back.hits.size(), std::size_t(2));
        QCOMPARE(back.hits[0].driftHzPerSecond, -0.392226);
        QCOMPARE(back.hits[0].channel, Index(739933));
        QCOMPARE(back.hits[1].startHz, 8.5e9);
    }

    // As turboSETI writes it.
    void otherTables()
    {
        writeBytes(path("v.dat"),
                   "# -------------------------- o --------------------------\n# File ID: Voyager1.h5 \n"
                   "# Source:Voyager1\n# MJD: 57650.782094907408\tRA: 17h10m03.984s\tDEC: 12d10m58.8s\n"
                   "# DELTAT:  18.253611\tDELTAF(Hz):  -2.793968\tmax_drift_rate:   4.000000\tobs_length: "
                   "292.057776\n# Top_Hit_# \tDrift_Rate \tSNR \n"
                   "001\t -0.392226\t 30.612128\t   8419.319368\t   8419.319368\t739933\t   8419.319779\t   "
                   "8419.318963\t0.0\t      0.000000\t0\t858\t\n");
        const TopHits table = readTopHits(path("v.dat"));
        QCOMPARE(table.source, std::string("Voyager1"));
        QCOMPARE(table.channelHz, 2.793968);
        QCOMPARE(table.hits.at(0).snr, 30.612128);
        QCOMPARE(table.hits.at(0).lowHz, 8419318963.0);
    }

    void badTables_data()
    {
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<QString>("words");
        const QByteArray head = "# DELTAT: 18 DELTAF(Hz): 2 obs_length: 100\n";
        QTest::newRow("empty") << QByteArray() << "must give DELTAT";
        QTest::newRow("no length") << QByteArray("# DELTAT: 18 DELTAF(Hz): 2\n") << "must give DELTAT";
        QTest::newRow("lengths of 0") << QByteArray("# DELTAT: 0 DELTAF(Hz): 0 obs_length: nan\n")
                                      << "must give DELTAT";
        QTest::newRow("few columns") << head + "001 1 2 3\n"
                                     << "line 2: is not a row of a table of hits";
        QTest::newRow("words") << head + "a b c d e f g h i j k l\n"
                               << "line 2: is not a row";
        QTest::newRow("infinite") << head + "1 inf 1 1 1 1 1 1 1 1 1 1\n"
                                  << "line 2: is not a row";
        QTest::newRow("a long line") << head + QByteArray(100000, '1') << "is not a table of at most a million hits";
    }

    void badTables()
    {
        QFETCH(QByteArray, text);
        QFETCH(QString, words);
        writeBytes(path("bad.dat"), text);
        const std::string said = errorOf([&] { readTopHits(path("bad.dat")); });
        QVERIFY2(contains(said, words.toStdString()) && said.find('\n') == std::string::npos, said.c_str());
    }

    // Three on target, three off: what drifts on through all, what is in those on target only, what is missing once.
    void cadence()
    {
        std::vector<TopHits> all;
        for (int i = 0; i < 6; ++i) {
            const double minutes = 5.0 * i;
            std::vector<TopHit> hits{hitAt(1.0e9, 0.3, minutes)}; // interference: always
            if (i % 2 == 0)
                hits.push_back(hitAt(1.1e9, -0.2, minutes));
            if (i % 2 == 0 && i < 4)
                hits.push_back(hitAt(1.2e9, 0.1, minutes));
            if (i % 2 == 0)
                hits.push_back(hitAt(1.3e9, 0.0, minutes));
            if (i % 2 == 0 || i == 5)
                hits.push_back(hitAt(1.4e9, 0.05, minutes));
            all.push_back(observation(minutes, hits));
        }
        all[2].hits.push_back(hitAt(1.1e9 + 3.0, -0.2, 10.0, 55.0)); // beside it, and stronger
        all[4].hits[2].startHz += 400.0;                             // 1.3 GHz: jumps
        const std::vector<CadenceEvent> events = findCadence(all);
        QCOMPARE(events.size(), std::size_t(1));
        QCOMPARE(events[0].hits.size(), std::size_t(3));
        QCOMPARE(events[0].hits[0].startHz, 1.1e9);
        QCOMPARE(events[0].hits[1].snr, 55.0);
        QCOMPARE(findCadence(all, 500.0).size(), std::size_t(2));
        std::stop_source stop;
        stop.request_stop();
        RunContext stopped;
        stopped.stop = stop.get_token();
        QVERIFY_EXCEPTION_THROWN(findCadence(all, 0.0, stopped), Cancelled);
        QVERIFY(cadenceCsv(events).starts_with(
            "event,observation,frequency_hz,drift_hz_per_s,snr\n1,1,1.1e+09,-0.2,30\n1,3,"));
    }

    void cadencesThatAreNone()
    {
        QVERIFY(contains(errorOf([] { findCadence({observation(0.0, {})}); }), "needs at least two observations"));
        TopHits timeless = observation(0.0, {});
        timeless.startUnixSeconds.reset();
        QVERIFY(contains(errorOf([&] { findCadence({timeless, timeless}); }), "does not give its start time"));
    }

private:
    std::string path(const char *name) const { return m_folder.filePath(QString::fromLatin1(name)).toStdString(); }

    QTemporaryDir m_folder;
};

FAINTLINE_TEST(tst_TopHits)
#include "tst_TopHits.moc"
