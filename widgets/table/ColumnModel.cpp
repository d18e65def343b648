#include "widgets/table/ColumnModel.h"

#include <QBrush>
#include <QGuiApplication>
#include <QPalette>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace faintline {

void ColumnModel::show(const std::vector<TableHeading> &headings, std::vector<std::vector<TableCell>> rows)
{
    beginResetModel();
    m_rows = int(rows.size());
    m_columns.clear();
    const auto shared = std::make_shared<const std::vector<std::vector<TableCell>>>(std::move(rows));
    for (const TableHeading &heading : headings) {
        const auto cell = [shared, column = m_columns.size()](int row) -> const TableCell & {
            return (*shared)[std::size_t(row)][column];
        };
        const bool hasKeys = std::ranges::any_of(
            *shared, [column = m_columns.size()](const auto &row) { return !std::isnan(row[column].key); });
        m_columns.push_back({.heading = heading.text,
                             .text = [cell](int row) { return cell(row).text; },
                             .alignment = heading.alignment,
                             .tip = heading.tip,
                             .colour =
                                 [cell](int row) {
                                     return cell(row).isFaint
                                                ? QGuiApplication::palette().brush(QPalette::Disabled, QPalette::Text)
                                                : cell(row).colour;
                                 }});
        if (hasKeys)
            m_columns.back().key = [cell](int row) { return cell(row).key; };
    }
    endResetModel();
}

void ColumnModel::clear()
{
    beginResetModel();
    m_rows = 0;
    for (ShownColumn<int> &column : m_columns) { // which hold the values
        column.text = {};
        column.key = {};
        column.colour = {};
    }
    endResetModel();
}

int ColumnModel::columnCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : int(m_columns.size());
}

QVariant ColumnModel::data(const QModelIndex &index, int role) const
{
    if (!index.isValid() || index.row() >= m_rows)
        return {};
    const ShownColumn<int> &column = m_columns[std::size_t(index.column())];
    switch (role) {
    case Qt::DisplayRole:
        return column.text(index.row());
    case SortRole:
        return column.key ? QVariant(column.key(index.row())) : column.text(index.row());
    case Qt::TextAlignmentRole:
        return QVariant::fromValue(column.alignment | Qt::AlignVCenter);
    case Qt::ForegroundRole:
        return column.colour ? column.colour(index.row()) : QVariant();
    case Qt::ToolTipRole:
        return column.cellTip ? column.cellTip(index.row()) : QVariant();
    case Qt::AccessibleTextRole:
        return QStringLiteral("%1: %2").arg(headerData(index.column(), Qt::Horizontal, role).toString(),
                                            column.text(index.row()));
    default:
        return {};
    }
}

QVariant ColumnModel::headerData(int section, Qt::Orientation orientation, int role) const
{
    if (orientation != Qt::Horizontal || section < 0 || section >= columnCount())
        return {};
    const ShownColumn<int> &column = m_columns[std::size_t(section)];
    switch (role) {
    case Qt::DisplayRole:
        return column.heading;
    case Qt::ToolTipRole:
        return column.tip.isEmpty() ? QVariant() : column.tip;
    case Qt::AccessibleTextRole:
        return column.spoken.isEmpty() ? column.heading : column.spoken;
    case Qt::TextAlignmentRole:
        return QVariant::fromValue(column.alignment | Qt::AlignVCenter);
    default:
        return {};
    }
}

} // namespace faintline
