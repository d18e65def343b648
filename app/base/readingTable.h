#pragma once

#include <QStringList>

class QTableView;
class QTableWidget;

namespace faintline {

/// Makes a table read-only, selectable by rows.
void makeReadingTable(QTableView &table, int rowHeight);

/// Sets the texts of a row, right-aligned except for the first `leftColumns`.
void fillRow(QTableWidget &table, int row, const QStringList &texts, int leftColumns = 0);

} // namespace faintline
