#include "app/base/readingTable.h"

#include "widgets/base/Theme.h"

#include <QHeaderView>
#include <QTableWidget>

namespace faintline {

void makeReadingTable(QTableView &table, int rowHeight)
{
    table.verticalHeader()->hide();
    table.verticalHeader()->setDefaultSectionSize(rowHeight);
    table.horizontalHeader()->setHighlightSections(false);
    table.setFont(Theme::font(12));
    table.horizontalHeader()->setFont(Theme::font(12));
    table.horizontalHeader()->setMinimumSectionSize(24);
    table.setSelectionBehavior(QAbstractItemView::SelectRows);
    table.setEditTriggers(QAbstractItemView::NoEditTriggers);
    table.setShowGrid(false);
    table.setFrameShape(QFrame::NoFrame);
}

void fillRow(QTableWidget &table, int row, const QStringList &texts, int leftColumns)
{
    for (int column = 0; column < texts.size(); ++column) {
        auto *item = new QTableWidgetItem(texts[column]);
        item->setTextAlignment((column < leftColumns ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
        table.setItem(row, column, item);
    }
}

} // namespace faintline
