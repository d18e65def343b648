#pragma once

#include "analyse/columns.h"

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace faintline {

/// A text as one CSV field: quoted, quotes doubled.
std::string csvText(const std::string &text);

/// A text in XML or HTML, with entities for what has a meaning there.
std::string xmlText(std::string_view text);

/// What `textOf` makes of each column, separated by commas; the columns' names; the cells of a row.
template <class Row, class TextOf>
std::string csvLine(const std::vector<TableColumn<Row>> &columns, const TextOf &textOf)
{
    std::string line;
    for (const TableColumn<Row> &column : columns)
        line += (&column == &columns.front() ? "" : ",") + textOf(column);
    return line;
}
template <class Row>
std::string csvNames(const std::vector<TableColumn<Row>> &columns)
{
    return csvLine(columns, [](const TableColumn<Row> &column) { return column.name; });
}
template <class Row>
std::string csvCells(const std::vector<TableColumn<Row>> &columns, const std::type_identity_t<Row> &row)
{
    return csvLine(columns, [&](const TableColumn<Row> &column) { return cellText(column.value(row)); });
}

} // namespace faintline
