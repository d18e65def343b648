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

/// How soon the targets of the scene that is open are found: the scene again and again with other noise
/// (PingExperiment), the probability of detection against the pings a target has been there, and how many took how
/// long.
class LatencyPanel : public QWidget
{
    Q_OBJECT

public:
    explicit LatencyPanel(const Document &document, QWidget *parent = nullptr);

    QString sentence() const;
    ChartPlot *pdPlot() const { return m_pd; }
    ChartPlot *histogramPlot() const { return m_histogram; }

    /// Why nothing can be measured of what is open; empty where it can.
    QString obstacle() const;

public slots:
    void start(int runs);

signals:
    void settled();

private:
    void follow();
    void show(const std::vector<TrackScore> &scores, Index longest, double threshold);

    const Document &m_document;
    QSpinBox *m_runs;
    QPushButton *m_button;
    QLabel *m_sentence;
    ChartPlot *m_pd;
    ChartPlot *m_histogram;
    JobRunner m_runner; ///< last, so that its jobs end first
};

} // namespace faintline
