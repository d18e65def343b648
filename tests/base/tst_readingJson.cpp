#include "base/json.h"
#include "support/test.h"

#include "support/errors.h"

#include <string>

using namespace faintline;
using namespace faintline::test;

namespace {

std::string refusalOf(const char *text, void (*read)(const Json &))
{
    const Json json = Json::parse(text);
    return errorOf([&] { readingJson("file.json", [&] { read(json); }); });
}

} // namespace

/// The library's errors in our words; our own as they are.
class tst_readingJson : public QObject
{
    Q_OBJECT

private slots:
    void libraryErrorsBecomeOurs()
    {
        const std::string begin = "file.json: has the wrong type or is missing: ";
        const std::string missing = refusalOf(R"({"a": 1})", [](const Json &json) { json.at("b"); });
        QVERIFY2(missing.starts_with(begin) && contains(missing, "'b'"), missing.c_str());
        const std::string kind = refusalOf(R"({"a": "x"})", [](const Json &json) { json.at("a").get<double>(); });
        QVERIFY2(kind.starts_with(begin) && kind.ends_with("is string"), kind.c_str());
        QCOMPARE(refusalOf("7", [](const Json &json) { json.at("a"); }),
                 begin + "expected an object or a list, found a number");
        QCOMPARE(refusalOf("\"x\"", [](const Json &json) { json.value("a", 1); }),
                 begin + "expected an object or a list, found a string");
        for (const std::string &words : {missing, kind})
            QVERIFY2(!contains(words, "json.exception"), words.c_str());
        QCOMPARE(refusalOf(R"({"a": 1})", [](const Json &json) { json.at("a").get<double>(); }), std::string());
        QCOMPARE(readingJson("file.json", [] { return Json::parse("[1, 2]").at(1).get<int>(); }), 2);
    }

    void ownErrorsPassThrough()
    {
        QCOMPARE(refusalOf("{}", [](const Json &) { throw Error("a.b", "must be 1"); }), std::string("a.b: must be 1"));
    }
};

FAINTLINE_TEST(tst_readingJson)
#include "tst_readingJson.moc"
