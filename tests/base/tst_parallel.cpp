#include "base/parallel.h"
#include "support/test.h"

#include <array>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

using namespace faintline;

class tst_parallel : public QObject
{
    Q_OBJECT

private slots:
    void everyItemOnce()
    {
        for (const int threads : {1, 2, 8}) {
            RunContext context;
            context.threads = threads;
            std::vector<int> done(1000, 0);
            parallelFor(1000, context, "", [&] { return [&](Index i) { ++done[std::size_t(i)]; }; });
            QCOMPARE(done, std::vector<int>(1000, 1));
        }
        parallelFor(0, {}, "", [] { return [](Index) { QFAIL("there is nothing to do"); }; });
    }

    void oneWorkerAThread()
    {
        RunContext context;
        context.threads = 3;
        std::atomic<int> workers = 0;
        parallelFor(100, context, "", [&] {
            ++workers;
            return [](Index) {};
        });
        QVERIFY(workers >= 1 && workers <= 3);
    }

    void firstFailureIsThrown()
    {
        for (const int threads : {1, 4}) {
            RunContext context;
            context.threads = threads;
            std::atomic<int> done = 0;
            const auto run = [&] {
                parallelFor(100000, context, "", [&] {
                    return [&](Index i) {
                        if (i == 7)
                            throw Error("item 7", "fails");
                        ++done;
                        std::this_thread::sleep_for(std::chrono::microseconds(10)); // lets another thread fail first
                    };
                });
            };
            QVERIFY_EXCEPTION_THROWN(run(), Error);
            QVERIFY(done < 99999);
        }
    }

    void stops()
    {
        std::stop_source source;
        RunContext context;
        context.stop = source.get_token();
        context.progress = [&](double fraction, std::string_view) {
            if (fraction >= 0.5)
                source.request_stop();
        };
        QVERIFY_EXCEPTION_THROWN(parallelFor(100, context, "", [] { return [](Index) {}; }), Cancelled);
    }

    void withinAnother()
    {
        RunContext context;
        context.threads = 4;
        std::vector<int> done(64 * 64, 0);
        parallelFor(64, context, "", [&] {
            return [&](Index outer) {
                parallelFor(64, context, "",
                            [&] { return [&](Index inner) { ++done[std::size_t(outer * 64 + inner)]; }; });
            };
        });
        QCOMPARE(done, std::vector<int>(64 * 64, 1));
    }

    void fromSeveralThreads()
    {
        RunContext context;
        context.threads = 3;
        std::array<std::atomic<int>, 4> done{};
        {
            std::vector<std::jthread> callers;
            for (std::atomic<int> &count : done)
                callers.emplace_back([&] {
                    for (int loop = 0; loop < 200; ++loop)
                        parallelFor(20, context, "", [&] { return [&](Index) { ++count; }; });
                });
        }
        for (const std::atomic<int> &count : done)
            QCOMPARE(count.load(), 200 * 20);
    }
};

FAINTLINE_TEST(tst_parallel)
#include "tst_parallel.moc"
