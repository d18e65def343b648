#pragma once

#include "app/base/Panel.h"
#include "app/features/evaluate/Experiments.h"
#include "evaluate/experiments/Chart.h"

class QComboBox;
class QTabWidget;

namespace faintline {

class ChartPlot;
class Document;
class ExperimentForm;
class StartColumn;

/// Pd and ROC: an experiment is set up on the left; its curves grow on the right while it runs.
class EvaluatePanel : public Panel
{
    Q_OBJECT

public:
    EvaluatePanel(const Document &document, Experiments &experiments, QWidget *parent = nullptr);

    ExperimentForm &form() { return *m_form; }
    ChartPlot &pd() { return *m_pd; }
    ChartPlot &roc() { return *m_roc; }

    /// The experiment whose curves are shown; 0: none.
    int shown() const { return m_shown; }
    StartColumn &column() { return *m_column; }
    void show(int id);

    QSize sizeHint() const override { return {900, 300}; }

public slots:
    void start();
    void cancel();

signals:
    void trialRequested(int experiment, std::size_t detector, std::size_t snr);

private:
    void followDocument();
    void followForm();
    Experiment ofForm() const;
    void follow(int id);
    void showPd(const Experiments::Entry &entry);
    void showRoc(const Experiments::Entry &entry);
    void showOperatingPoint(const Experiments::Entry &entry);
    std::size_t shownSnr() const;
    void sayWhyEmpty(bool isComputing);
    void fillSnrs(const Experiments::Entry &entry);

    const Document &m_document;
    Experiments &m_experiments;
    ExperimentForm *m_form;
    StartColumn *m_column;
    QTabWidget *m_tabs;
    ChartPlot *m_pd;
    ChartPlot *m_roc;
    QComboBox *m_snr;
    Chart m_pdChart; ///< without the operating point
    Chart m_rocChart;
    int m_shown = 0;
};

} // namespace faintline
