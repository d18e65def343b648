#pragma once

#include <QAbstractTableModel>

#include <functional>
#include <limits>
#include <vector>

namespace faintline {

/// A column of a table whose rows are of some type.
template <class Row>
struct ShownColumn {
    QString heading;
    std::function<QString(const Row &)> text = {};
    std::function<double(const Row &)> key = {}; ///< orders the rows, NaN last; without it, their text does
    Qt::Alignment alignment = Qt::AlignRight;
    QString tip = {};                                  ///< of the heading
    QString spoken = {};                               ///< the heading in full, if it is short for something
    std::function<QVariant(const Row &)> colour = {};  ///< of the text, a brush; null: as usual
    std::function<QVariant(const Row &)> cellTip = {}; ///< null: none
};

/// A heading and the cells of a column, of a table whose values are given.
struct TableHeading {
    QString text;
    QString tip = {};
    Qt::Alignment alignment = Qt::AlignRight;
};
struct TableCell {
    QString text;
    double key = std::numeric_limits<double>::quiet_NaN(); ///< a column without any is ordered by its text
    QVariant colour = {};                                  ///< of the text
    bool isFaint = false;
};

/// The model of every table: a list of columns over the numbers of rows.
class ColumnModel : public QAbstractTableModel
{
public:
    static constexpr int SortRole = Qt::UserRole;

    using QAbstractTableModel::QAbstractTableModel;

    /// Replaces everything by these values.
    void show(const std::vector<TableHeading> &headings, std::vector<std::vector<TableCell>> rows = {});
    /// Keeps the headings.
    void clear();

    int rowCount(const QModelIndex &parent = {}) const override { return parent.isValid() ? 0 : m_rows; }
    int columnCount(const QModelIndex &parent = {}) const override;
    QVariant data(const QModelIndex &index, int role = Qt::DisplayRole) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role = Qt::DisplayRole) const override;

protected:
    /// For rows that a derived model holds. Tells nobody: that model does.
    void setColumns(std::vector<ShownColumn<int>> columns) { m_columns = std::move(columns); }
    void setRowCount(int rows) { m_rows = rows; }

private:
    std::vector<ShownColumn<int>> m_columns;
    int m_rows = 0;
};

} // namespace faintline
