#include "app/base/JobRunner.h"
#include "support/test.h"

#include <atomic>
#include <semaphore>

using namespace faintline;

namespace {

/// Computes until it is told to stop, as a long job does.
JobRunner::Job endlessJob(std::atomic<int> &stopped)
{
    return [&stopped](const RunContext &context) -> JobRunner::Delivery {
        try {
            while (true) {
                context.checkpoint(0.5, "waiting");
                std::this_thread::yield();
            }
        } catch (const Cancelled &) {
            ++stopped;
            throw;
        }
    };
}

} // namespace

class tst_JobRunner : public QObject
{
    Q_OBJECT

private slots:
    void computesElsewhereAndDeliversHere()
    {
        JobRunner runner;
        QSignalSpy finished(&runner, &JobRunner::finished);
        const QThread *here = QThread::currentThread();
        QThread *computedIn = nullptr;
        QThread *deliveredIn = nullptr;
        runner.start([&](const RunContext &) -> JobRunner::Delivery {
            computedIn = QThread::currentThread();
            return [&] { deliveredIn = QThread::currentThread(); };
        });
        QVERIFY(runner.isRunning());
        QVERIFY(finished.wait());
        QVERIFY(!runner.isRunning());
        QVERIFY(computedIn != here);
        QCOMPARE(deliveredIn, here);
    }

    void theNewestJobWins()
    {
        std::atomic<int> stopped = 0;
        JobRunner runner;
        QSignalSpy finished(&runner, &JobRunner::finished);
        QSignalSpy cancelled(&runner, &JobRunner::cancelled);
        int delivered = -1;
        for (int i = 0; i < 50; ++i)
            runner.start(endlessJob(stopped));
        runner.start([&](const RunContext &) -> JobRunner::Delivery { return [&] { delivered = 50; }; });
        QVERIFY(finished.wait());
        QCOMPARE(delivered, 50);
        QCOMPARE(finished.count(), 1);
        QCOMPARE(cancelled.count(), 0);
        QVERIFY(stopped <= 50);
    }

    void aResultThatIsReadyIsDroppedForANewerJob()
    {
        JobRunner runner;
        QSignalSpy finished(&runner, &JobRunner::finished);
        std::binary_semaphore ready(0);
        QStringList delivered;
        runner.start([&](const RunContext &) -> JobRunner::Delivery {
            ready.release();
            return [&] { delivered << "older"; };
        });
        ready.acquire(); // computed, but this thread has not gone back to its events
        runner.start([&](const RunContext &) -> JobRunner::Delivery { return [&] { delivered << "newer"; }; });
        QVERIFY(finished.wait());
        QCOMPARE(delivered, QStringList{"newer"});
    }

    void cancelStopsAndSaysSo()
    {
        std::atomic<int> stopped = 0;
        JobRunner runner;
        QSignalSpy cancelled(&runner, &JobRunner::cancelled);
        QSignalSpy progressed(&runner, &JobRunner::progressed);
        runner.start(endlessJob(stopped));
        QVERIFY(progressed.wait());
        QCOMPARE(progressed.first().at(0).toDouble(), 0.5);
        QCOMPARE(progressed.first().at(1).toString(), "waiting");
        runner.cancel();
        QCOMPARE(cancelled.count(), 1);
        QVERIFY(!runner.isRunning());
        QTRY_COMPARE(stopped.load(), 1);
        runner.cancel();
        QCOMPARE(cancelled.count(), 1);
    }

    void errorsComeAsSentences()
    {
        JobRunner runner;
        QSignalSpy failed(&runner, &JobRunner::failed);
        QStringList sentences;
        connect(&runner, &JobRunner::failed, this, [&](const Error &error) { sentences << error.what(); });
        runner.start([](const RunContext &) -> JobRunner::Delivery { throw Error("a.wav", "is no recording"); });
        QVERIFY(failed.wait());
        QCOMPARE(sentences, QStringList{"a.wav: is no recording"});
        QVERIFY(!runner.isRunning());

        runner.start([](const RunContext &) -> JobRunner::Delivery { throw std::bad_alloc(); });
        QVERIFY(failed.wait());
        QVERIFY(sentences.last().startsWith("memory: "));
    }

    void aDeliveryMayStartTheNextJob()
    {
        JobRunner runner;
        QSignalSpy finished(&runner, &JobRunner::finished);
        QStringList delivered;
        runner.start([&](const RunContext &) -> JobRunner::Delivery {
            return [&] {
                delivered << "first";
                runner.start([&](const RunContext &) -> JobRunner::Delivery { return [&] { delivered << "second"; }; });
            };
        });
        QVERIFY(finished.wait());
        QCOMPARE(delivered, (QStringList{"first", "second"}));
        QCOMPARE(finished.count(), 1);
    }

    void goesAwayInTheMiddleOfAJob()
    {
        std::atomic<int> stopped = 0;
        for (int i = 0; i < 20; ++i) {
            JobRunner runner;
            runner.start(endlessJob(stopped));
        }
        QVERIFY(stopped <= 20);
    }
};

FAINTLINE_TEST(tst_JobRunner)
#include "tst_JobRunner.moc"
