#pragma once

#include "reproduce/reproduce.h"

#include <QWidget>

#include <memory>

class QComboBox;
class QLabel;

namespace faintline {

class ChartPlot;
class ColumnTable;

/// A table or figure of a publication compared with ours: each cell with the published number, ours, its interval, the
/// difference and whether it is within its tolerance; the chart beside it; notes below.
class ReproductionPanel : public QWidget
{
    Q_OBJECT

public:
    explicit ReproductionPanel(QWidget *parent = nullptr);

    void show(std::shared_ptr<const Reproduction> reproduction);
    ChartPlot &plot() { return *m_plot; }

    QSize sizeHint() const override { return {900, 320}; }

protected:
    void changeEvent(QEvent *event) override;

private:
    void fillTable();

    std::shared_ptr<const Reproduction> m_reproduction;
    QLabel *m_title;
    QLabel *m_notes;
    ColumnTable *m_table;
    QComboBox *m_which;
    ChartPlot *m_plot;
};

} // namespace faintline
