#include "base/RunContext.h"

#include "base/LargeVector.h"
#include "base/Overloaded.h"
#include "base/memoryShares.h"
#include "base/readingJson.h"

#include <QtTest>

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

using namespace faintline;

namespace {

std::string refusalOf(const char *text, void (*read)(const Json &))
{
    const Json json = Json::parse(text);
    try {
        readingJson("file.json", [&] { read(json); });
    } catch (const Error &error) {
        return error.what();
    }
    return {};
}

} // namespace

/// What every long computation is handed, and small tools that all rooms share.
class tst_RunContext : public QObject
{
    Q_OBJECT

private slots:
    void partsOfPartsAreMapped();
    void withoutAListenerNothingIsCalled();
    void stoppingIsAnException();
    void aPartStopsWithTheWhole();
    void libraryErrorsBecomeOurs();
    void ownErrorsPassThrough();
    void largeVectorsAreAligned();
    void theFittingLambdaIsCalled();
    void sharesOfSome();
};

void tst_RunContext::partsOfPartsAreMapped()
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

void tst_RunContext::withoutAListenerNothingIsCalled()
{
    const RunContext context;
    QVERIFY(!context.part(0.0, 0.5).progress);
    context.part(0.0, 0.5).checkpoint(0.5, "nobody listens");
}

void tst_RunContext::stoppingIsAnException()
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

void tst_RunContext::aPartStopsWithTheWhole()
{
    std::stop_source source;
    RunContext context;
    context.stop = source.get_token();
    const RunContext inner = context.part(0.0, 0.5).part(0.0, 0.5);
    source.request_stop();
    QVERIFY_THROWS_EXCEPTION(Cancelled, inner.checkpoint(0.0, "inner"));
}

void tst_RunContext::libraryErrorsBecomeOurs()
{
    const std::string begin = "file.json: has the wrong type or is missing: ";
    const std::string missing = refusalOf(R"({"a": 1})", [](const Json &json) { json.at("b"); });
    QVERIFY2(missing.starts_with(begin) && missing.find("'b'") != std::string::npos, missing.c_str());
    const std::string kind = refusalOf(R"({"a": "x"})", [](const Json &json) { json.at("a").get<double>(); });
    QVERIFY2(kind.starts_with(begin) && kind.ends_with("is string"), kind.c_str());
    QCOMPARE(refusalOf("7", [](const Json &json) { json.at("a"); }),
             begin + "expected an object or a list, found a number");
    QCOMPARE(refusalOf("\"x\"", [](const Json &json) { json.value("a", 1); }),
             begin + "expected an object or a list, found a string");
    for (const std::string &words : {missing, kind})
        QVERIFY2(words.find("json.exception") == std::string::npos, words.c_str());
    QCOMPARE(refusalOf(R"({"a": 1})", [](const Json &json) { json.at("a").get<double>(); }), std::string());
    QCOMPARE(readingJson("file.json", [] { return Json::parse("[1, 2]").at(1).get<int>(); }), 2);
}

void tst_RunContext::ownErrorsPassThrough()
{
    QCOMPARE(refusalOf("{}", [](const Json &) { throw Error("a.b", "must be 1"); }), std::string("a.b: must be 1"));
}

// 64 bytes for the widest vectors; from 4 MiB on a page of 2 MiB.
void tst_RunContext::largeVectorsAreAligned()
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

void tst_RunContext::theFittingLambdaIsCalled()
{
    using Either = std::variant<int, std::string, double>;
    const auto name = [](const Either &value) {
        return std::visit(Overloaded{[](int) { return "whole"; }, [](const std::string &) { return "text"; },
                                     [](double) { return "real"; }},
                          value);
    };
    QCOMPARE(name(1), "whole");
    QCOMPARE(name(std::string("x")), "text");
    QCOMPARE(name(1.0), "real");
}

void tst_RunContext::sharesOfSome()
{
    QCOMPARE(memoryShares::orSome(10, 7), std::size_t(10));
    QCOMPARE(memoryShares::orSome(10, 70), std::size_t(70));
    // Sixteen frames of ten cells with their summaries, 16 + 4 + 1 rows; merged by four, 4 + 1.
    QCOMPARE(memoryShares::inTheEnd(1000, 16, 10), std::size_t(210));
    QCOMPARE(memoryShares::inTheEnd(210, 16, 10), std::size_t(210));
    QCOMPARE(memoryShares::inTheEnd(209, 16, 10), std::size_t(50));
    QCOMPARE(memoryShares::inTheEnd(49, 16, 10), std::size_t(10));
    QCOMPARE(memoryShares::inTheEnd(9, 16, 10), std::size_t(9)); // not even one row fits
}

QTEST_APPLESS_MAIN(tst_RunContext)
#include "tst_RunContext.moc"
