#include "base/Random.h"
#include "recursion/jointPaths.h"
#include "support/test.h"

#include <algorithm>
#include <cmath>
#include <functional>

using namespace faintline;

namespace {

const Likelihood likelihood(LikelihoodKind::Rice, 4.0);

/// Exponential noise of mean 1 around fixed centres, with lines of constant power in one cell each.
PathStrip strip(Index frames, Index halfWidth, const std::vector<std::function<Index(Index)>> &lines, double power,
                std::uint64_t seed)
{
    Random random(seed, 0);
    PathStrip result;
    result.firstFrame = 10;
    result.halfWidth = halfWidth;
    result.centres.assign(std::size_t(frames), 100);
    for (Index at = 0; at < frames; ++at)
        for (Index cell = 100 - halfWidth; cell <= 100 + halfWidth; ++cell) {
            double re = std::sqrt(0.5) * random.normal();
            const double im = std::sqrt(0.5) * random.normal();
            for (const auto &line : lines)
                re += line(at) == cell ? std::sqrt(power) : 0.0;
            result.y.push_back(float(re * re + im * im));
        }
    return result;
}

/// The largest score of any pair of paths, over all cells and rates, from the definition.
double bestByEnumeration(const PathStrip &strip, Index apart)
{
    const Index width = strip.width();
    const auto displacement = [](Index rate, Index at) { // into frame `at`
        const auto rounded = [&](Index step) { return Index(std::floor(double(rate) * double(step) / 8.0 + 0.5)); };
        return rounded(at) - rounded(at - 1);
    };
    struct Path {
        std::vector<Index> cells;
        Index rate;
        double price;
    };
    std::vector<Path> paths;
    for (Index cell = 0; cell < width; ++cell)
        for (Index rate = -4; rate <= 4; ++rate)
            paths.push_back({{cell}, rate, 0.0});
    for (Index at = 1; at < strip.frameCount(); ++at) {
        std::vector<Path> longer;
        for (const Path &path : paths)
            for (Index rate = std::max<Index>(-4, path.rate - 1); rate <= std::min<Index>(4, path.rate + 1); ++rate) {
                const Index cell = path.cells.back() + displacement(rate, at);
                if (cell < 0 || cell >= width)
                    continue;
                Path next = path;
                next.cells.push_back(cell);
                next.rate = rate;
                next.price += std::log(rate == path.rate ? 0.9 : 0.05);
                longer.push_back(std::move(next));
            }
        paths = std::move(longer);
    }
    double best = -1e9;
    for (const Path &a : paths)
        for (const Path &b : paths) {
            double score = a.price + b.price;
            for (std::size_t at = 0; at < a.cells.size(); ++at) {
                const double one = likelihood.at(double(strip.y[at * std::size_t(width) + std::size_t(a.cells[at])]));
                const double other = likelihood.at(double(strip.y[at * std::size_t(width) + std::size_t(b.cells[at])]));
                score += std::abs(a.cells[at] - b.cells[at]) >= apart ? one + other : std::max(one, other);
            }
            best = std::max(best, score);
        }
    return best;
}

} // namespace

/// Two signals decided jointly.
class tst_jointPaths : public QObject
{
    Q_OBJECT

private slots:
    void equalsKeepTheirPlaces()
    {
        constexpr Index frames = 1500; // three blocks
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            auto paths = jointPaths(strip(frames, 6, {[](Index) { return 98; }, [](Index) { return 102; }}, 6.0, seed),
                                    likelihood, 3);
            if (paths[0].front() > paths[1].front())
                std::swap(paths[0], paths[1]);
            Index off = 0;
            for (std::size_t at = 0; at < std::size_t(frames); ++at) {
                QVERIFY(paths[0][at] < paths[1][at]);
                off += std::abs(paths[0][at] - 98) > 1 || std::abs(paths[1][at] - 102) > 1 ? 1 : 0;
            }
            QVERIFY2(off <= frames / 50, qPrintable(QString::number(off)));
        }
    }

    void aChangeOfPlaceIsFollowed()
    {
        // One of them drifts by 3 cells around the middle.
        const auto drifting = [](Index at) {
            return at < 180 ? Index(102) : at < 220 ? 102 + (at - 180) / 14 : Index(105);
        };
        auto paths = jointPaths(strip(400, 6, {[](Index) { return 97; }, drifting}, 8.0, 4), likelihood, 3);
        if (paths[0].front() > paths[1].front())
            std::swap(paths[0], paths[1]);
        QVERIFY(std::abs(paths[1][100] - 102) <= 1 && std::abs(paths[1][300] - 105) <= 1);
        QVERIFY(std::abs(paths[0][100] - 97) <= 1 && std::abs(paths[0][300] - 97) <= 1);
    }

    void noPairIsBetter()
    {
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            PathStrip small = strip(4, 1, {[](Index) { return 100; }}, 3.0, seed);
            const double best = bestByEnumeration(small, 2);
            const auto paths = jointPaths(small, likelihood, 2);
            double evidence = 0.0;
            for (Index at = 0; at < small.frameCount(); ++at) {
                const double one = likelihood.at(double(small.valueAt(at, paths[0][std::size_t(at)])));
                const double other = likelihood.at(double(small.valueAt(at, paths[1][std::size_t(at)])));
                const bool areApart = std::abs(paths[0][std::size_t(at)] - paths[1][std::size_t(at)]) >= 2;
                evidence += areApart ? one + other : std::max(one, other);
            }
            // The enumeration's best is the evidence of these paths and the price of their changes of rate, at most six.
            double closest = 1e9;
            for (int changes = 0; changes <= 6; ++changes)
                closest = std::min(
                    closest, std::abs(evidence + changes * std::log(0.05) + (6 - changes) * std::log(0.9) - best));
            QVERIFY2(closest < 1e-3, qPrintable(QString::number(closest)));
        }
    }

    void whatWasNotObservedIsNoEvidence()
    {
        PathStrip gap = strip(300, 6, {[](Index) { return 98; }, [](Index) { return 102; }}, 8.0, 5);
        for (Index at = 100; at < 140; ++at)
            std::fill_n(gap.row(at), gap.width(), std::numeric_limits<float>::quiet_NaN());
        auto paths = jointPaths(gap, likelihood, 3);
        if (paths[0].front() > paths[1].front())
            std::swap(paths[0], paths[1]);
        for (const std::size_t at : {50u, 200u, 290u})
            QVERIFY(std::abs(paths[0][at] - 98) <= 1 && std::abs(paths[1][at] - 102) <= 1);
    }
};

FAINTLINE_TEST(tst_jointPaths)
#include "tst_jointPaths.moc"
