#include "support/test.h"
#include "widgets/table/ColumnTable.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QHeaderView>

using namespace faintline;

/// What all tables do with rows: their order, copies, and files.
class tst_ColumnTable : public QObject
{
    Q_OBJECT

private:
    /// A table of three rows, of which the second has no number.
    static std::unique_ptr<ColumnTable> table()
    {
        auto table = std::make_unique<ColumnTable>("Values");
        table->show({{"Name", {}, Qt::AlignLeft}, {"Value"}},
                    {{{"first, of \"all\""}, {"−3·10⁻²⁵", -3e-25}}, {{"second"}, {"–"}}, {{"third"}, {"20", 20.0}}});
        return table;
    }

    static QStringList names(const ColumnTable &table)
    {
        QStringList names;
        for (int row = 0; row < table.model()->rowCount(); ++row)
            names << table.model()->index(row, 0).data().toString().section(QRegularExpression("[ ,]"), 0, 0);
        return names;
    }

    static void clickHeading(ColumnTable &table, int column)
    {
        const QHeaderView &header = *table.horizontalHeader();
        QTest::mouseClick(
            header.viewport(), Qt::LeftButton, {},
            {header.sectionViewportPosition(column) + header.sectionSize(column) / 2, header.height() / 2});
    }

private slots:
    void aHeadingSortsBothWaysAndNotAtAll()
    {
        const auto shown = table();
        shown->resize(400, 200);
        shown->show();
        clickHeading(*shown, 1);
        QCOMPARE(names(*shown), (QStringList{"first", "third", "second"}));
        clickHeading(*shown, 1);
        QCOMPARE(names(*shown), (QStringList{"third", "first", "second"})); // without a number: last again
        clickHeading(*shown, 1);
        QCOMPARE(names(*shown), (QStringList{"first", "second", "third"}));
    }

    void theArrowOfTheSortedColumnLeavesItsHeadingReadable()
    {
        const auto shown = table();
        shown->resize(400, 200);
        shown->show();
        const int text = shown->horizontalHeader()->fontMetrics().horizontalAdvance("Value");
        shown->setColumnWidth(1, text + 6);
        clickHeading(*shown, 1);
        QVERIFY(shown->columnWidth(1) >= text + 18);
    }

    /// What the columns leave of the line of headings looks as they do.
    void theLineOfHeadingsHasOneColour()
    {
        const auto shown = table();
        shown->resize(600, 100);
        const QImage picture = shown->grab().toImage();
        const int y = shown->horizontalHeader()->height() / 2;
        const int headings = picture.pixelColor(shown->columnWidth(0) - 4, y).lightness();
        QVERIFY(std::abs(picture.pixelColor(590, y).lightness() - headings) < 3); // the window's differs by 4
    }

    void numbersAreWrittenAsProgramsReadThem()
    {
        QCOMPARE(table()->csv(), std::string("Name,Value\n\"first, of \"\"all\"\"\",-3e-25\nsecond,–\nthird,20\n"));
    }

    void rowsAreCopied()
    {
        const auto shown = table();
        shown->selectRow(0);
        shown->actions().front()->trigger();
        QCOMPARE(QGuiApplication::clipboard()->text(), QString("first, of \"all\"\t-3e-25"));
        shown->clearSelection();
        shown->actions().front()->trigger(); // nothing: what was copied stays
        QCOMPARE(QGuiApplication::clipboard()->text(), QString("first, of \"all\"\t-3e-25"));
    }
};

FAINTLINE_WINDOW_TEST(tst_ColumnTable)
#include "tst_ColumnTable.moc"
