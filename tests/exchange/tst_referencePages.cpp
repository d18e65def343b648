#include "evaluate/experiments/Campaign.h"
#include "evaluate/experiments/Experiment.h"
#include "exchange/survey/surveySchema.h"
#include "scene/LineScene.h"
#include "scene/PingScene.h"
#include "scene/ScanScene.h"
#include "signal/formats/gridFile.h"
#include "support/test.h"

#include <functional>

using namespace faintline;

namespace {

QString contentOf(const QString &page)
{
    QFile file(QStringLiteral(FAINTLINE_SOURCE_DIR "/docs/reference/") + page);
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

/// The rows of a page between "<!-- table NAME -->" and the next empty line, without the two of the heading.
QStringList rowsOf(const QString &page, const QString &name)
{
    const QString text = contentOf(page).section(QStringLiteral("<!-- table %1 -->\n").arg(name), 1);
    return text.section(QStringLiteral("\n\n"), 0, 0).split(QLatin1Char('\n'), Qt::SkipEmptyParts).mid(2);
}

QString rangeOf(const FieldInfo &info)
{
    if (info.kind == FieldKind::Flag)
        return QStringLiteral("true, false");
    if (info.kind == FieldKind::Choice) {
        QStringList choices;
        for (const std::string &choice : info.choices)
            choices << QString::fromStdString(choice);
        return choices.join(QStringLiteral(", "));
    }
    const QString range = QStringLiteral("%1 … %2").arg(QString::fromStdString(formatNumber(info.minimum)),
                                                        QString::fromStdString(formatNumber(info.maximum)));
    return info.unit.empty() ? range : range + QLatin1Char(' ') + QString::fromStdString(info.unit);
}

/// What a page has to say of a struct's keys.
template <class S>
QStringList rowsOf(const std::vector<Field<S>> &fields, const S &defaults = S())
{
    QStringList rows;
    for (const Field<S> &field : fields) {
        const auto value = field.get(defaults);
        rows << QStringLiteral("| `%1` | %2 | %3 | %4 |")
                    .arg(QString::fromStdString(field.name), rangeOf(field),
                         QString::fromStdString(value ? formatFieldValue(*value) : std::string()),
                         QString::fromStdString(field.sentence));
    }
    return rows;
}

QStringList rowsOf(Experiment::Kind kind)
{
    return rowsOf(Experiment::fields(kind), Experiment::of(kind));
}

/// The keys that a parser knows, from what it says of one that it does not.
QStringList knownTo(const std::function<void(const Json &)> &parse, Json object)
{
    object["noSuchKey"] = 1;
    try {
        parse(object);
    } catch (const Error &error) {
        const QString why = QString::fromStdString(error.why());
        return why.section(QStringLiteral("expected one of "), 1).split(QStringLiteral(", "));
    }
    return {};
}

GridFile readGrid(const Json &json, const std::vector<Index> &shape)
{
    QTemporaryDir folder;
    const QString path = folder.filePath("grid.json");
    QFile file(path);
    if (file.open(QIODevice::WriteOnly))
        file.write(QByteArray::fromStdString(json.dump()));
    file.close();
    return readGridFile(path.toStdString(), shape);
}

} // namespace

/// The pages of reference say what the parsers take: every key with its range and default, and examples that are read.
class tst_referencePages : public QObject
{
    Q_OBJECT

private slots:
    void keysWithTheirRanges_data()
    {
        QTest::addColumn<QString>("page");
        QTest::addColumn<QStringList>("rows");
        QTest::newRow("LineScene") << "scenes.md" << rowsOf(LineScene::fields());
        QTest::newRow("NoiseSettings") << "scenes.md" << rowsOf(NoiseSettings::fields());
        QTest::newRow("LineSettings") << "scenes.md" << rowsOf(LineSettings::fields());
        QTest::newRow("PingScene") << "scenes.md" << rowsOf(PingScene::fields());
        QTest::newRow("PingTarget") << "scenes.md" << rowsOf(PingTarget::fields());
        QTest::newRow("PingLeg") << "scenes.md" << rowsOf(PingLeg::fields());
        QTest::newRow("Reverberation") << "scenes.md" << rowsOf(Reverberation::fields());
        QTest::newRow("ScanScene") << "scenes.md" << rowsOf(ScanScene::fields());
        QTest::newRow("LineExperiment") << "experiments.md" << rowsOf(Experiment::Kind::Lines);
        QTest::newRow("InjectionExperiment") << "experiments.md" << rowsOf(Experiment::Kind::Injection);
        QTest::newRow("SweepExperiment") << "experiments.md" << rowsOf(Experiment::Kind::Sweep);
    }

