#include "base/Axis.h"
#include "base/json.h"
#include "base/wholeNumber.h"
#include "support/errors.h"
#include "support/test.h"

using namespace faintline;

namespace {

enum class Colour { Red, Green };
constexpr std::array<std::string_view, 2> colourNames{"red", "green"};

struct Thing {
    bool isLarge = false;
    int count = 3;
    double size = 1.5;
    Colour colour = Colour::Red;
    std::vector<double> weights{1.0};

    bool operator==(const Thing &) const = default;
};

const std::vector<Field<Thing>> &fields()
{
    static const std::vector<Field<Thing>> table{
        field(&Thing::isLarge, "large", "Is it?"),
        field(&Thing::count, "count", "", 0.0, 9.0, "How many."),
        field(&Thing::size, "size", "m", 0.0, 10.0, "How large."),
        field(&Thing::colour, "colour", colourNames, "Which."),
        field(&Thing::weights, "weights", "kg", 0.0, 10.0, "How heavy."),
    };
    return table;
}

std::string refusalOf(const char *text)
{
    return test::errorOf([&] {
        Thing thing;
        readFields(parseJson(text, "here"), fields(), thing, "thing", {"other"});
    });
}

} // namespace

/// Structs as JSON by their tables of fields.
class tst_json : public QObject
{
    Q_OBJECT

private slots:
    void structsReadBackTheSame()
    {
        const Thing thing{true, 7, 0.1, Colour::Green, {0.0, 1.0 / 3.0, 1e-300}};
        const Json json = writeFields(thing, fields());
        QCOMPARE(
            json.dump(),
            std::string(
                R"({"large":true,"count":7,"size":0.1,"colour":"green","weights":[0.0,0.3333333333333333,1e-300]})"));
        Thing copy;
        readFields(parseJson(json.dump(), "here"), fields(), copy);
        QVERIFY(copy == thing);
    }

    void missingKeysKeepTheirValues()
    {
        Thing thing{true, 7, 0.1, Colour::Green, {}};
        readFields(parseJson("\xEF\xBB\xBF{\"count\": 5.0, \"size\": 2, \"other\": {}}", "here"), fields(), thing, {},
                   {"other"});
        QVERIFY((thing == Thing{true, 5, 2.0, Colour::Green, {}}));
    }

    void mistakesAreNamed_data()
    {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("message");
        QTest::newRow("key") << R"({"siz": 1})"
                             << "thing.siz: unknown; expected one of other, large, count, size, colour, weights";
        QTest::newRow("range") << R"({"size": 11})"
                               << "thing.size = 11: must lie in 0 … 10 m";
        QTest::newRow("kind") << R"({"size": "11"})"
                              << "thing.size = 11: must lie in 0 … 10 m";
        QTest::newRow("null") << R"({"size": null})"
                              << "thing.size = null: must lie in 0 … 10 m";
        QTest::newRow("fraction") << R"({"count": 1.5})"
                                  << "thing.count = 1.5: must lie in 0 … 9, a whole number";
        QTest::newRow("huge integer") << R"({"count": 123456789012345678901234567890})"
                                      << "must lie in 0 … 9, a whole number";
        QTest::newRow("flag") << R"({"large": 1})"
                              << "thing.large = 1: must be true or false";
        QTest::newRow("choice") << R"({"colour": "blue"})"
                                << "thing.colour = blue: must be one of red, green";
        QTest::newRow("list") << R"({"weights": [1, "2"]})"
                              << "thing.weights = […]: must be a list of numbers";
        QTest::newRow("list's range") << R"({"weights": [1, 11]})"
                                      << "each number must lie in 0 … 10 kg";
        QTest::newRow("no object") << "[]"
                                   << "thing: must be an object";
    }

    void mistakesAreNamed()
    {
        QFETCH(QString, text);
        QFETCH(QString, message);
        const std::string said = refusalOf(qPrintable(text));
        QVERIFY2(QString::fromStdString(said).contains(message), said.c_str());
    }

    void wholeNumbers()
    {
        const auto whole = []<class T>(const char *text, T) { return wholeNumber<T>(parseJson(text, "here"), "n"); };
        QCOMPARE(whole("-7", 0), -7);
        QCOMPARE(whole("3.0", 0), 3);
        QCOMPARE(whole("2147483647", 0), 2147483647);
        QCOMPARE(whole("18446744073709551615", std::uint64_t(0)), std::numeric_limits<std::uint64_t>::max());
        QCOMPARE(whole("1e15", Index(0)), Index(1000000000000000));
        for (const char *none :
             {"2147483648", "-2147483649", "1e300", "-1e300", "1e999", "0.5", "true", "null", "\"1\"", "[1]"})
            QVERIFY_THROWS_EXCEPTION(Error, whole(none, 0));
        for (const char *none : {"-1", "18446744073709551616", "1e20"})
            QVERIFY_THROWS_EXCEPTION(Error, whole(none, std::uint64_t(0)));
        const Json object = parseJson(R"({"a": 1, "b": "2"})", "here");
        QCOMPARE(wholeNumber(object, "here", "a", 5), 1);
        QCOMPARE(wholeNumber(object, "here", "c", 5), 5);
        QVERIFY_THROWS_EXCEPTION(Error, wholeNumber(object, "here", "b", 5));
    }

    void textThatIsNoJson()
    {
        QCOMPARE(refusalOf("{\"a\": 1,\n  \"b\" 2}"), std::string("here: is not valid JSON at line 2, column 7"));
        QCOMPARE(refusalOf(""), std::string("here: is not valid JSON at line 1, column 1"));
        QVERIFY(!refusalOf("{\"size\": NaN}").empty());
        QVERIFY(!refusalOf("{\"size\": 1e999}").empty());
        QVERIFY(!refusalOf("{\"\xff\": 1}").empty());
        QCOMPARE(refusalOf(("{\"size\": " + std::string(500000, '[') + std::string(500000, ']') + "}").c_str()),
                 std::string("here: is nested more than 100 levels deep, the limit for any input"));
        QVERIFY(refusalOf(("{\"size\": " + std::string(99, '[') + std::string(99, ']') + "}").c_str())
                    .ends_with("0 … 10 m"));
    }

    void filesThatAreNone()
    {
        QVERIFY_THROWS_EXCEPTION(Error, readJsonFile("/no/such/file"));
        QVERIFY_THROWS_EXCEPTION(Error, readJsonFile("/"));
        QVERIFY_THROWS_EXCEPTION(Error, readJsonFile("/dev/zero"));
    }
};

FAINTLINE_TEST(tst_json)
#include "tst_json.moc"
