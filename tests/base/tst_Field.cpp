#include "base/Field.h"
#include "support/test.h"

#include "base/Error.h"
#include "base/Random.h"
#include "base/json.h"
#include "base/numberText.h"
#include "support/CommaLocale.h"
#include "support/errors.h"

#include <cmath>
#include <cstring>
#include <limits>

using namespace faintline;

Q_DECLARE_METATYPE(FieldValue)
Q_DECLARE_METATYPE(FieldKind)

namespace {

enum class Colour { Red, Green };
constexpr std::array<std::string_view, 2> colourNames{"red", "green"};

struct Lamp {
    bool isOn = false;
    int count = 2;
    double watts = 40.0;
    Colour colour = Colour::Red;
    std::vector<double> hours{1.0, 2.0};
};

const std::vector<Field<Lamp>> &fields()
{
    static const std::vector<Field<Lamp>> table{
        field(&Lamp::isOn, "on", "Is it?"),
        field(&Lamp::count, "count", "", -3.0, 9.0, "How many."),
        field(&Lamp::watts, "watts", "W", 0.0, 100.0, "How bright."),
        field(&Lamp::colour, "colour", colourNames, "Which."),
        field(&Lamp::hours, "hours", "h", 0.0, 24.0, "When."),
    };
    return table;
}

const Field<Lamp> &fieldOf(const QString &name)
{
    for (const auto &f : fields())
        if (f.name == name.toStdString())
            return f;
    qFatal("the test asks for a field that is not in its table");
}

} // namespace

