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
    explicit ColumnTable(const QString &accessibleName, QWidget *parent = nullptr);

    using QTableView::show;
    /// Shows a model through a proxy that sorts by `ColumnModel::SortRole`; without a proxy, one of its own.
    void show(ColumnModel &model, ColumnProxy *proxy = nullptr);
    /// Shows values.
    void show(const std::vector<TableHeading> &headings, std::vector<std::vector<TableCell>> rows = {})
    {
        m_own->show(headings, std::move(rows));
    }
    void clear() { m_own->clear(); } ///< of values

    /// In small letters, for panels that are columns.
    void setSmall(int rowHeight = 22);

    /// Row of the model that is shown in a row of the table; -1 for none.
    int sourceRow(const QModelIndex &index) const;
    std::vector<int> selectedSourceRows() const; ///< in the order shown

    /// The shown columns and rows as they are shown, with their headings; numbers as programs read them.
    std::string csv() const;

private:
    void copy() const;               ///< the selected rows, to the clipboard
    QList<int> shownColumns() const; ///< from left to right
    QStringList textsOf(int row) const;

    ColumnModel *m_own;
    ColumnProxy *m_proxy = nullptr;
};

} // namespace faintline
