#pragma once

#include <QStringList>

class QTableView;
class QTableWidget;

namespace faintline {

/// A table of numbers to read, row by row: nothing in it can be edited.
void makeReadingTable(QTableView &table, int rowHeight);

/// Texts of a row, to the right but for the first `leftColumns`.
void fillRow(QTableWidget &table, int row, const QStringList &texts, int leftColumns = 0);

} // namespace faintline
