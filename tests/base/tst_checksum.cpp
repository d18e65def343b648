#include "base/files/checksum.h"
#include "support/test.h"

using namespace faintline;

/// Checksums as others compute them.
class tst_checksum : public QObject
{
    Q_OBJECT

private slots:
    void isFnv1a_data()
    {
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<QString>("digits");
        // Fowler, Noll and Vo's own test vectors.
        QTest::newRow("nothing") << QByteArray() << "cbf29ce484222325";
        QTest::newRow("a") << QByteArray("a") << "af63dc4c8601ec8c";
        QTest::newRow("foobar") << QByteArray("foobar") << "85944171f73967e8";
        QTest::newRow("a zero byte") << QByteArray("\0", 1) << "af63bd4c8601b7df";
    }

    void isFnv1a()
    {
        QFETCH(QByteArray, text);
        QFETCH(QString, digits);
        QCOMPARE(QString::fromStdString(checksum(text.toStdString())), digits);
    }
};

FAINTLINE_TEST(tst_checksum)
#include "tst_checksum.moc"
