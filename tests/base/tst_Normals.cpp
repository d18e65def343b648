#include "base/Random.h"
#include "base/fastmath.h"
#include "support/test.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

using namespace faintline;

namespace {

std::vector<float> normals(std::uint64_t seed, std::uint64_t stream, std::size_t count)
{
    std::vector<float> values(count);
    Random(seed, stream).normals(values, 1.0f);
    return values;
}

double normalLaw(double x)
{
    return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

} // namespace

/// Random::normals, the fast noise: the normal law, the same bytes everywhere, and the functions it is made of.
class tst_Normals : public QObject
{
    Q_OBJECT

private slots:
    void logarithm()
    {
        for (double x = 0x1p-32; x < 1e6; x *= 1.00037) {
            const auto rounded = float(x);
            const double exact = std::log(double(rounded));
            QVERIFY(std::abs(fastLn(rounded) - exact)
                    <= 2e-7 * std::max(std::abs(exact), 0.5 * std::abs(rounded - 1.0) + 1e-30));
        }
        QCOMPARE(fastLn(1.0f), 0.0f);
    }

    void sineAndCosine()
    {
        for (int i = -100000; i <= 100000; ++i) {
            const auto turns = float(i * 5e-6);
            const auto [sine, cosine] = fastSineCosineTurns(turns);
            const double angle = 2.0 * std::numbers::pi * double(turns);
            QVERIFY(std::abs(sine - std::sin(angle)) < 2.5e-7);
            QVERIFY(std::abs(cosine - std::cos(angle)) < 2.5e-7);
        }
    }

    void moments()
    {
        constexpr std::size_t n = 4'000'000;
        std::array<double, 5> moment{};
        for (const float value : normals(1, 2, n))
            for (int power = 1; power <= 4; ++power)
                moment[std::size_t(power)] += std::pow(double(value), power) / n;
        // Five standard errors each: those of the moments are √(1, 2, 15, 96)/√n.
        const double unit = 5.0 / std::sqrt(double(n));
        QVERIFY(std::abs(moment[1]) < unit);
        QVERIFY(std::abs(moment[2] - 1.0) < std::sqrt(2.0) * unit);
        QVERIFY(std::abs(moment[3]) < std::sqrt(15.0) * unit);
        QVERIFY(std::abs(moment[4] - 3.0) < std::sqrt(96.0) * unit);
    }

    void kolmogorovSmirnov()
    {
        std::vector<float> values = normals(3, 4, 1'000'000);
        std::sort(values.begin(), values.end());
        const double n = double(values.size());
        double largest = 0.0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double law = normalLaw(double(values[i]));
            largest = std::max({largest, law - double(i) / n, double(i + 1) / n - law});
        }
        QVERIFY(largest * std::sqrt(n) < 1.95); // exceeded once in a thousand by normal numbers
        QVERIFY(values.front() > -6.8f && values.back() < 6.8f);
        // The tail beyond 4 deviations: 63.3 expected.
        const auto beyond = std::count_if(values.begin(), values.end(), [](float x) { return std::abs(x) > 4.0f; });
        QVERIFY(beyond > 63 - 4 * 8 && beyond < 64 + 4 * 8);
    }

    void neighboursAreUncorrelated()
    {
        const std::vector<float> values = normals(5, 6, 1'000'000);
        for (std::size_t lag = 1; lag <= 5; ++lag) {
            double sum = 0.0;
            double squares = 0.0; // of the squares' correlation, where Box-Muller would fail first
            for (std::size_t i = lag; i < values.size(); ++i) {
                const double a = double(values[i]);
                const double b = double(values[i - lag]);
                sum += a * b;
                squares += (a * a - 1.0) * (b * b - 1.0) / 2.0;
            }
            QVERIFY(std::abs(sum) < 5.0 * 1000.0);
            QVERIFY(std::abs(squares) < 5.0 * 1000.0);
        }
    }

