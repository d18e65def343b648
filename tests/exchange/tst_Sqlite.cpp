#include "exchange/survey/Sqlite.h"
#include "support/test.h"

#include "support/recordings.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

using namespace faintline;
using namespace faintline::test;

/// Values read back are those written; a file that cannot be opened gives an error of one line.
class tst_Sqlite : public QObject
{
    Q_OBJECT

private slots:
    void valuesComeBack()
    {
        const std::string path = emptyFile("values");
        const std::string text("quo'te\0and µ", 13);
        constexpr auto largest = std::numeric_limits<std::int64_t>::max();
        {
            Sqlite database(path, Sqlite::Access::Write);
            database.execute("CREATE TABLE t (a REAL, b INTEGER, c TEXT)");
            SqliteStatement insert = database.prepare("INSERT INTO t VALUES (?, ?, ?)");
            insert.run(0.1, largest, text);
            insert.run(-5e-324, -7, std::string());
            insert.run(std::numeric_limits<double>::infinity(), std::int64_t(0), std::string("x"));
        }
        Sqlite database(path, Sqlite::Access::Read);
        QCOMPARE(database.path(), path);
        QCOMPARE(database.integer("SELECT count(*) FROM t"), std::int64_t(3));
        SqliteStatement select = database.prepare("SELECT a, b, c FROM t ORDER BY rowid");
        QCOMPARE(select.columnCount(), 3);
        QVERIFY(select.next());
        QVERIFY(select.number(0) == 0.1);
        QCOMPARE(select.integer(1), largest);
        QCOMPARE(select.text(2), text);
        QVERIFY(select.next());
        QVERIFY(select.number(0) == -5e-324);
        QCOMPARE(select.integer(1), std::int64_t(-7));
        QCOMPARE(select.text(2), std::string());
        QVERIFY(!select.isNull(2));
        QVERIFY(select.next());
        QVERIFY(std::isinf(select.number(0)));
        QVERIFY(!select.next());
    }

    void nothingIsNull()
    {
        Sqlite database(emptyFile("null"), Sqlite::Access::Fill);
        database.execute("CREATE TABLE t (a REAL, b REAL, c REAL)");
        database.prepare("INSERT INTO t VALUES (?, ?, ?)")
            .run(std::nan(""), std::optional<double>(), std::optional(2.5));
        SqliteStatement select = database.prepare("SELECT a, b, c FROM t");
        QVERIFY(select.next());
        QVERIFY(select.isNull(0) && select.isNull(1) && !select.isNull(2));
        QVERIFY(std::isnan(select.number(0)) && !select.optionalNumber(1));
        QCOMPARE(*select.optionalNumber(2), 2.5);
        QCOMPARE(select.text(1), std::string());
    }

    void statementsBeginAgain()
    {
        Sqlite database(emptyFile("again"), Sqlite::Access::Fill);
        database.execute("CREATE TABLE t (a INTEGER)");
        SqliteStatement insert = database.prepare("INSERT INTO t VALUES (?)");
        for (int i = 1; i <= 5; ++i)
            insert.run(i);
        SqliteStatement above = database.prepare("SELECT a FROM t WHERE a > ? ORDER BY a");
        QVERIFY(above.with(3).next());
        QCOMPARE(above.integer(0), std::int64_t(4));
        QVERIFY(above.with(1).next()); // before all rows of the last query were read
        QCOMPARE(above.integer(0), std::int64_t(2));
        QVERIFY(!above.with(5).next());
        QVERIFY(above.with(4).next() && !above.next());
        QCOMPARE(database.integer("SELECT a FROM t WHERE a > 5"), std::int64_t(0)); // no row: 0
    }

    void columnsAreCopied()
    {
        Sqlite database(emptyFile("copied"), Sqlite::Access::Fill);
        database.execute("CREATE TABLE t (a)");
        database.execute("INSERT INTO t VALUES (1.5), ('text'), (NULL), (x'00ff')");
        SqliteStatement from = database.prepare("SELECT a FROM t ORDER BY rowid LIMIT 4");
        SqliteStatement same = database.prepare("SELECT typeof(?1)");
        QStringList kinds;
        while (from.next()) {
            same.reset();
            same.bindColumn(1, from, 0);
            QVERIFY(same.next());
            kinds += QString::fromStdString(same.text(0));
        }
        QCOMPARE(kinds, QStringList({"real", "text", "null", "blob"}));
    }

    void readersDoNotWrite()
    {
        const std::string path = emptyFile("read");
        Sqlite(path, Sqlite::Access::Write).execute("CREATE TABLE t (a INTEGER)");
        Sqlite reader(path, Sqlite::Access::Read);
        const std::string refusal = errorOf([&] { reader.execute("INSERT INTO t VALUES (1)"); });
        QVERIFY2(refusal.starts_with(path + ": SQLite: "), refusal.c_str());
        QCOMPARE(reader.integer("SELECT count(*) FROM t"), std::int64_t(0));
    }

