#pragma once

#include "app/control/AnalysisController.h"
#include "app/control/Comparer.h"
#include "app/control/Experiments.h"
#include "app/control/RecordingCheck.h"
#include "app/control/SequentialTests.h"
#include "app/document/Document.h"

namespace faintline {

class Bench;
class ChannelsPanel;
class ComparePanel;
class DopplerPanel;
class EvaluatePanel;
class EventReviews;
class EventTable;
class ExceedancePlot;
class ExperimentsPanel;
class HandLinePanel;
class InfoPanel;
class LatencyPanel;
class MessageBar;
class NoiseFitPanel;
class PingBench;
class PipelinePanel;
class ReadOut;
class Recovery;
class ReproductionPanel;
class SequentialPanel;
class StateSlicePanel;
class SpectrumPanel;
class SurveyPanel;
class SweepPanel;
class TargetsPanel;
class WelcomePage;
class WhyPanel;
class WindowViews;
class Workbench;

/// Parts of a window: the document, the controllers and the panels. Lessons, reports, views and render use the window
/// through this interface; MainWindow creates the parts and alone knows their layout and its menus.
class WindowParts
{
public:
    Document &document() { return m_document; }
    const Document &document() const { return m_document; }
    AnalysisController &controller() { return m_controller; }
    Comparer &comparer() { return m_comparer; }
    RecordingCheck &recordingCheck() { return m_check; }
    Experiments &experiments() { return m_experiments; }
    SequentialTests &sequentialTests() { return m_sequentialTests; }
    Recovery &recovery() { return *m_recovery; }

    Workbench &workbench() const { return *m_workbench; }
    PingBench &pingBench() const { return *m_pings; }
    Bench &bench() const; ///< the bench in use for the open document
    WelcomePage &welcome() const { return *m_welcome; }
    MessageBar &messages() const { return *m_messages; }
    PipelinePanel &pipeline() const { return *m_pipeline; }
    ReadOut &readOut() const { return *m_readOut; }
    ExceedancePlot &thresholdPlot() const { return *m_threshold; }
    EventTable &eventTable() const { return *m_events; }
    EventReviews &reviews() const { return *m_reviews; }
    WhyPanel &why() const { return *m_why; }
    InfoPanel &info() const { return *m_info; }
    NoiseFitPanel &noiseFit() const { return *m_noiseFit; }
    StateSlicePanel &states() const { return *m_states; }
    LatencyPanel &latency() const { return *m_latency; }
    HandLinePanel &handLine() const { return *m_handLine; }
    TargetsPanel &targets() const { return *m_targets; }
    ComparePanel &comparePanel() const { return *m_compare; }
    EvaluatePanel &evaluation() const { return *m_evaluate; }
    SpectrumPanel &spectrum() const { return *m_spectrum; }
    ChannelsPanel &channels() const { return *m_channels; }
    DopplerPanel &doppler() const { return *m_doppler; }
    SurveyPanel &survey() const { return *m_survey; }
    SweepPanel &sweep() const { return *m_sweep; }
    ExperimentsPanel &experimentList() const { return *m_experimentList; }
    ReproductionPanel &reproduction() const { return *m_reproduction; }
    SequentialPanel &sequential() const { return *m_sequential; }
    WindowViews &views() const { return *m_views; }

    /// What a session keeps of the window: the view of the bench and of the panels.
    ViewState viewState() const;
    void restore(const ViewState &view);

    /// Opens a recording, a scenario or a session without asking about unsaved changes.
    virtual void openNow(const QString &path, const OpenOptions &options = {},
                         const AnalysisController::Adjust &adjust = {}) = 0;
    /// Opens a radar's sequential test on simulated scans. If no recording is open, only the test is shown.
    virtual void openScans(const ScanTest &test) = 0;
    /// Opens the scenario of such a test unless that test is open already. Throws Error.
    void openScansOf(const QString &path);

protected:
    WindowParts();
    virtual ~WindowParts();
    WindowParts(const WindowParts &) = delete;
    WindowParts &operator=(const WindowParts &) = delete;

    Document m_document;
    AnalysisController m_controller;
    Comparer m_comparer;
    RecordingCheck m_check;
    Experiments m_experiments;
    SequentialTests m_sequentialTests;

    Recovery *m_recovery = nullptr;
    Workbench *m_workbench = nullptr;
    PingBench *m_pings = nullptr;
    WelcomePage *m_welcome = nullptr;
    MessageBar *m_messages = nullptr;
    PipelinePanel *m_pipeline = nullptr;
    ReadOut *m_readOut = nullptr;
    ExceedancePlot *m_threshold = nullptr;
    EventTable *m_events = nullptr;
    EventReviews *m_reviews = nullptr;
    WhyPanel *m_why = nullptr;
    InfoPanel *m_info = nullptr;
    NoiseFitPanel *m_noiseFit = nullptr;
    StateSlicePanel *m_states = nullptr;
    LatencyPanel *m_latency = nullptr;
    HandLinePanel *m_handLine = nullptr;
    TargetsPanel *m_targets = nullptr;
    ComparePanel *m_compare = nullptr;
    EvaluatePanel *m_evaluate = nullptr;
    SpectrumPanel *m_spectrum = nullptr;
    ChannelsPanel *m_channels = nullptr;
    DopplerPanel *m_doppler = nullptr;
    SurveyPanel *m_survey = nullptr;
    SweepPanel *m_sweep = nullptr;
    ExperimentsPanel *m_experimentList = nullptr;
    ReproductionPanel *m_reproduction = nullptr;
    SequentialPanel *m_sequential = nullptr;
    WindowViews *m_views = nullptr;
};

} // namespace faintline
