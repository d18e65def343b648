#include "signal/Fft.h"
#include "support/test.h"

#include "base/Error.h"
#include "base/Random.h"

#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

using namespace faintline;

namespace {

std::vector<float> noise(int count, std::uint64_t stream)
{
    std::vector<float> values(static_cast<std::size_t>(count));
    Random(1, stream).normals(values, 1.0f);
    return values;
}

std::vector<std::complex<float>> transform(const Fft &fft, const std::vector<float> &samples)
{
    const auto buffer = fft.buffer();
    std::copy(samples.begin(), samples.end(), buffer->input().begin());
    fft.run(*buffer);
    return {buffer->output().begin(), buffer->output().end()};
}

std::complex<double> definition(const std::vector<float> &samples, bool isComplex, int length, int bin)
{
    std::complex<double> sum = 0.0;
    for (int n = 0; n < length; ++n) {
        const auto i = std::size_t(n);
        const std::complex<double> x =
            isComplex ? std::complex<double>(samples[2 * i], samples[2 * i + 1]) : samples[i];
        sum += x * std::polar(1.0, -2.0 * std::numbers::pi * double(long(bin) * n % length) / length);
    }
    return sum;
}

} // namespace

/// The transform against its definition, X(k) = Σ x(n) e^{-2πikn/N}.
class tst_Fft : public QObject
{
    Q_OBJECT

private slots:
    void equalsTheDefinition_data()
    {
        QTest::addColumn<int>("length");
        QTest::addColumn<bool>("isComplex");
        for (int length : {1, 2, 3, 4, 5, 7, 8, 9, 15, 64, 105, 250, 343})
            for (bool isComplex : {false, true})
                QTest::addRow("%d %s", length, isComplex ? "complex" : "real") << length << isComplex;
    }

    void equalsTheDefinition()
    {
        QFETCH(int, length);
        QFETCH(bool, isComplex);
        const Fft fft(length, isComplex ? Fft::Input::Complex : Fft::Input::Real);
        QCOMPARE(fft.binCount(), isComplex ? length : length / 2 + 1);
        const std::vector<float> samples = noise(isComplex ? 2 * length : length, 2);
        const auto bins = transform(fft, samples);
        QCOMPARE(std::ssize(bins), std::ptrdiff_t(fft.binCount()));
        for (int bin = 0; bin < fft.binCount(); ++bin) {
            const std::complex<double> difference =
                std::complex<double>(bins[std::size_t(bin)]) - definition(samples, isComplex, length, bin);
            QVERIFY2(std::abs(difference) < 1e-6 * std::sqrt(length) * 4.0,
                     qPrintable(QString("bin %1: off by %2").arg(bin).arg(std::abs(difference))));
        }
    }

    void fourSamplesByEye()
    {
        const auto real = transform(Fft(4, Fft::Input::Real), {1, 2, 3, 4});
        QCOMPARE(real, (std::vector<std::complex<float>>{{10, 0}, {-2, 2}, {-2, 0}}));
        // i^n turns a quarter a sample: all of it in bin 1.
        const auto turning = transform(Fft(4, Fft::Input::Complex), {1, 0, 0, 1, -1, 0, 0, -1});
        QCOMPARE(turning, (std::vector<std::complex<float>>{{0, 0}, {4, 0}, {0, 0}, {0, 0}}));
    }

    void aToneFallsIntoItsBin()
    {
        // Negative frequencies follow the positive ones: -2 turns in 15 samples is bin 13.
        std::vector<float> samples;
        for (int n = 0; n < 15; ++n) {
            samples.push_back(float(std::cos(-2.0 * std::numbers::pi * 2.0 * n / 15.0)));
            samples.push_back(float(std::sin(-2.0 * std::numbers::pi * 2.0 * n / 15.0)));
        }
        const auto bins = transform(Fft(15, Fft::Input::Complex), samples);
        for (std::size_t bin = 0; bin < 15; ++bin)
            QVERIFY(std::abs(std::abs(bins[bin]) - (bin == 13 ? 15.0f : 0.0f)) < 1e-5f);
    }

    void sameBitsFromEveryThread()
    {
        const Fft fft(1000, Fft::Input::Real);
        const auto expected = transform(fft, noise(1000, 3));
        QCOMPARE(transform(Fft(1000, Fft::Input::Real), noise(1000, 3)), expected); // another plan of the same length
        std::vector<int> equal(4, 0);
        {
            std::vector<std::jthread> threads;
            for (int &mine : equal)
                threads.emplace_back([&] {
                    for (int i = 0; i < 50; ++i) {
                        const Fft own(i + 1, Fft::Input::Complex); // planning beside others' transforms
                        mine += transform(fft, noise(1000, 3)) == expected ? 1 : 0;
                    }
                });
        }
        QCOMPARE(equal, std::vector<int>(4, 50));
    }

    void fastLengths()
    {
        // Every number 2^a·3^b·5^c·7^d up to the limit, by multiplication.
        std::vector<bool> isFast(3000, false);
        isFast[1] = true;
        for (std::size_t n = 1; n < isFast.size(); ++n)
            for (std::size_t prime : {2u, 3u, 5u, 7u})
                if (isFast[n] && n * prime < isFast.size())
                    isFast[n * prime] = true;
        for (int wanted = 1; wanted < 2800; ++wanted) {
            int expected = wanted;
            while (!isFast[std::size_t(expected)])
                ++expected;
            QCOMPARE(Fft::fastLength(wanted), expected);
        }
        QCOMPARE(Fft::fastLength(0), 1);
        QCOMPARE(Fft::fastLength(11), 12);
        QCOMPARE(Fft::fastLength(1021), 1024);
    }

    void noLength()
    {
        QVERIFY_THROWS_EXCEPTION(Error, Fft(0, Fft::Input::Real));
        QVERIFY_THROWS_EXCEPTION(Error, Fft(-4, Fft::Input::Complex));
    }
};

FAINTLINE_TEST(tst_Fft)
#include "tst_Fft.moc"
