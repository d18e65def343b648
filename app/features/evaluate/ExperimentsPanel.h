#pragma once

#include "app/base/Panel.h"
#include "app/features/evaluate/Experiments.h"

#include <QMap>

class QPushButton;
class QTableWidget;

namespace faintline {

/// The list of running, waiting and completed experiments, with actions to show, stop, import and export them.
class ExperimentsPanel : public Panel
{
    Q_OBJECT

public:
    explicit ExperimentsPanel(Experiments &experiments, QWidget *parent = nullptr);

    /// Whether a file holds an experiment, the runs of a campaign or a curve of Pd.
    static bool isExperiment(const QString &path);
    /// Starts the experiment, also one of the resources, or imports its results; ends with `showRequested` or `failed`.
    /// Returns the experiment's id, 0 if it failed.
    int open(const QString &path);
    void show(int id) { emit showRequested(id); } ///< its results
    /// Imports the runs of a campaign or the points of a curve; returns the experiment's id. Throws Error.
    int importFile(const QString &path);
    /// Exports a campaign's curve or a reproduction's tables and pictures, depending on the entry. Throws Error.
    void exportTo(int id, const QString &path) const;

    QSize sizeHint() const override { return {520, 200}; }

signals:
    void showRequested(int id);

private:
    int selected() const;
    void add(int id);
    void follow(int id);
    void followSelection();
    void chooseImport();
    void chooseExport();

    Experiments &m_experiments;
    QTableWidget *m_table;
    QPushButton *m_show;
    QPushButton *m_cancel;
    QPushButton *m_remove;
    QPushButton *m_export;
};

} // namespace faintline
