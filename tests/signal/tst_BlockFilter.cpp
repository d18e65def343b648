#include "base/Random.h"
#include "signal/BlockFilter.h"
#include "support/test.h"

#include <cmath>

using namespace faintline;

/// Blocks under a window that add up to the signal again.
class tst_BlockFilter : public QObject
{
    Q_OBJECT

private slots:
    void leavesASignalAsItIs()
    {
        constexpr Index count = 1000;
        const BlockFilter filter(96);
        const std::vector<float> gains(96, 1.0f / 96.0f);
        std::vector<float> x(count);
        Random random(3, 0);
        random.normals(x, 1.0f);
        std::vector<float> sum(count, 0.0f);
        for (Index block = filter.firstBlockOf(0); filter.beginOf(block) < count; ++block) {
            std::vector<std::complex<float>> samples(96);
            for (Index n = 0; n < 96; ++n)
                if (const Index at = filter.beginOf(block) + n; at >= 0 && at < count)
                    samples[std::size_t(n)] = x[std::size_t(at)];
            filter.apply(samples, gains);
            for (Index n = 0; n < 96; ++n)
                if (const Index at = filter.beginOf(block) + n; at >= 0 && at < count)
                    sum[std::size_t(at)] += samples[std::size_t(n)].real();
        }
        for (std::size_t n = 0; n < x.size(); ++n)
            QVERIFY(std::abs(sum[n] - x[n]) < 1e-5f);
    }

    void blocksCoverEverySampleTwice()
    {
        const BlockFilter filter(96);
        for (const Index sample : {0, 1, 47, 48, 95, 96, 1000}) {
            const Index first = filter.firstBlockOf(sample);
            QVERIFY(filter.beginOf(first) <= sample && sample < filter.beginOf(first) + filter.length());
            QVERIFY(filter.beginOf(first + 1) <= sample);
            QVERIFY(filter.beginOf(first + 2) > sample);
            QVERIFY(filter.beginOf(first - 1) + filter.length() <= sample);
        }
    }
};

FAINTLINE_TEST(tst_BlockFilter)
#include "tst_BlockFilter.moc"
