#include "base/LargeVector.h"
#include "support/test.h"

#include <cstdint>

using namespace faintline;

/// Where the memory of large vectors begins.
class tst_LargeVector : public QObject
{
    Q_OBJECT

private slots:
    // 64 bytes for the widest vectors; from 4 MiB on a page of 2 MiB.
    void areAligned()
    {
        for (const std::size_t count : {1u, 1000u, (1u << 20) - 1u, 1u << 20, (1u << 20) + 12345u}) {
            LargeVector<float> values(count, 3.0f);
            const auto address = reinterpret_cast<std::uintptr_t>(values.data());
            QCOMPARE(address % (count >= 1u << 20 ? std::uintptr_t(2) << 20 : 64), std::uintptr_t(0));
            values.resize(count + 7, 4.0f); // moves across the limit, too
            QCOMPARE(values.front(), 3.0f);
            QCOMPARE(values[count - 1], 3.0f);
            QCOMPARE(values.back(), 4.0f);
        }
        QVERIFY(HugePageAllocator<float>() == HugePageAllocator<double>());
    }
};

FAINTLINE_TEST(tst_LargeVector)
#include "tst_LargeVector.moc"