    void namesWithAMeaningAreFiles()
    {
        namespace fs = std::filesystem;
        const fs::path before = fs::current_path();
        fs::current_path(m_folder.path().toStdString());
        std::ofstream(":memory:").close();
        Sqlite(":memory:", Sqlite::Access::Write).execute("CREATE TABLE t (a INTEGER)");
        const std::int64_t rows = Sqlite(":memory:", Sqlite::Access::Read).integer("SELECT count(*) FROM t");
        const auto bytes = fs::file_size(":memory:");
        fs::current_path(before);
        QCOMPARE(rows, std::int64_t(0));
        QVERIFY(bytes > 0);
    }

    void refusals()
    {
        const auto opening = [](const std::string &path) {
            return errorOf([&] { Sqlite(path, Sqlite::Access::Read).integer("SELECT count(*) FROM sqlite_schema"); });
        };
        const std::string nowhere = m_folder.filePath("nowhere").toStdString();
        QCOMPARE(opening(nowhere), nowhere + ": there is no such file");
        const std::string folder = m_folder.path().toStdString();
        QCOMPARE(opening(folder), folder + ": is not a file; expected a survey, .sqlite");
        const std::string other = emptyFile("other");
        writeBytes(other, QByteArray(4096, 'x'));
        QCOMPARE(opening(other), other + ": is not an SQLite database");
        Sqlite database(emptyFile("sql"), Sqlite::Access::Write);
        QVERIFY(contains(errorOf([&] { database.execute("SELEC 1"); }), "syntax error"));
        QVERIFY(contains(errorOf([&] { database.execute("SELECT a FROM nowhere"); }), "no such table"));
    }

    void aDamagedFile()
    {
        const std::string path = emptyFile("damaged");
        {
            Sqlite database(path, Sqlite::Access::Write);
            database.execute("CREATE TABLE t (a TEXT)");
            database.execute("BEGIN");
            SqliteStatement insert = database.prepare("INSERT INTO t VALUES (?)");
            for (int i = 0; i < 200; ++i)
                insert.run(std::string(200, 'y'));
            database.execute("COMMIT");
        }
        QByteArray bytes = readBytes(path);
        QVERIFY(bytes.size() > 16384);
        bytes.replace(4096, bytes.size() - 4096, QByteArray(bytes.size() - 4096, '\xff'));
        writeBytes(path, bytes);
        QCOMPARE(errorOf([&] {
                     Sqlite database(path, Sqlite::Access::Read);
                     SqliteStatement all = database.prepare("SELECT a FROM t");
                     while (all.next()) {
                     }
                 }),
                 path + ": is a damaged SQLite database");
    }

    /// Pages that refer to each other in a cycle give such rows.
    void rowsWithoutEnd()
    {
        const std::string path = emptyFile("endless");
        Sqlite(path, Sqlite::Access::Write).execute("CREATE TABLE t (a INTEGER)");
        Sqlite database(path, Sqlite::Access::Read);
        const std::string endless = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) ";
        QCOMPARE(errorOf([&] { database.execute(endless + "SELECT i FROM n"); }),
                 path + ": is a damaged SQLite database");
        QCOMPARE(database.integer("SELECT count(*) FROM t"), std::int64_t(0)); // which is still usable
        QCOMPARE(errorOf([&] { database.integer(endless + "SELECT count(*) FROM n"); }),
                 path + ": is a damaged SQLite database");
    }

    void aLockedFile()
    {
        const std::string path = emptyFile("locked");
        Sqlite writer(path, Sqlite::Access::Write);
        writer.execute("CREATE TABLE t (a INTEGER)");
        writer.execute("BEGIN IMMEDIATE");
        writer.execute("INSERT INTO t VALUES (1)");
        Sqlite other(path, Sqlite::Access::Write, std::chrono::milliseconds(50));
        QCOMPARE(other.integer("SELECT count(*) FROM t"), std::int64_t(0)); // not committed yet
        QCOMPARE(errorOf([&] { other.execute("INSERT INTO t VALUES (2)"); }), path + ": is in use by another program");
        int asked = 0;
        other.waitWhile([&] { return ++asked < 3; });
        QCOMPARE(errorOf([&] { other.execute("INSERT INTO t VALUES (2)"); }), path + ": is in use by another program");
        QCOMPARE(asked, 3);
        writer.execute("COMMIT");
        other.execute("INSERT INTO t VALUES (2)");
        QCOMPARE(writer.integer("SELECT sum(a) FROM t"), std::int64_t(3));
    }

private:
    std::string emptyFile(const char *name) const
    {
        const std::string path = m_folder.filePath(name).toStdString();
        writeBytes(path, QByteArray());
        return path;
    }

    QTemporaryDir m_folder;
};

FAINTLINE_TEST(tst_Sqlite)
#include "tst_Sqlite.moc"
