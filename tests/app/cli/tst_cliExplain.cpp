#include "app/cli/CommandLineTest.h"
#include "base/json.h"
#include "support/test.h"

#include <cmath>

using namespace faintline;
using namespace faintline::test;

/// explain of a family: what each member brought.
class tst_cliExplain : public CommandLineTest
{
    Q_OBJECT

private slots:
    void initTestCase() { simulateLine(); }

    /// A line at 212 Hz, and nothing at twice of it.
    void tellsOfEachMember()
    {
        const Outcome told = run(cell + lineSettings + family + QStringList{"--json"});
        QCOMPARE(told.err, QByteArray());
        QCOMPARE(told.code, 0);
        const Json json = parseJson(told.out.toStdString(), "explain");
        const Json &members = json["members"];
        QCOMPARE(members.size(), std::size_t(2));
        for (int k = 0; k < 2; ++k) {
            const Json &member = members[std::size_t(k)];
            QCOMPARE(member["member"].get<double>(), k + 1.0);
            QVERIFY(std::abs(member["frequency"].get<double>() - (k + 1.0) * json["position"][0].get<double>()) < 1e-6);
            QCOMPARE(member["frames"].get<std::size_t>(), json["steps"].size());
            const auto db = member["power_db"].get<double>();
            QVERIFY2(k == 0 ? db > 5.0 : std::abs(db) < 2.0, qPrintable(QString::number(db)));
            QCOMPARE(member["evidence"].get<double>() > 0.0, k == 0);
        }
        const Outcome table = run(cell + lineSettings + family);
        const QList<QByteArray> lines = table.out.trimmed().split('\n');
        QVERIFY(lines[lines.size() - 3].trimmed().startsWith("multiple"));
        QVERIFY(lines[lines.size() - 2].trimmed().startsWith("1 "));
        QVERIFY2(lines.last().trimmed().startsWith("2 ")
                     && lines.last().endsWith("not seen: there is more evidence without it"),
                 lines.last().constData());
    }

    void tellsOfNoneWithoutAFamily()
    {
        const Outcome told = run(cell + lineSettings + QStringList{"--json"});
        QCOMPARE(told.code, 0);
        QVERIFY(!parseJson(told.out.toStdString(), "explain").contains("members"));
    }

private:
    inline static const QStringList cell{"explain", "line.wav", "--time", "18", "--frequency", "212"};
    inline static const QStringList family{"--set", "family.relation=harmonics", "--set", "family.members=1,2"};
};

FAINTLINE_TEST(tst_cliExplain)
#include "tst_cliExplain.moc"
