#include "app/lessons/Lesson.h"
#include "app/lessons/lessonMeasures.h"
#include "base/Error.h"
#include "base/json.h"
#include "support/test.h"

using namespace faintline;

/// The page on lessons says what the parser takes: all keys, measures that exist, and an example that is read.
class tst_lessonPage : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        QFile file(QStringLiteral(FAINTLINE_SOURCE_DIR "/docs/reference/lessons.md"));
        QVERIFY(file.open(QIODevice::ReadOnly));
        m_page = QString::fromUtf8(file.readAll());
        m_example = Json::parse(m_page.section("```json\n", 1).section("```", 0, 0).toStdString());
    }

    void theExampleIsRead() { QCOMPARE(read(m_example).steps.size(), std::size_t(2)); }

    void noKeyIsLeftOut_data()
    {
        QTest::addColumn<QString>("pointer");
        for (const char *pointer : {"", "/steps/0", "/steps/0/ask", "/steps/0/zoom", "/steps/0/cursor"})
            QTest::newRow(pointer) << QString::fromLatin1(pointer);
    }

    void noKeyIsLeftOut()
    {
        QFETCH(QString, pointer);
        Json lesson = m_example;
        lesson[Json::json_pointer(pointer.toStdString() + "/noSuchKey")] = 1;
        QStringList known;
        try {
            read(lesson);
        } catch (const Error &error) {
            known = QString::fromStdString(error.why()).section("expected one of ", 1).split(", ");
        }
        QVERIFY(known.size() >= 2);
        for (const QString &key : known)
            QVERIFY2(m_page.contains('`' + key + '`'), qPrintable(key));
    }

    void measuresExist()
    {
        const QString table = m_page.section("| measure |", 1);
        const QRegularExpression names(QStringLiteral("`([a-zA-Z0-9.]+)`"));
        int count = 0;
        for (auto i = names.globalMatch(table); i.hasNext(); ++count)
            checkMeasure(i.next().captured(1).toStdString(), "page"); // throws where there is none
        QVERIFY(count > 20);
    }

private:
    static Lesson read(const Json &lesson)
    {
        return lessonFromJson(lesson.dump(), QStringLiteral("/lessons/page.json"));
    }

    QString m_page;
    Json m_example;
};

FAINTLINE_WINDOW_TEST(tst_lessonPage)
#include "tst_lessonPage.moc"