/// Settings as text: what is read, what is refused and in which words, and numbers in their shortest form.
class tst_Field : public QObject
{
    Q_OBJECT

private slots:
    void parses_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("printed");
        for (const char *yes : {"true", "1", "on", "yes"})
            QTest::newRow(yes) << "on" << yes << "true";
        for (const char *no : {"false", "0", "off", "no"})
            QTest::newRow(no) << "on" << no << "false";
        QTest::newRow("whole") << "count"
                               << "7"
                               << "7";
        QTest::newRow("negative") << "count"
                                  << "-3"
                                  << "-3";
        QTest::newRow("whole with a point") << "count"
                                            << "2.0"
                                            << "2";
        QTest::newRow("number") << "watts"
                                << "0.5"
                                << "0.5";
        QTest::newRow("exponent") << "watts"
                                  << "1e1"
                                  << "10";
        QTest::newRow("sign") << "watts"
                              << "+12"
                              << "12";
        QTest::newRow("lower end") << "watts"
                                   << "0"
                                   << "0";
        QTest::newRow("upper end") << "watts"
                                   << "100"
                                   << "100";
        QTest::newRow("choice") << "colour"
                                << "green"
                                << "green";
        QTest::newRow("list") << "hours"
                              << "1,2.5,3"
                              << "1, 2.5, 3";
        QTest::newRow("list in brackets") << "hours"
                                          << "[1; 2.5]"
                                          << "1, 2.5";
        QTest::newRow("quotient") << "watts"
                                  << "1/4"
                                  << "0.25";
        QTest::newRow("list of quotients") << "hours"
                                           << "1/3, 3/4"
                                           << "0.3333333333333333, 0.75";
        QTest::newRow("empty list") << "hours"
                                    << "[]"
                                    << "";
    }

    void parses()
    {
        QFETCH(QString, name);
        QFETCH(QString, text);
        QFETCH(QString, printed);
        QCOMPARE(QString::fromStdString(formatFieldValue(parseFieldValue(fieldOf(name), text.toStdString()))), printed);
    }

    void refuses_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("sentence");
        QTest::newRow("flag") << "on"
                              << "maybe"
                              << "on = maybe: must be true or false";
        QTest::newRow("divided by 0") << "watts"
                                      << "1/0"
                                      << "watts = 1/0: must lie in 0 … 100 W";
        QTest::newRow("below") << "count"
                               << "-4"
                               << "count = -4: must lie in -3 … 9, a whole number";
        QTest::newRow("fraction") << "count"
                                  << "1.5"
                                  << "count = 1.5: must lie in -3 … 9, a whole number";
        QTest::newRow("beyond int") << "count"
                                    << "4294967297"
                                    << "count = 4294967297: must lie in -3 … 9, a whole number";
        QTest::newRow("above") << "watts"
                               << "100.5"
                               << "watts = 100.5: must lie in 0 … 100 W";
        QTest::newRow("not a number") << "watts"
                                      << "nan"
                                      << "watts = nan: must lie in 0 … 100 W";
        QTest::newRow("infinite") << "watts"
                                  << "inf"
                                  << "watts = inf: must lie in 0 … 100 W";
        QTest::newRow("beyond double") << "watts"
                                       << "1e999"
                                       << "watts = 1e999: must lie in 0 … 100 W";
        QTest::newRow("decimal comma") << "watts"
                                       << "1,5"
                                       << "watts = 1,5: has a decimal comma; write a decimal point";
        QTest::newRow("nothing") << "watts"
                                 << ""
                                 << "watts = : must lie in 0 … 100 W";
        QTest::newRow("choice") << "colour"
                                << "blue"
                                << "colour = blue: must be one of red, green";
        QTest::newRow("capital") << "colour"
                                 << "Red"
                                 << "colour = Red: must be one of red, green";
        QTest::newRow("list") << "hours"
                              << "1,x"
                              << "hours = 1,x: must be a list of numbers";
        QTest::newRow("gap in a list") << "hours"
                                       << "1,,2"
                                       << "hours = 1,,2: must be a list of numbers";
        QTest::newRow("list's range") << "hours"
                                      << "1,25"
                                      << "hours = 1, 25: each number must lie in 0 … 24 h";
    }

    void refuses()
    {
        QFETCH(QString, name);
        QFETCH(QString, text);
        QFETCH(QString, sentence);
        try {
            parseFieldValue(fieldOf(name), text.toStdString());
        } catch (const Error &error) {
            QCOMPARE(QString::fromUtf8(error.what()), sentence);
            QCOMPARE(error.kind(), Error::Kind::Mistake);
            return;
        }
        QFAIL("was taken");
    }

    void refusalsNameTheirField()
    {
        FieldInfo info;
        info.name = "model.snr";
        info.maximum = 10.0;
        try {
            parseFieldValue(info, "11");
            QFAIL("was taken");
        } catch (const Error &error) {
            QCOMPARE(error.field(), std::string("model.snr"));
            const Error farther = error.in("settings.json");
            QCOMPARE(farther.what(), "settings.json: model.snr = 11: must lie in 0 … 10");
            QCOMPARE(farther.field(), std::string("model.snr"));
        }
        QCOMPARE(Error("x.wav", "is empty").field(), std::string());
    }

    void wordsStandForValues_data()
    {
        QTest::addColumn<FieldKind>("kind");
        QTest::addColumn<FieldValue>("value");
        QTest::newRow("number") << FieldKind::Number << FieldValue(-1.0);
        QTest::newRow("integer") << FieldKind::Integer << FieldValue(-1);
        QTest::newRow("list") << FieldKind::Numbers << FieldValue(std::vector{-1.0});
    }

    void wordsStandForValues()
    {
        QFETCH(FieldKind, kind);
        QFETCH(FieldValue, value);
        FieldInfo info;
        info.name = "stage.setting";
        info.kind = kind;
        info.maximum = 9.0;
        info.words = {{-1.0, "all"}};
        for (const char *text : {"all", "All", "ALL"})
            QVERIFY(parseFieldValue(info, text) == value);
        QCOMPARE(formatFieldValue(info, value), std::string("all"));
        QVERIFY(parseFieldValue(info, formatFieldValue(value)) == value);
        QVERIFY(fieldValueFromJson(Json("all"), info) == value);
        QCOMPARE(formatFieldValue(info, parseFieldValue(info, "2")), std::string("2"));
        for (const char *wrong : {"every", "10", "-2", "0, -1"}) {
            QVERIFY2(
                QString::fromStdString(test::errorOf([&] { parseFieldValue(info, wrong); })).contains("or \"all\""),
                wrong);
        }
        info.words.clear();
        QVERIFY_EXCEPTION_THROWN(parseFieldValue(info, "all"), Error);
        QVERIFY_EXCEPTION_THROWN(parseFieldValue(info, "-1"), Error);
    }

    void everythingPrintedReadsBack()
    {
        const Lamp lamp{true, -3, 1.0 / 3.0, Colour::Green, {0.1, 23.999999999999996, 1e-300}};
        for (const auto &f : fields()) {
            const FieldValue value = f.get(lamp).value();
            QVERIFY2(parseFieldValue(f, formatFieldValue(value)) == value, f.name.c_str());
        }
    }

    void shortestForm_data()
    {
        QTest::addColumn<double>("value");
        QTest::addColumn<QString>("text");
        QTest::newRow("0") << 0.0 << "0";
        QTest::newRow("-0") << -0.0 << "0";
        QTest::newRow("whole") << 1000.0 << "1000";
        QTest::newRow("tenth") << 0.1 << "0.1";
        QTest::newRow("sum of tenths") << 0.1 + 0.2 << "0.30000000000000004";
        QTest::newRow("third") << 1.0 / 3.0 << "0.3333333333333333";
        QTest::newRow("negative") << -2.5 << "-2.5";
        QTest::newRow("large") << 1e22 << "1e+22";
        QTest::newRow("thousands") << 1234567.5 << "1234567.5";
        QTest::newRow("small") << 1e-7 << "1e-07";
        QTest::newRow("smallest") << 5e-324 << "5e-324";
        QTest::newRow("largest") << std::numeric_limits<double>::max() << "1.7976931348623157e+308";
    }

    void shortestForm()
    {
        QFETCH(double, value);
        QFETCH(QString, text);
        QCOMPARE(QString::fromStdString(formatNumber(value)), text);
    }

    void forPeople_data()
    {
        QTest::addColumn<double>("value");
        QTest::addColumn<QString>("plain");
        QTest::addColumn<double>("step");
        QTest::addColumn<int>("least");
        QTest::addColumn<QString>("toStep");
        const auto row = [](double value, const char *plain, double step, int least, const char *toStep) {
            QTest::newRow(toStep) << value << plain << step << least << toStep;
        };
        row(1.42e9, "1420000000", 2.0, 8, "1420000000");
        row(1419914464.0, "1419914464", 2.0, 8, "1419914464");
        row(1419914464.123, "1419914464.123", 2.0, 8, "1419914464.1"); // tells 0.2 Hz apart
        row(1419914464.123, "1419914464.123", 1e6, 8, "1419914464");   // no exponent
        row(-1419914464.123, "-1419914464.123", 2.0, 8, "-1419914464.1");
        row(210.0523456789, "210.0523456789", 1.0, 8, "210.05235");
        row(10.00013889, "10.00013889", 0.000277, 8, "10.000139");
        row(10.00013889, "10.00013889", 0.00000277, 8, "10.0001389");
        row(86399.75, "86399.75", 0.25, 6, "86399.75");
        row(0.0, "0", 0.25, 6, "0");
        row(1e-9, "1e-09", 0.0, 6, "1e-09");
        row(2e21, "2e+21", 1.0, 6, "2e+21");
    }

    void forPeople()
    {
        QFETCH(double, value);
        QFETCH(QString, plain);
        QFETCH(double, step);
        QFETCH(int, least);
        QFETCH(QString, toStep);
        QCOMPARE(QString::fromStdString(formatPlainly(value)), plain);
        QCOMPARE(QString::fromStdString(formatToStep(value, step, least)), toStep);
    }

    void decimalCommasAreNamed()
    {
        for (const char *text : {"0,5", "-1,25", "+3,0", "1,5e3"})
            QVERIFY2(hasDecimalComma(text), text);
        for (const char *text : {"0.5", "5", "", ",", "0,5,1", "1,234.5", "a,b", "3, 4"})
            QVERIFY2(!hasDecimalComma(text), text);
        for (const FieldInfo &info : fields())
            if (info.kind == FieldKind::Number || info.kind == FieldKind::Integer) {
                const std::string why = test::errorOf([&] { parseFieldValue(info, "0,5"); });
                QVERIFY2(why.ends_with("= 0,5: has a decimal comma; write a decimal point"), why.c_str());
            }
        const FieldValue list{std::vector{0.0, 5.0}};
        for (const FieldInfo &info : fields())
            if (info.kind == FieldKind::Numbers)
                QVERIFY(parseFieldValue(info, "0,5") == list);
    }

    void numbersReadBackBitForBit()
    {
        Random random(1, 2);
        int tried = 0;
        while (tried < 20000) {
            const std::uint64_t bits = std::uint64_t(random.bits()) << 32 | random.bits();
            double value;
            std::memcpy(&value, &bits, sizeof value);
            if (!std::isfinite(value) || value == 0.0)
                continue;
            ++tried;
            const std::string text = formatNumber(value);
            QVERIFY2(parseNumber(text) == value, text.c_str());
            // Qt's reader, another one, in the C locale: the same number.
            QVERIFY2(QByteArray::fromStdString(text).toDouble() == value, text.c_str());
            // No shorter form would do: with the last digit left out it is another number.
            const std::size_t end = std::min(text.find('e'), text.size());
            const std::string shorter = text.substr(0, end - 1) + text.substr(end);
            if (text.find('.') < end - 2)
                QVERIFY2(parseNumber(shorter) != value, text.c_str());
        }
    }

    void textThatIsNoNumber_data()
    {
        QTest::addColumn<QByteArray>("text");
        for (const char *text : {"", " ", " 1", "1 ", "1,5", "1.5.2", "0x10", "1e", "e5", "+", "-", "--1", "+-1", "++1",
                                 "1_000", "1e999", "½"})
            QTest::newRow(text) << QByteArray(text);
        QTest::newRow("a zero byte") << QByteArray("1\0", 2);
    }

    void textThatIsNoNumber()
    {
        QFETCH(QByteArray, text);
        QVERIFY(!parseNumber(text.toStdString()));
    }

    void tablesReachTheirStruct()
    {
        Lamp lamp;
        for (const auto &[name, text] : std::vector<std::pair<const char *, const char *>>{
                 {"on", "yes"}, {"count", "5"}, {"watts", "60"}, {"colour", "green"}, {"hours", "3"}})
            fieldOf(name).set(lamp, parseFieldValue(fieldOf(name), text));
        QCOMPARE(lamp.isOn, true);
        QCOMPARE(lamp.count, 5);
        QCOMPARE(lamp.watts, 60.0);
        QCOMPARE(lamp.colour, Colour::Green);
        QCOMPARE(lamp.hours, std::vector<double>{3.0});
    }

    void tablesOfWhatIsNotHeld()
    {
        struct House {
            std::optional<Lamp> lamp;
        };
        const auto table =
            within<House>("lamp", fields(), [](auto &house) { return house.lamp ? &*house.lamp : nullptr; });
        QCOMPARE(table.at(2).name, std::string("lamp.watts"));
        QCOMPARE(table.at(2).unit, std::string("W"));
        House house;
        QVERIFY(!table.at(2).get(house));
        table.at(2).set(house, 50.0); // falls on nothing
        QVERIFY(!house.lamp);
        house.lamp = Lamp{};
        table.at(2).set(house, 50.0);
        QCOMPARE(std::get<double>(table.at(2).get(house).value()), 50.0);
    }

private:
    test::CommaLocale m_locale; ///< for every test of the class
};

FAINTLINE_TEST(tst_Field)
#include "tst_Field.moc"
