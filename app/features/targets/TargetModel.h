#pragma once

#include "app/features/targets/SceneEditor.h"
#include "app/features/targets/targetCells.h"

#include "widgets/table/ColumnModel.h"

namespace faintline {

/// Table model of the targets under edit. A number that is typed into a cell becomes a step of the document.
class TargetModel : public ColumnModel
{
    Q_OBJECT

public:
    explicit TargetModel(SceneEditor &editor, QObject *parent = nullptr);

    /// The corner that a cell describes: the end of its leg, or the target's start; and the cell of a corner.
    TargetHandle handleAt(const QModelIndex &index) const;
    QModelIndex indexOf(const TargetHandle &handle, int column) const;

    QVariant data(const QModelIndex &index, int role = Qt::DisplayRole) const override;
    Qt::ItemFlags flags(const QModelIndex &index) const override;
    bool setData(const QModelIndex &index, const QVariant &value, int role = Qt::EditRole) override;

signals:
    void refused(const faintline::Error &error);
    void accepted();

private:
    void layColumns();
    double keyAt(int row, TargetColumn column) const;
    void follow();

    SceneEditor &m_editor;
    std::vector<TargetRow> m_rows;
};

} // namespace faintline
