#include "base/RunContext.h"
#include "support/test.h"

#include <string>
#include <utility>
#include <vector>

using namespace faintline;

/// What every long computation is handed.
class tst_RunContext : public QObject
{
    Q_OBJECT

private slots:
    void partsOfPartsAreMapped()
    {
        RunContext context;
        context.threads = 5;
        std::vector<std::pair<double, std::string>> heard;
        context.progress = [&](double fraction, std::string_view what) { heard.emplace_back(fraction, what); };
        const RunContext inner = context.part(0.5, 1.0).part(0.25, 0.75);
        QCOMPARE(inner.threads, 5);
        inner.checkpoint(0.0, "begin");
        inner.checkpoint(0.5, "middle");
        inner.checkpoint(1.0, "end");
        QCOMPARE(heard.size(), std::size_t(3));
        QCOMPARE(heard[0].first, 0.625);
        QCOMPARE(heard[1].first, 0.75);
        QCOMPARE(heard[2].first, 0.875);
        QCOMPARE(heard[1].second, std::string("middle"));
    }

    void withoutAListenerNothingIsCalled()
    {
        const RunContext context;
        QVERIFY(!context.part(0.0, 0.5).progress);
        context.part(0.0, 0.5).checkpoint(0.5, "nobody listens");
    }

    void stoppingIsAnException()
    {
        std::stop_source source;
        RunContext context;
        context.stop = source.get_token();
        int heard = 0;
        context.progress = [&](double, std::string_view) { ++heard; };
        context.checkpoint(0.1, "before");
        source.request_stop();
        QVERIFY_THROWS_EXCEPTION(Cancelled, context.checkpoint(0.2, "after"));
        QCOMPARE(heard, 1); // nothing is reported any more
    }

    void aPartStopsWithTheWhole()
    {
        std::stop_source source;
        RunContext context;
        context.stop = source.get_token();
        const RunContext inner = context.part(0.0, 0.5).part(0.0, 0.5);
        source.request_stop();
        QVERIFY_THROWS_EXCEPTION(Cancelled, inner.checkpoint(0.0, "inner"));
    }
};

FAINTLINE_TEST(tst_RunContext)
#include "tst_RunContext.moc"
