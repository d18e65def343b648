#pragma once

#include "app/base/Panel.h"
#include "app/features/sequential/SequentialTests.h"
#include "app/features/sequential/SequentialViews.h"
#include "evaluate/sequential/ScanTest.h"
#include "widgets/forms/FieldForm.h"

class QLabel;
class QSlider;
class QTabWidget;

namespace faintline {

class BarPlot;
class ChartPlot;
class Document;
class SequentialControls;
class TrajectoryPage;
class WalkPlot;

/// Sequential tests: the walks between their boundaries and their stopping stages, one run's posterior and received
/// power, stages against SNR and prior with their bounds, and the savings over rounds of sectors.
///
/// J and L, or the slider, step through the stages of the selected run; a click on a walk selects it in all views.
class SequentialPanel : public Panel
{
    Q_OBJECT

public:
    SequentialPanel(Document &document, SequentialTests &tests, QWidget *parent = nullptr);

    /// Sets these settings and starts.
    void start(const ScanTest &test);
    void startOnSelection(); ///< tests the visible part of the recording

    FieldForm<ScanTest> &form();
    SequentialControls &controls() { return *m_controls; }
    WalkPlot &walk() { return *m_walk; }
    BarPlot &stopping() { return *m_stopping; }
    ChartPlot &asn() { return *m_asn; }
    ChartPlot &variation() { return *m_variation; }
    ChartPlot &prior() { return *m_prior; }
    TrajectoryPage &trajectory() { return *m_trajectory; }
    BarPlot &sectors() { return *m_sectors; }
    QWidget *curvesPage() { return m_curvesPage; } ///< including their sentence
    QWidget *priorPage() { return m_priorPage; }
    QWidget *sectorsPage() { return m_sectorsPage; }
    QSlider &slider() { return *m_slider; }
    QTabWidget &tabs() { return *m_tabs; }

    const SequentialViews &views() const { return m_views; } ///< and their export

    QSize sizeHint() const override { return {1000, 340}; }

protected:
    bool event(QEvent *event) override;
    bool eventFilter(QObject *watched, QEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;

private:
    QWidget *buildWalks();
    QWidget *buildCurves();
    QWidget *buildPrior();
    QWidget *buildSectors();
    QWidget *buildRunRow();
    void connectTests();

    void run();
    void restart();
    void showWalks();
    void showStopping();
    void showSelection();
    void showStage();
    void showCurves();
    void showSectors();
    void selectStoppedAt(int stage);
    void followDocument();

    Document &m_document;
    SequentialTests &m_tests;

    SequentialControls *m_controls;
    QTabWidget *m_tabs;
    WalkPlot *m_walk;
    BarPlot *m_stopping;
    TrajectoryPage *m_trajectory;
    SequentialViews m_views;
    ChartPlot *m_asn;
    ChartPlot *m_variation;
    QLabel *m_curvesText;
    QWidget *m_curvesPage = nullptr;
    ChartPlot *m_prior;
    QLabel *m_priorText;
    QWidget *m_priorPage = nullptr;
    BarPlot *m_sectors;
    QLabel *m_sectorsText;
    QWidget *m_sectorsPage = nullptr;
    QLabel *m_runText;
    QLabel *m_stageText;
    QSlider *m_slider;
};

} // namespace faintline
