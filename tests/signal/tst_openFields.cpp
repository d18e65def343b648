#include "signal/openFields.h"
#include "support/errors.h"
#include "support/test.h"

using namespace faintline;
using namespace faintline::test;

/// How raw files are read, as sessions and surveys keep it.
class tst_openFields : public QObject
{
    Q_OBJECT

private slots:
    void writtenOptionsAreReadAgain()
    {
        OpenOptions options{true, "ri16_le", 1000.0, 2, Index(3) << 30};
        QVERIFY(openOptionsFromJson(toJson(options), "session") == options);
        options.rawRateHz = 0.0; // told by the file's name
        QVERIFY(openOptionsFromJson(toJson(options), "session") == options);
        QVERIFY(toJson(OpenOptions()).empty());
    }

    /// Of earlier versions, which wrote other orders, short names, a rate of 0 and no type.
    void whatIsNotGivenMayStandThere()
    {
        const Json old = Json::parse(
            R"({"iq": false, "rawType": "ri16", "rawRateHz": 0.0, "rawChannels": 1, "rawHeaderBytes": 44})");
        const OpenOptions options = openOptionsFromJson(old, "session");
        QVERIFY(options == (OpenOptions{false, "ri16_le", 0.0, 1, 44}));
        QVERIFY(openOptionsFromJson(Json::parse(R"({"rawType": "", "rawRateHz": 0})"), "session") == OpenOptions());
    }

    void refusesWhatIsNoOption_data()
    {
        QTest::addColumn<QString>("json");
        QTest::addColumn<QString>("message");
        QTest::newRow("type") << R"({"rawType": null})"
                              << "session.rawType: must be a sample type, such as ci16_le";
        QTest::newRow("header") << R"({"rawHeaderBytes": -1})"
                                << "session.rawHeaderBytes = -1: must be 0 or more";
        QTest::newRow("rate") << R"({"rawRateHz": -1})"
                              << "session.rawRateHz = -1: must lie in 1e-09 … 1e+15 Hz";
    }

    void refusesWhatIsNoOption()
    {
        QFETCH(QString, json);
        QFETCH(QString, message);
        QCOMPARE(
            QString::fromStdString(errorOf([&] { openOptionsFromJson(Json::parse(json.toStdString()), "session"); })),
            message);
    }
};

FAINTLINE_TEST(tst_openFields)
#include "tst_openFields.moc"
