#pragma once

#include "app/base/Inquiry.h"
#include "evaluate/comparison/noiseFit.h"

#include <QWidget>

#include <memory>
#include <vector>

class QLabel;

namespace faintline {

struct Analysis;
class ChartPlot;
class ColumnTable;
class Document;

/// Tests whether the selection's normalised noise follows the law on which thresholds are based, and the effect if it
/// does not: quantiles against quantiles, Kolmogorov-Smirnov distance, and the false-alarm probability at the
/// threshold, band by band. Measured automatically while visible.
class NoiseFitPanel : public QWidget
{
    Q_OBJECT

public:
    explicit NoiseFitPanel(const Document &document, QWidget *parent = nullptr);

    ChartPlot &plot() { return *m_plot; }

    QSize sizeHint() const override { return {360, 420}; }

private:
    struct Fit {
        std::shared_ptr<const Analysis> analysis;
        std::vector<FittedBand> bands;
        std::vector<MisfitPfa> pfa;
    };

    static Fit measure(const std::shared_ptr<const Analysis> &analysis, const RunContext &context);
    void show();
    void say(const Fit &fit);

    const Document &m_document;
    QLabel *m_sentence;
    ChartPlot *m_plot;
    ColumnTable *m_table;
    Inquiry<Fit, std::shared_ptr<const Analysis>> m_fit;
};

} // namespace faintline
