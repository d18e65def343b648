#pragma once

#include "app/base/JobRunner.h"
#include "evaluate/comparison/noiseFit.h"

#include <QWidget>

#include <memory>
#include <vector>

class QLabel;
class QTableWidget;

namespace faintline {

struct Analysis;
class ChartPlot;
class Document;
class VisibilityWatcher;

/// Tests whether the selection's normalised noise follows the law on which thresholds are based, and the effect if it
/// does not: quantiles against quantiles, Kolmogorov-Smirnov distance, and the false-alarm probability at the
/// threshold, band by band. Measured automatically while visible.
class NoiseFitPanel : public QWidget
{
    Q_OBJECT

public:
    explicit NoiseFitPanel(const Document &document, QWidget *parent = nullptr);

    bool isBusy() const { return m_runner.isRunning(); }
    ChartPlot &plot() { return *m_plot; }
    QTableWidget *table() const { return m_table; }
    QString sentence() const;

    QSize sizeHint() const override { return {360, 420}; }

signals:
    void settled();

private:
    struct Fit {
        std::shared_ptr<const Analysis> analysis;
        std::vector<FittedBand> bands;
        std::vector<MisfitPfa> pfa;
    };

    void measure();
    void show(const Fit &fit);
    void say(const Fit &fit);

    const Document &m_document;
    std::shared_ptr<const Analysis> m_measured; ///< or being measured
    QLabel *m_sentence;
    ChartPlot *m_plot;
    QTableWidget *m_table;
    VisibilityWatcher *m_sight;
    JobRunner m_runner; ///< last, so that its jobs end first
};

} // namespace faintline
