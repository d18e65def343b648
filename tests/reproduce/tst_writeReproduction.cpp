#include "reproduce/writeReproduction.h"
#include "support/test.h"

#include "base/json.h"
#include "support/recordings.h"

using namespace faintline;
using namespace faintline::test;

namespace {

/// Three cells: one inside by its interval, one exact and outside, one that nothing is held against.
Reproduction table()
{
    Reproduction made;
    made.name = "billon:table9";
    made.title = "What is not printed there";
    made.quantity = "Pd";
    ReproducedCell inside;
    inside.row = "0 dB";
    inside.column = "SMD";
    inside.paper = 0.5;
    inside.paperError = 0.0625;
    inside.reference = 0.52;
    inside.tolerance = 0.001;
    inside.ours = 0.53125;
    inside.interval = {0.5, 0.5625};
    ReproducedCell outside;
    outside.row = "σ = 1, \"known\"";
    outside.column = "exact";
    outside.reference = 2.0;
    outside.tolerance = 0.125;
    outside.ours = 2.5;
    ReproducedCell notJudged;
    notJudged.row = "3 dB";
    notJudged.column = "SMD";
    notJudged.paper = 0.75;
    notJudged.ours = 0.8125;
    made.cells = {inside, outside, notJudged};
    made.notes = {"The paper rounds to two digits."};
    return made;
}

} // namespace

/// A reproduction as a table for reading, as JSON, and in a folder.
class tst_writeReproduction : public QObject
{
    Q_OBJECT

private slots:
    void tableForReading()
    {
        const QStringList lines = QString::fromStdString(reproductionText(table())).split('\n');
        QCOMPARE(lines.size(), 1 + 4 + 1 + 1); // the last is empty
        QCOMPARE(lines[0], QString("billon:table9: What is not printed there (Pd)"));
        const auto words = [&](int line) { return lines[line].split(QRegularExpression("  +"), Qt::SkipEmptyParts); };
        QCOMPARE(words(1), QStringList({"paper", "ours", "95 % interval", "gap", "z", "reference ± tolerance"}));
        // One standard error is 0.0625/3.92; with the paper's 0.0625 the gap of 0.03125 is 0.4845 of them.
        QCOMPARE(words(2), QStringList({"0 dB", "SMD", "0.5", "0.5312", "0.5 … 0.5625", "0.03125", "0.4845",
                                        "0.52 ± 0.001", "inside"}));
        QCOMPARE(words(3),
                 QStringList({"σ = 1, \"known\"", "exact", "-", "2.5", "exact", "-", "-", "2 ± 0.125", "OUTSIDE"}));
        QCOMPARE(words(4), QStringList({"3 dB", "SMD", "0.75", "0.8125", "exact", "0.0625", "-", "-", "not judged"}));
        QCOMPARE(lines[5], QString("note: The paper rounds to two digits."));
    }

    // By characters, not by bytes: σ and … are longer than one.
    void columnsAreAligned()
    {
        const QStringList lines = QString::fromStdString(reproductionText(table())).split('\n');
        const auto endOf = [&](int line, const QString &word) { return lines[line].indexOf(word) + word.size(); };
        QCOMPARE(endOf(2, "0.5312"), endOf(3, "2.5"));
        QCOMPARE(endOf(2, "0.5312"), endOf(4, "0.8125"));
        QCOMPARE(endOf(2, "0.52 ± 0.001"), endOf(3, "2 ± 0.125"));
        QCOMPARE(lines[2].indexOf("SMD"), lines[3].indexOf("exact"));
        QCOMPARE(lines[2].indexOf("inside"), lines[3].indexOf("OUTSIDE"));
        for (const QString &line : lines)
            QVERIFY(!line.endsWith(' '));
    }

    void jsonOfACell()
    {
        const Json json = parseJson(reproductionJson(table()), "table");
        QVERIFY(json["name"] == "billon:table9" && json["quantity"] == "Pd" && json["inside"] == false);
        QVERIFY(json["notes"] == Json::array({"The paper rounds to two digits."}));
        const Json &inside = json["cells"][0];
        QVERIFY(inside["interval"] == Json::array({0.5, 0.5625}) && inside["inside"] == true);
        QCOMPARE(inside["gap"].get<double>(), 0.03125);
        const Json &outside = json["cells"][1];
        QVERIFY(outside["interval"].is_null() && outside["paper"].is_null() && outside["gap"].is_null()
                && outside["z"].is_null() && outside["inside"] == false);
        const Json &notJudged = json["cells"][2];
        QVERIFY(notJudged["inside"].is_null() && notJudged["reference"].is_null() && notJudged["tolerance"].is_null());
        QCOMPARE(notJudged["gap"].get<double>(), 0.0625);
    }

    void filesOfAFolder()
    {
        const QTemporaryDir folder;
        const std::string inner = folder.filePath("deep/er").toStdString();
        Reproduction made = table();
        Chart chart{"Chart", "SNR (dB)", "Pd", false, false, {{"ours", Curve::Kind::Measured, {{0.0, 0.5, {}, {}}}}}};
        made.charts = {chart, chart, chart};
        writeReproduction(made, inner);
        QCOMPARE(QDir(QString::fromStdString(inner)).entryList(QDir::Files),
                 QStringList({"billon-table9-2.svg", "billon-table9-3.svg", "billon-table9.csv", "billon-table9.json",
                              "billon-table9.svg"}));
        QCOMPARE(QString::fromUtf8(readBytes(inner + "/billon-table9.csv")),
                 QString("row,column,paper,ours,low,high,reference,tolerance,verdict\n"
                         "\"0 dB\",\"SMD\",0.5,0.53125,0.5,0.5625,0.52,0.001,inside\n"
                         "\"σ = 1, \"\"known\"\"\",\"exact\",,2.5,,,2,0.125,OUTSIDE\n"
                         "\"3 dB\",\"SMD\",0.75,0.8125,,,,,not judged\n"));
        QCOMPARE(readBytes(inner + "/billon-table9.json").toStdString(), reproductionJson(made) + "\n");
        QVERIFY(readBytes(inner + "/billon-table9-3.svg").contains("<svg"));
    }

    void aFolderThatCannotBe()
    {
        const QTemporaryDir folder;
        const std::string file = folder.filePath("file").toStdString();
        writeBytes(file, "x");
        const std::string refusal = errorOf([&] { writeReproduction(table(), file + "/inside"); });
        QVERIFY2(refusal.starts_with(file + "/inside: cannot be created: "), refusal.c_str());
    }

    void emptyTable()
    {
        Reproduction made;
        made.name = "a:b";
        QVERIFY(reproductionText(made).starts_with("a:b:  ()\n"));
        const Json json = parseJson(reproductionJson(made), "table");
        QVERIFY(json["cells"].is_array() && json["cells"].empty() && json["inside"] == true);
    }
};

FAINTLINE_TEST(tst_writeReproduction)
#include "tst_writeReproduction.moc"
