#include "app/features/targets/TargetModel.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace faintline {

TargetModel::TargetModel(SceneEditor &editor, QObject *parent) : ColumnModel(parent), m_editor(editor)
{
    connect(&editor, &SceneEditor::sceneChanged, this, &TargetModel::follow);
    connect(&editor, &SceneEditor::rateUnitChanged, this, [this] {
        layColumns();
        follow();
        emit headerDataChanged(Qt::Horizontal, 0, targetColumnCount - 1);
    });
    layColumns();
    follow();
}

void TargetModel::layColumns()
{
    std::vector<ShownColumn<int>> columns;
    for (int i = 0; i < targetColumnCount; ++i) {
        const auto column = TargetColumn(i);
        const QString sentence = sentenceOf(column, m_editor.rateUnit());
        columns.push_back(
            {.heading = titleOf(column, m_editor.rateUnit()),
             .text =
                 [this, i](int row) {
                     return data(index(row, i), Qt::EditRole).toString().replace(QLatin1Char('-'), QChar(0x2212));
                 },
             .alignment = column == TargetColumn::Target ? Qt::AlignLeft : Qt::AlignRight,
             .tip = sentence,
             .cellTip = [sentence](int) { return sentence; }});
    }
    for (int i = 0; i < targetColumnCount; ++i)
        if (TargetColumn(i) != TargetColumn::Fluctuation) // a word
            columns[std::size_t(i)].key = [this, i](int row) { return keyAt(row, TargetColumn(i)); };
    setColumns(std::move(columns));
}

double TargetModel::keyAt(int row, TargetColumn column) const
{
    if (column == TargetColumn::Target)
        return m_rows[std::size_t(row)].target;
    bool isNumber = false;
    const double number = data(index(row, int(column)), Qt::EditRole).toString().toDouble(&isNumber);
    return isNumber ? number : std::numeric_limits<double>::quiet_NaN();
}

/// Rows that stay keep the open cell editor and the selection.
void TargetModel::follow()
{
    const PingScene *scene = m_editor.scene();
    std::vector<TargetRow> rows = scene ? targetRows(*scene) : std::vector<TargetRow>();
    if (rows.size() != m_rows.size()) {
        beginResetModel();
        m_rows = std::move(rows);
        setRowCount(int(m_rows.size()));
        endResetModel();
    } else if (!rows.empty()) {
        m_rows = std::move(rows);
        emit dataChanged(index(0, 0), index(int(m_rows.size()) - 1, targetColumnCount - 1));
    }
}

TargetHandle TargetModel::handleAt(const QModelIndex &index) const
{
    if (!index.isValid() || index.row() >= int(m_rows.size()))
        return {};
    const TargetRow &row = m_rows[std::size_t(index.row())];
    const bool isLeg = isOfLeg(TargetColumn(index.column())) || !row.isFirst();
    return {row.target, isLeg ? row.leg + 1 : 0};
}

QModelIndex TargetModel::indexOf(const TargetHandle &handle, int column) const
{
    const TargetRow wanted{handle.target, handle.corner - 1};
    const auto found = std::find_if(m_rows.begin(), m_rows.end(), [&](const TargetRow &row) {
        return row == wanted || (handle.corner == 0 && row.target == handle.target);
    });
    return found == m_rows.end() ? QModelIndex() : index(int(found - m_rows.begin()), column);
}

QVariant TargetModel::data(const QModelIndex &index, int role) const
{
    if (!m_editor.scene() || !index.isValid())
        return {};
    return role == Qt::EditRole ? textOf(*m_editor.scene(), m_rows[std::size_t(index.row())],
                                         TargetColumn(index.column()), m_editor.rateUnit())
                                : ColumnModel::data(index, role);
}

Qt::ItemFlags TargetModel::flags(const QModelIndex &index) const
{
    Qt::ItemFlags flags = ColumnModel::flags(index);
    if (index.isValid() && isEditable(m_rows[std::size_t(index.row())], TargetColumn(index.column())))
        flags |= Qt::ItemIsEditable;
    return flags;
}

bool TargetModel::setData(const QModelIndex &index, const QVariant &value, int role)
{
    const PingScene *scene = m_editor.scene();
    if (!index.isValid() || !scene || role != Qt::EditRole)
        return false;
    if (value.toString() == data(index, Qt::EditRole).toString())
        return true; // the digits that are not shown stay
    try {
        const auto column = TargetColumn(index.column());
        m_editor.replace(
            withText(*scene, m_rows[std::size_t(index.row())], column, value.toString(), m_editor.rateUnit()),
            isOfLeg(column) ? tr("Change a leg") : tr("Change a target"));
        emit accepted();
        return true;
    } catch (const Error &error) {
        emit refused(error);
        return false;
    }
}

} // namespace faintline