    void cuttingAtMultiplesOfFour()
    {
        const std::vector<float> whole = normals(7, 8, 10007);
        Random random(7, 8);
        std::vector<float> pieces(whole.size());
        for (std::size_t at = 0; at < pieces.size();) {
            const std::size_t length = std::min<std::size_t>(4 * (at % 83 + 1), pieces.size() - at);
            random.normals(std::span(pieces).subspan(at, length), 1.0f);
            at += length;
        }
        QVERIFY(pieces == whole);
    }

    void theBlocksAreThoseOfBits()
    {
        // Box-Muller by the library's functions, from the same words.
        const std::vector<float> fast = normals(9, 10, 4000);
        Random random(9, 10);
        for (std::size_t i = 0; i < fast.size(); i += 2) {
            const double uniform = (random.bits() / 2 + 0.5) * 0x1p-31;
            const std::uint32_t word = random.bits();
            const double angle = 2.0 * std::numbers::pi * double(std::int32_t(word << 2)) * 0x1p-34;
            const double radius = std::sqrt(-2.0 * std::log(uniform)) * (word >> 31 ? -1.0 : 1.0);
            const bool mirrored = (word >> 30) & 1;
            QVERIFY(std::abs(fast[i] - radius * (mirrored ? std::sin(angle) : std::cos(angle))) < 3e-6);
            QVERIFY(std::abs(fast[i + 1] - radius * (mirrored ? std::cos(angle) : std::sin(angle))) < 3e-6);
        }
    }

    void sameBytesOnEveryMachine()
    {
        std::uint64_t hash = 14695981039346656037u; // FNV-1a
        for (const float value : normals(1, 2, 1'000'000))
            hash = (hash ^ std::bit_cast<std::uint32_t>(value)) * 1099511628211u;
        QCOMPARE(hash, std::uint64_t(9879028124917052588u));
    }

    void exponential()
    {
        double worst = 0.0;
        for (float x = -86.9f; x < 87.9f; x += 0.0137f)
            worst = std::max(worst, std::abs(double(fastExp(x)) / std::exp(double(x)) - 1.0));
        QVERIFY(worst < 2e-7);
        QCOMPARE(fastExp(0.0f), 1.0f);
        QCOMPARE(fastExp(1000.0f), fastExp(88.0f));
        QCOMPARE(fastExp(-1000.0f), fastExp(-87.0f));
        QVERIFY(std::isfinite(fastExp(88.0f)) && fastExp(-87.0f) > 0.0f);
    }

    void exponentials()
    {
        std::vector<float> values(200000);
        Random(7, 1).exponentials(values);
        std::vector<float> sorted = values;
        std::sort(sorted.begin(), sorted.end());
        double distance = 0.0;
        for (std::size_t i = 0; i < sorted.size(); ++i) {
            const double law = -std::expm1(-double(sorted[i]));
            const auto n = double(sorted.size());
            distance = std::max({distance, std::abs(law - double(i) / n), std::abs(law - double(i + 1) / n)});
        }
        QVERIFY(distance < 1.95 / std::sqrt(double(sorted.size()))); // Kolmogorov-Smirnov, one in a thousand

        // Cut at multiples of 4 it is the same stream, and each word is one value.
        std::vector<float> parts(1000);
        Random cut(7, 1);
        cut.exponentials(std::span(parts).first(12));
        cut.exponentials(std::span(parts).subspan(12, 400));
        cut.exponentials(std::span(parts).subspan(412));
        QVERIFY(std::equal(parts.begin(), parts.end(), values.begin()));
        Random words(7, 1);
        for (std::size_t i = 0; i < 1000; ++i)
            QVERIFY(std::abs(double(values[i]) - words.exponential()) < 1e-6 * (1.0 + double(values[i])));
    }
};

FAINTLINE_TEST(tst_Normals)
#include "tst_Normals.moc"
