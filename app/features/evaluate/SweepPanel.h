#pragma once

#include "app/base/Panel.h"
#include "app/features/evaluate/Experiments.h"
#include "base/Error.h"
#include "evaluate/experiments/campaignCharts.h"

#include <vector>

class QTabWidget;

namespace faintline {

class ChartPlot;
class Document;
class StartColumn;
class SweepForm;

/// Effect of one setting's values: Pd, false alarms, latency and cost against the setting, and the trade-off of Pd
/// against false alarms, growing while they are measured. A click on a value applies it.
class SweepPanel : public Panel
{
    Q_OBJECT

public:
    SweepPanel(const Document &document, Experiments &experiments, QWidget *parent = nullptr);

    SweepForm &form() { return *m_form; }
    ChartPlot &tradeOff() { return *m_tradeOff; }
    ChartPlot &pd() { return *m_pd; }
    ChartPlot &cost() { return *m_cost; }

    /// The displayed sweep; 0: none.
    int shown() const { return m_shown; }
    StartColumn &column() { return *m_column; }
    void show(int id);

    /// Costs vary between runs; turn off where a picture must be reproducible.
    void setMeasuringCost(bool isOn) { m_isMeasuringCost = isOn; }

    QSize sizeHint() const override { return {900, 300}; }

public slots:
    void start();
    void cancel();

signals:
    void valueChosen(const QString &parameter, double value);

private:
    void buildCharts();
    void followDocument();
    void followForm();
    std::optional<Experiment> ofForm() const;
    void follow(int id);
    void showCharts(const Experiments::Entry &entry);
    void measureCost(const Experiments::Entry &entry);
    void choose(const ChartPlot &chart, std::size_t point);

    const Document &m_document;
    Experiments &m_experiments;
    SweepForm *m_form;
    StartColumn *m_column;
    QTabWidget *m_tabs;
    ChartPlot *m_tradeOff;
    ChartPlot *m_pd;
    ChartPlot *m_falseAlarms;
    ChartPlot *m_latency;
    ChartPlot *m_cost;
    int m_shown = 0;
    int m_costOf = 0; ///< the sweep whose cost is known or being measured
    bool m_isMeasuringCost = true;
    JobRunner m_meter; ///< last, so that its jobs end first
};

} // namespace faintline