    void keysWithTheirRanges()
    {
        QFETCH(QString, page);
        QFETCH(QStringList, rows);
        const QStringList written = rowsOf(page, QString::fromLatin1(QTest::currentDataTag()));
        for (const QString &row : rows)
            QVERIFY2(written.contains(row), qPrintable(rows.join(QLatin1Char('\n'))));
        QCOMPARE(written.size(), rows.size());
    }

    void noKeyIsLeftOut_data()
    {
        QTest::addColumn<QString>("page");
        QTest::addColumn<QStringList>("known");
        QTest::newRow("grid") << "grids.md"
                              << knownTo(
                                     [](const Json &json) {
                                         readGrid(json, {2, 3});
                                     },
                                     Json{{"axes", Json::array()}});
        const auto withEntries = [](const char *kind) { return Json{{"kind", kind}}; };
        QTest::newRow("injection") << "experiments.md"
                                   << knownTo([](const Json &json) { experimentFromJson(json, {}); },
                                              withEntries("injection"));
        QTest::newRow("sweep") << "experiments.md"
                               << knownTo([](const Json &json) { experimentFromJson(json, {}); }, withEntries("sweep"));
        QTest::newRow("lines") << "experiments.md"
                               << knownTo([](const Json &json) { experimentFromJson(json, {}); }, withEntries("lines"));
        QTest::newRow("lineScene") << "scenes.md"
                                   << knownTo([](const Json &json) { lineSceneFromJson(json); }, withEntries("lines"));
        QTest::newRow("pingScene") << "scenes.md"
                                   << knownTo([](const Json &json) { pingSceneFromJson(json); }, withEntries("pings"));
    }

    void noKeyIsLeftOut()
    {
        QFETCH(QString, page);
        QFETCH(QStringList, known);
        QVERIFY(known.size() > 1);
        const QString text = contentOf(page);
        for (const QString &key : known)
            QVERIFY2(text.contains(QLatin1Char('`') + key + QLatin1Char('`')), qPrintable(key));
    }

    void examplesAreRead_data()
    {
        QTest::addColumn<QString>("example");
        for (const char *page : {"scenes.md", "grids.md", "experiments.md"}) {
            const QString text = contentOf(QString::fromLatin1(page));
            const QRegularExpression blocks(QStringLiteral("```json\n(.*?)```"),
                                            QRegularExpression::DotMatchesEverythingOption);
            int number = 0;
            for (auto i = blocks.globalMatch(text); i.hasNext();)
                QTest::addRow("%s %d", page, ++number) << i.next().captured(1);
        }
    }

    void examplesAreRead()
    {
        QFETCH(QString, example);
        const Json json = parseJson(example.toStdString(), "example");
        const QString page = QString::fromLatin1(QTest::currentDataTag()).section(QLatin1Char(' '), 0, 0);
        if (page == QLatin1String("experiments.md"))
            experimentFromJson(json, {});
        else if (page == QLatin1String("grids.md"))
            readGrid(json,
                     json.at("axes").size() == 1 ? std::vector<Index>{60, 1000} : std::vector<Index>{60, 200, 20});
        else if (isPingScene(json))
            pingSceneFromJson(json);
        else if (json.value("kind", std::string()) == "scans")
            scanSceneFromJson(json);
        else
            lineSceneFromJson(json);
    }

    void tablesOfASurvey()
    {
        const QString text = contentOf(QStringLiteral("survey.md"));
        QString schema;
        for (const std::string &statement : surveySchema())
            schema += QString::fromStdString(statement) + QStringLiteral(";\n");
        QCOMPARE(text.section(QStringLiteral("```sql\n"), 1).section(QStringLiteral("```"), 0, 0), schema);
        QVERIFY(text.contains(QStringLiteral("0x%1").arg(surveyApplicationId, 0, 16)));
        QVERIFY(text.contains(QStringLiteral("`user_version` %1").arg(surveyFormat)));
        for (const SurveyTable &table : surveyTables())
            QVERIFY(text.contains(QStringLiteral("\n| `%1` |").arg(QString::fromStdString(table.name))));
    }
};

FAINTLINE_TEST(tst_referencePages)
#include "tst_referencePages.moc"
