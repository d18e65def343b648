#include "noise/NoiseBackground.h"
#include "support/test.h"

#include "base/Random.h"

#include <cmath>

using namespace faintline;

namespace {

constexpr Index cells = 240;
constexpr Index frames = 300;

/// A receiver's floor of 1 everywhere, and a source between two sharp edges that is there at 0, 10, 20 or 30 dB, or
/// not.
struct Scene {
    std::vector<float> power;
    std::vector<float> y;

    explicit Scene(std::uint64_t stream)
    {
        Random random(77, stream);
        for (Index frame = 0; frame < frames; ++frame) {
            const double level = frame / 20 % 5 == 4 ? 0.0 : std::pow(10.0, double(frame / 20 % 5));
            for (Index cell = 0; cell < cells; ++cell) {
                const double b = 1.0 + (cell >= 60 && cell < 150 ? level : 0.0);
                power.push_back(float(b));
                y.push_back(float(b * random.exponential()));
            }
        }
    }
    std::span<const float> frame(Index i) const { return std::span(y).subspan(std::size_t(i * cells), cells); }
};

/// Root mean square of ln(B/power), over all cells but those nearest to the edges, and the largest next to them.
std::pair<double, double> errors(const Scene &scene, const NoiseSources &sources)
{
    std::vector<float> b(cells);
    double sum = 0.0;
    double counted = 0.0;
    double largest = 0.0;
    for (Index i = 0; i < frames; ++i) {
        sources.addUp(sources.levelsIn(scene.frame(i)), b);
        for (Index cell = 0; cell < cells; ++cell) {
            const double error = std::log(double(b[std::size_t(cell)] / scene.power[std::size_t(i * cells + cell)]));
            largest = std::max(largest, std::abs(error));
            sum += error * error;
            counted += 1.0;
        }
    }
    return {std::sqrt(sum / counted), largest};
}

} // namespace

/// Noise as a sum of sources: colours and levels from frames alone.
class tst_noiseSources : public QObject
{
    Q_OBJECT

private slots:
    void twoSources()
    {
        const Scene scene(1);
        const NoiseSources sources = fitSources(scene.y, cells, 2, 20);
        QCOMPARE(sources.count(), Index(2));
        // A level from 90 cells is known to a tenth.
        const auto [typical, largest] = errors(scene, sources);
        QVERIFY2(typical < 0.12, qPrintable(QString::number(typical)));
        QVERIFY2(largest < 1.0, qPrintable(QString::number(largest)));
    }

    void aLineIsNoColour()
    {
        // Three cells with a line of 20 dB all the time: the sources are what they are without it.
        Scene scene(2);
        for (Index i = 0; i < frames; ++i)
            for (Index cell = 200; cell < 203; ++cell)
                scene.y[std::size_t(i * cells + cell)] += 100.0f;
        const NoiseSources sources = fitSources(scene.y, cells, 2, 20);
        std::vector<float> b(cells);
        double ln = 0.0;
        for (Index i = 0; i < frames; ++i) {
            sources.addUp(sources.levelsIn(scene.frame(i)), b);
            ln += std::log(double(b[201])) / frames;
        }
        QVERIFY2(std::abs(ln) < 0.2, qPrintable(QString::number(ln)));
    }

    void silence()
    {
        QCOMPARE(fitSources(std::vector<float>(std::size_t(10 * cells), 0.0f), cells, 2, 20).count(), Index(0));
        Scene scene(3);
        std::fill(scene.y.begin(), scene.y.begin() + 50 * cells, 0.0f);
        const NoiseSources sources = fitSources(scene.y, cells, 2, 20);
        QCOMPARE(sources.levelsIn(scene.frame(0)), std::vector<float>(2, 0.0f));
        for (const float colour : sources.colours)
            QVERIFY(std::isfinite(colour) && colour >= 0.0f);
    }

    void anyScale()
    {
        // Levels of a frame follow its scale over 100 dB either way.
        const Scene scene(4);
        const NoiseSources sources = fitSources(scene.y, cells, 2, 20);
        const std::vector<float> levels = sources.levelsIn(scene.frame(70));
        for (const float scale : {1e-8f, 1e10f}) {
            std::vector<float> scaled(scene.frame(70).begin(), scene.frame(70).end());
            for (float &value : scaled)
                value *= scale;
            const std::vector<float> other = sources.levelsIn(scaled);
            for (std::size_t k = 0; k < levels.size(); ++k)
                QVERIFY(std::abs(other[k] / scale - levels[k]) < 1e-3f * levels[k] + 1e-6f);
        }
    }
};

FAINTLINE_TEST(tst_noiseSources)
#include "tst_noiseSources.moc"
