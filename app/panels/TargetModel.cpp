#include "app/panels/TargetModel.h"

#include <algorithm>
#include <utility>

namespace faintline {

TargetModel::TargetModel(SceneEditor &editor, QObject *parent) : QAbstractTableModel(parent), m_editor(editor)
{
    connect(&editor, &SceneEditor::sceneChanged, this, &TargetModel::follow);
    connect(&editor, &SceneEditor::rateUnitChanged, this, [this] {
        follow();
        emit headerDataChanged(Qt::Horizontal, 0, targetColumnCount - 1);
    });
    follow();
}

/// Rows that stay keep the open cell editor and the selection.
void TargetModel::follow()
{
    const PingScene *scene = m_editor.scene();
    std::vector<TargetRow> rows = scene ? targetRows(*scene) : std::vector<TargetRow>();
    if (rows.size() != m_rows.size()) {
        beginResetModel();
        m_rows = std::move(rows);
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
    const PingScene *scene = m_editor.scene();
    if (!index.isValid() || !scene)
        return {};
    const TargetRow &row = m_rows[std::size_t(index.row())];
    const auto column = TargetColumn(index.column());
    switch (role) {
    case Qt::EditRole:
        return textOf(*scene, row, column, m_editor.rateUnit());
    case Qt::DisplayRole:
        return textOf(*scene, row, column, m_editor.rateUnit()).replace(QLatin1Char('-'), QChar(0x2212));
    case Qt::TextAlignmentRole:
        return int(column == TargetColumn::Target ? Qt::AlignLeft | Qt::AlignVCenter
                                                  : Qt::AlignRight | Qt::AlignVCenter);
    case Qt::ToolTipRole:
        return sentenceOf(column, m_editor.rateUnit());
    default:
        return {};
    }
}

QVariant TargetModel::headerData(int section, Qt::Orientation orientation, int role) const
{
    if (orientation != Qt::Horizontal)
        return {};
    if (role == Qt::DisplayRole)
        return titleOf(TargetColumn(section), m_editor.rateUnit());
    if (role == Qt::ToolTipRole)
        return sentenceOf(TargetColumn(section), m_editor.rateUnit());
    return {};
}

Qt::ItemFlags TargetModel::flags(const QModelIndex &index) const
{
    Qt::ItemFlags flags = QAbstractTableModel::flags(index);
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
