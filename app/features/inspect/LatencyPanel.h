#pragma once

#include "app/base/JobRunner.h"
#include "app/document/Document.h"
#include "evaluate/comparison/trackScore.h"

#include <QWidget>

class QLabel;
class QPushButton;
class QSpinBox;

namespace faintline {

class ChartPlot;

/// Latency of detecting the targets of the open scene: repeats the scene with other noise (PingExperiment) and shows
/// the probability of detection against the pings since a target appeared, and a histogram of latencies.
class LatencyPanel : public QWidget
{
    Q_OBJECT

public:
    explicit LatencyPanel(const Document &document, QWidget *parent = nullptr);

    /// Why nothing can be measured for the open source; empty if it can.
    QString obstacle() const;

public slots:
    void start(int runs);

private:
    void follow();
    void show(const std::vector<TrackScore> &scores, Index longest, double threshold);

    const Document &m_document;
    QSpinBox *m_runs;
    QPushButton *m_button;
    QLabel *m_sentence;
    ChartPlot *m_pd;
    ChartPlot *m_histogram;
    JobRunner m_runner{this}; ///< last, so that its jobs end first
};

} // namespace faintline
