#pragma once

#include "widgets/table/ColumnModel.h"

#include <QSortFilterProxyModel>
#include <QTableView>

namespace faintline {

/// Orders a ColumnModel by its keys; rows without one are last in both orders.
class ColumnProxy : public QSortFilterProxyModel
{
public:
    using QSortFilterProxyModel::QSortFilterProxyModel;

protected:
    bool lessThan(const QModelIndex &left, const QModelIndex &right) const override;
};

/// A table to read: rows are selected, sorted by a click on a heading (a third click restores their order), and copied
/// by Ctrl+C.
class ColumnTable : public QTableView
{
    Q_OBJECT

public:
    /// Of the model's rows, through a proxy that sorts them by `ColumnModel::SortRole`; both are the caller's, or null.
    /// Without a model, of the values that are given to `show`.
    explicit ColumnTable(const QString &accessibleName, ColumnModel *model = nullptr, ColumnProxy *proxy = nullptr);

    using QTableView::show;
    void show(const std::vector<TableHeading> &headings, std::vector<std::vector<TableCell>> rows = {})
    {
        m_model->show(headings, std::move(rows));
    }
    void clear() { m_model->clear(); } ///< of values

    /// In small letters, for panels that are columns.
    void setSmall(int rowHeight = 22);

    /// Cell of the model that is shown in one of the table, and its row, -1 for none; and the other way.
    QModelIndex sourceIndex(const QModelIndex &index) const { return m_proxy->mapToSource(index); }
    int sourceRow(const QModelIndex &index) const { return sourceIndex(index).row(); }
    QModelIndex shownIndex(const QModelIndex &source) const { return m_proxy->mapFromSource(source); }
    std::vector<int> selectedSourceRows() const; ///< in the order shown

    /// Least width of a column whose heading is to be read, also beside the arrow of the column that is sorted.
    int headingWidth(int column) const;

    /// The shown columns and rows as they are shown, with their headings; numbers as programs read them.
    std::string csv() const;

private:
    void copy() const;               ///< the selected cells, to the clipboard
    QList<int> shownColumns() const; ///< from left to right
    QString textOf(int row, int column) const;

    ColumnModel *m_model;
    ColumnProxy *m_proxy;
};

} // namespace faintline
